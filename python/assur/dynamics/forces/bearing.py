"""A pin as a bearing: its force as polar data in a link's frame, pressure and velocity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from assur import _trig
from assur._arrays import as_number, in_range, real_number, short
from assur._extreme import Extreme
from assur._other_names import other_names
from assur._summary import summary
from assur._validate import checked_name
from assur.dynamics.preconditions import positive_number
from assur.errors import InputError
from assur.kinematics.table import driven_angles

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float, Number
    from assur._faces import AxesLike, Panels
    from assur.dynamics.forces._reactions import Reactions

__all__ = ["Bearing"]


@other_names(least="it is min", greatest="it is max")
@dataclass(frozen=True)
class Bearing:
    """The force on a link at a pin, in the frame of one of its links, by `Reactions.bearing`.

    Attributes
    ----------
    angle : ndarray
        Direction of the force, counter-clockwise from the frame's x, rad, in (−π, π], S + (N,).
        The force presses a bore in the link on this side, a pin fixed to the link on the opposite
        one.
    size : ndarray
        N, S + (N,).
    force : ndarray
        Components along the frame's x and y, N, S + (N, 2).
    relative_speed : ndarray or None
        Angular velocity of the link relative to the other one, rad/s, S + (N,); None at a pin of
        three links or more, unless `against` names one.
    q : ndarray
        Coordinates, S + (N,); with n drivers (..., n).

    Examples
    --------
    >>> import assur, numpy as np
    >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
    >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
    >>> pin = machine.reactions([0.0, np.pi / 2], speed=10.0).bearing("B", on="piston")
    >>> pin.size.round(6), pin.relative_speed.round(6)  # N, rad/s
    (array([1000., 1250.]), array([6., 0.]))
    """

    def __repr__(self) -> str:
        link, turned = self.frame
        return summary(replace(self, frame=(link, np.nan if np.ndim(turned) else turned)))

    angle: Float
    size: Float
    force: Float
    relative_speed: Float | None
    q: Float
    designs: tuple[int, ...] = ()
    # The frame's link and angle, and what the force acts on.
    frame: tuple[str, float | Float] = ("ground", 0.0)
    what: tuple[str, str] = ("", "")
    is_angle: bool = True

    @property
    def mean(self) -> Number:
        """Mean size over the positions, each of the same weight, N, of shape S."""
        mean: Number = np.mean(self._rows("a mean"), axis=-1)[()]
        return mean

    @property
    def min(self) -> Extreme:
        """The least size, and the position where it is; of shape S."""
        return self._extreme(1.0)

    @property
    def max(self) -> Extreme:
        """The greatest size, and the position where it is; of shape S."""
        return self._extreme(-1.0)

    def pressure(self, diameter: float, width: float) -> Float:
        """Return the mean pressure on the projected area, size / (diameter × width), Pa.

        Parameters
        ----------
        diameter, width : float
            Of the bearing, m.

        Returns
        -------
        ndarray
            Pa, S + (N,).

        Examples
        --------
        >>> import assur
        >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
        >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
        >>> pin = machine.reactions(0.0, speed=10.0).bearing("B", on="piston")
        >>> pin.pressure(diameter=0.02, width=0.05).round(1)  # Pa
        np.float64(1000000.0)
        """
        d, b = (
            real_number(positive_number(value, name), name)
            for value, name in ((diameter, "diameter"), (width, "width"))
        )
        with in_range("a pressure"):
            return (self.size / d) / b

    def pv(self, diameter: float, width: float) -> Float:
        """Return pressure times sliding velocity, Pa·m/s: the bearing's load for heat and wear.

        Parameters
        ----------
        diameter, width : float
            Of the bearing, m.

        Returns
        -------
        ndarray
            ``pressure × |relative speed| × diameter / 2``, S + (N,).

        Raises
        ------
        InputError
            A diameter or width that is not positive; a pin of three links or more without
            `against`.

        References
        ----------
        J. E. Shigley, C. R. Mischke, *Mechanical Engineering Design*, on boundary-lubricated
        bearings.

        Examples
        --------
        >>> import assur
        >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
        >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
        >>> pin = machine.reactions(0.0, speed=10.0).bearing("B", on="piston")
        >>> pin.pv(diameter=0.02, width=0.05).round(1)  # 1e6 Pa at 6 rad/s · 0.01 m
        np.float64(60000.0)
        """
        pressure = self.pressure(diameter, width)
        if self.relative_speed is None:
            message = "three links or more meet here: say with bearing(against=) which one rubs"
            raise InputError(message)
        with in_range("pressure times velocity"):
            return pressure * np.abs(self.relative_speed) * (float(diameter) / 2.0)

    def plot(self, *, ax: AxesLike | None = None, dark: bool = False) -> Axes | Panels:
        """Draw the polar load diagram: the ends of the forces laid off from one pole.

        Once in the ground's frame, once in the frame in which they are given; the greatest force is
        drawn and labelled (needs matplotlib).

        Parameters
        ----------
        ax : matplotlib.axes.Axes or sequence of two, optional
            Where to draw: a single one takes only the diagram in its own frame; a new figure by
            default.
        dark : bool
            Light lines on a dark ground.

        Returns
        -------
        matplotlib.axes.Axes or ndarray of two
            The axes drawn on; one if the frame is the ground's. Artists are named ``force``,
            ``greatest``, ``position 3``.

        Raises
        ------
        InputError
            A batch of designs, no position with a force.

        Examples
        --------
        >>> import assur, numpy as np
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> found = machine.reactions(np.linspace(0.0, 2 * np.pi, 73), speed=10.0)
        >>> axes = found.bearing("A", on="crank").plot()
        >>> axes.shape
        (2,)
        """
        from assur.pictures.forces.polar_load import polar_load

        return polar_load(self, ax, dark)

    def _rows(self, what: str) -> Float:
        """Return the sizes with positions on the last axis, also of one coordinate."""
        size = np.asarray(self.size)
        if size.ndim == len(self.designs):
            size = size[..., np.newaxis]
        if size.shape[-1] == 0:
            message = f"no positions: {what} needs one"
            raise InputError(message)
        return size

    def _extreme(self, sign: float) -> Extreme:
        size = self._rows("an extreme")
        is_single = np.ndim(self.q) == np.ndim(self.size)
        q = np.reshape(self.q, (*size.shape, 1 if is_single else self.q.shape[-1]))
        # NaN only where all sizes are.
        index = np.argmin(np.where(np.isnan(size), np.inf, sign * size), axis=-1)[..., np.newaxis]
        value = np.take_along_axis(size, index, -1)[..., 0][()]
        at = np.take_along_axis(q, index[..., np.newaxis], -2)[..., 0, :]
        return Extreme(as_number(value), as_number(at[..., 0][()] if is_single else at))


def bearing(
    solved: Reactions, name: str, on: str, frame: str | None, against: str | None
) -> Bearing:
    """Return a pin's force as polar data; see `Reactions.bearing`."""
    name, on = checked_name(name, "joint"), checked_name(on, "on")
    force = solved.joint(name, on)
    links = [link for link, joints in solved.mechanism.links.items() if name in joints]
    if len(links) == 1:
        message = f"joint {name!r} is on link {on!r} alone: nothing bears on it"
        raise InputError(message, joint=name, link=on)
    opposites = [link for link in links if link != on]
    for what, link in (("frame", frame), ("against", against)):
        known = links if what == "frame" else opposites
        allowed = (*known, *(["ground"] if what == "frame" else []))
        # An array would be compared with each of them part by part.
        if link is not None and not (type(link) in (str, np.str_) and link in allowed):
            message = f"{what} is {short(link)}: at joint {name!r} it is one of {', '.join(known)}"
            raise InputError(message, joint=name)
    opposite = against or (opposites[0] if len(opposites) == 1 else None)
    own_frame = on if frame is None else frame
    angles, speeds = _motion_of(
        solved, [member for member in (own_frame, on, opposite) if member is not None]
    )
    sine, cosine = _trig.sin_cos(angles[own_frame])
    x, y = force[..., 0], force[..., 1]
    with in_range("the force"):
        turned = np.stack([cosine * x + sine * y, cosine * y - sine * x], axis=-1)
        size = np.sqrt(x * x + y * y)
    return Bearing(
        angle=_trig.arctan2(turned[..., 1], turned[..., 0])[()],
        size=size[()],
        force=turned,
        relative_speed=None if opposite is None else (speeds[on] - speeds[opposite])[()],
        q=solved.q,
        designs=solved.mechanism.shape,
        frame=(own_frame, angles[own_frame]),
        what=(name, on),
        is_angle=driven_angles(solved.mechanism)[0],
    )


def _motion_of(found: Reactions, links: list[str]) -> tuple[dict[str, Float], dict[str, Float]]:
    """Return angles and angular velocities of links at the positions of reactions."""
    mechanism, q, speed = found.mechanism, found.q, found.speed
    shape = found.status.shape
    # The coordinates of a batch need an axis of their own.
    alone = bool(mechanism.shape) and shape == mechanism.shape
    if alone:
        axis = len(shape)
        q, speed = np.expand_dims(q, axis), np.expand_dims(speed, axis)
    motion = mechanism.solve(q, order=1, outputs=sorted(set(links)), on_error="nan")
    quantities = {link: motion.link(link) for link in links}
    angles = {link: quantity.value.reshape(shape) for link, quantity in quantities.items()}
    return angles, {
        link: quantity.velocity(speed).reshape(shape) for link, quantity in quantities.items()
    }
