"""Charts: two coordinates that lead a linkage with two freedoms wherever its drivers cannot.

At a singular position of the drivers other coordinates still lead: angles of links or values of
slides. Two of them drive in the drivers' place, so that the engine gives everything, the drivers'
coordinates too, with exact derivatives by them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.description.words import Drive, has_analogues
from assur.errors import AssurError
from assur.kinematics.model import Place, at_place
from assur.kinematics.pose import Pose, bare_core
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel

# How far (rad, or of the size) a chart is followed before it is drawn anew.
REACH = 0.5


@dataclass(frozen=True, slots=True)
class Surface:
    """The positions of a linkage with two freedoms.

    Attributes
    ----------
    mechanism : MechanismModel
        A design with two or more drivers.
    free : tuple of int
        The two drivers that move; the others are held.
    q : tuple of float
        Coordinates at which those are held, rad or m, one per driver.
    size : float
        A length of the mechanism, m.
    """

    mechanism: MechanismModel
    free: tuple[int, int]
    q: tuple[float, ...]
    size: float

    @property
    def names(self) -> tuple[str, ...]:
        """The moving links, then the slides."""
        links = tuple(name for name in self.mechanism.links if name != "ground")
        return (*links, *self.mechanism.slides)

    def coordinates(self, pose: Pose) -> Float:
        """Return angles of the moving links, rad, and values of slides in sizes."""
        links = zip(self.mechanism.links, pose.angles, strict=True)
        angles = [angle for name, angle in links if name != "ground"]
        return np.array([*angles, *(np.array(pose.slides) / self.size)])

    def difference(self, first: Float, second: Float) -> Float:
        """Return the difference of two positions' coordinates, angles within half a turn."""
        gap = first - second
        angles = len(self.names) - len(self.mechanism.slides)
        gap[..., :angles] -= 2.0 * np.pi * np.round(gap[..., :angles] / (2.0 * np.pi))
        return gap


@dataclass(frozen=True, slots=True)
class Point:
    """A position in a chart.

    Attributes
    ----------
    pose : Pose
        Where everything is.
    at : ndarray
        The chart's two coordinates, rad or sizes.
    rates : ndarray
        Derivatives of all coordinates by the chart's, shape (number of coordinates, 2).
    determinant : float
        Of the derivatives of the free drivers by the chart's coordinates: 0 where the drivers
        are singular.
    gradient : ndarray
        Its derivatives.
    """

    pose: Pose
    at: Float
    rates: Float
    determinant: float
    gradient: Float


class Chart:
    """A surface near a pose, by two coordinates (by default the free drivers).

    Raises
    ------
    AssurError
        If they do not lead there.
    """

    def __init__(self, surface: Surface, pose: Pose, pair: tuple[int, int] | None = None) -> None:
        mechanism = surface.mechanism
        drivers = mechanism.description.drivers
        held = [driver for i, driver in enumerate(drivers) if i not in surface.free]
        free = [drivers[i] for i in surface.free]
        if pair is not None:
            free = [surface.names[index] for index in pair]
        description = mechanism.description._replace(drivers=(*free, *held), assembly=())
        core = bare_core(description)
        q, numbers = core.at_pose(pose.joints, pose.angles, pose.slides)
        plain = mechanism._make(description, np.array(mechanism.values), core)
        drawn = core.drawn_in(plain.values.tolist(), q, numbers)
        self._mechanism = at_place(plain, Place(plain, tuple(q), numbers), drawn)
        self._surface = surface
        self._held = q[2:]
        is_length = [isinstance(driver, str) and driver in mechanism.slides for driver in free]
        self.unit = np.where(is_length, surface.size, 1.0)
        self.pair = pair
        self.start: Float = np.array(q[:2]) / self.unit

    def at(self, where: Float) -> Point | None:
        """Return the position at two coordinates; None if the chart does not lead there."""
        if np.abs(where - self.start).max() > REACH:
            return None
        motion = solve(self._mechanism, [*(where * self.unit), *self._held], on_error="nan")
        if not has_analogues(motion.status):
            return None
        mechanism, surface = self._mechanism, self._surface
        angles = {name: motion.link(name) for name in mechanism.links}
        slides = {name: motion.slide(name) for name in mechanism.slides}
        pose = Pose(
            [tuple(motion.joint(name).value.tolist()) for name in mechanism.joint_names],
            [float(angle.value) for angle in angles.values()],
            [float(slide.value) for slide in slides.values()],
        )
        rates = [angle.d1[:2] * self.unit for name, angle in angles.items() if name != "ground"]
        rates += [slide.d1[:2] * self.unit / surface.size for slide in slides.values()]

        def derivatives(driver: Any) -> tuple[Float, Float]:
            if isinstance(driver, str) and driver in slides:
                slide = slides[driver]
                first, second = slide.d1 / surface.size, slide.d2 / surface.size
            elif isinstance(driver, str):
                first, second = angles[driver].d1, angles[driver].d2
            else:
                assert isinstance(driver, Drive)
                link, base = angles[driver.link], angles[driver.relative_to]
                first, second = link.d1 - base.d1, link.d2 - base.d2
            return first[:2] * self.unit, second[:2, :2] * np.outer(self.unit, self.unit)

        drivers = surface.mechanism.description.drivers
        (u, du), (v, dv) = (derivatives(drivers[i]) for i in surface.free)
        gradient = du[0] * v[1] + u[0] * dv[1] - du[1] * v[0] - u[1] * dv[0]
        return Point(pose, where, np.array(rates), float(u[0] * v[1] - u[1] * v[0]), gradient)


def dot(a: Float, b: Float) -> float:
    """Return the scalar product of two vectors."""
    return float((a * b).sum())


def length_of(vector: Float) -> float:
    """Return the length of a vector."""
    return math.sqrt(dot(vector, vector))


def best_pair(point: Point) -> tuple[tuple[int, int], float]:
    """Return the two coordinates that lead best at a position, and how much they are better.

    Of the orthonormal basis of the tangent plane, the rows with the greatest determinant; beside
    it, how many times greater it is than that of the chart's own coordinates.
    """
    # Gram and Schmidt.
    first_axis, second_axis = point.rates.T
    first_length = length_of(first_axis)
    first_axis = first_axis / first_length
    second_axis = second_axis - dot(first_axis, second_axis) * first_axis
    second_length = length_of(second_axis)
    second_axis = second_axis / second_length
    determinants = np.abs(np.outer(first_axis, second_axis) - np.outer(second_axis, first_axis))
    first, second = np.unravel_index(np.argmax(determinants), determinants.shape)
    # The chart's own rows are the identity: in the basis their determinant is 1/(both lengths).
    chart_determinant = 1.0 / (first_length * second_length)
    return (int(first), int(second)), float(determinants[first, second]) / chart_determinant


def chart_at(surface: Surface, point: Point) -> Chart | None:
    """Return the chart that leads best from a position on; None if none does."""
    try:
        return Chart(surface, point.pose, best_pair(point)[0])
    except AssurError:
        return None
