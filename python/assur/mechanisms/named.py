"""Four-bar and slider-crank from their lengths."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from assur import _core
from assur._arrays import finite_array, real_array, short
from assur._callers import level_of_caller
from assur._other_names import renamed
from assur._trig import sin_cos
from assur._validate import one_of
from assur.description.encode import LIKE_DEGREES
from assur.description.words import Slide
from assur.errors import AssurWarning, DimensionError, InputError
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.model import at_place, copy_from

if TYPE_CHECKING:
    import numpy.typing as npt

__all__ = ["FourBar", "SliderCrank"]


class FourBar(Mechanism):
    """A four-bar linkage from its lengths.

    Joints A, B, C, D, the ground along +x from A to D; links crank A-B, coupler
    B-C, rocker D-C; driven by the crank. The drawing has the crank upright.

    Parameters
    ----------
    crank, coupler, rocker, ground : array_like
        Lengths, m; arrays make a batch of designs.
    mode : {"open", "crossed"}
        Whether C is to the right or the left of the ray from D to B.
    point : (array_like, array_like), optional
        A coupler point P: x from B toward C, y to the left, m.
    ground_angle : array_like
        Direction of the ground from A to D, rad; q is measured from +x all the same.

    Examples
    --------
    >>> import assur, numpy as np
    >>> m = assur.FourBar(40, 120, 80, 100)
    >>> motion = m.solve(np.deg2rad(40))
    >>> np.rad2deg([motion.link("coupler").value, motion.link("rocker").value]).round(3)
    array([20.298, 57.325])
    >>> assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0)).links["coupler"]
    ('B', 'C', 'P')
    """

    __slots__ = ()

    @renamed(
        tilt="ground_angle",
        inclination="ground_angle",
        base="ground",
        frame="ground",
        coupler_point="point",
    )
    def __init__(
        self,
        crank: npt.ArrayLike,
        coupler: npt.ArrayLike,
        rocker: npt.ArrayLike,
        ground: npt.ArrayLike,
        *,
        mode: Literal["open", "crossed"] = "open",
        point: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
        ground_angle: npt.ArrayLike = 0.0,
    ) -> None:
        length = real_array(ground, "ground")
        if length.ndim == 0 and length <= 0.0:
            message = f"ground is {ground!r}: a length must be positive"
            raise DimensionError(message, dimension="ground.D.x", value=float(length))
        one_of(mode, ("open", "crossed"), "mode")
        dimensions: dict[str, npt.ArrayLike] = {
            "crank.length": crank,
            "coupler.length": coupler,
            "rocker.length": rocker,
            # In a batch, designs without a ground get Status.BAD_DIMENSION.
            "ground.D.x": np.where(length > 0.0, length, np.nan),
        }
        angle = finite_array(ground_angle, "ground_angle")
        if angle.any():
            greatest = float(np.abs(angle).max())
            if greatest > LIKE_DEGREES:
                message = f"ground_angle is {greatest:g} rad: is it in degrees? np.radians()"
                warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
            sine, cosine = sin_cos(angle)
            try:
                np.broadcast_shapes(length.shape, angle.shape)
            except ValueError as error:
                message = f"ground has shape {length.shape} and ground_angle {angle.shape}"
                raise InputError(message) from error
            along = np.where(length > 0.0, length, np.nan)
            dimensions |= {"ground.D.x": along * cosine, "ground.D.y": along * sine}
        drawing = _core.four_bar_drawing(mode)
        if point is not None:
            dimensions |= _coupler_point(point)
            joints, links = dict(drawing["joints"]), dict(drawing["links"])
            joints["P"], links["coupler"] = joints["B"], [*links["coupler"], "P"]
            drawing = {**drawing, "joints": list(joints.items()), "links": list(links.items())}
        _copy_from(self, drawing, dimensions)


def _coupler_point(point: Any) -> dict[str, npt.ArrayLike]:
    both = real_array(point, "point") if isinstance(point, np.ndarray) else point
    is_list = isinstance(both, tuple | list) or getattr(both, "ndim", 0) > 0
    if not is_list or len(both) != 2:
        message = f"point is {short(point)}: (x, y) in the coupler's frame is needed"
        raise InputError(message)
    x, y = (
        real_array(coordinate, f"point, {axis}")
        for coordinate, axis in zip(both, "xy", strict=True)
    )
    if x.ndim and y.ndim and x.shape != y.shape:
        message = f"point: x has shape {x.shape} and y {y.shape}"
        raise InputError(message)
    return {"coupler.P.x": x, "coupler.P.y": y}


class SliderCrank(Mechanism):
    """A slider-crank from its lengths.

    Joints O, A, B; links crank O-A, rod A-B, piston; slide bore along +x on the
    ground, its line `offset` to the left of O, B ahead of A; driven by the crank.

    Parameters
    ----------
    crank, rod : array_like
        Lengths, m; arrays make a batch of designs.
    offset : array_like, optional
        Distance of the bore's line from O, m, positive to the left of +x.

    Examples
    --------
    >>> import assur
    >>> assur.SliderCrank(1.0, 3.0).solve(0.0, order=0).slide("bore").value
    array(4.)
    """

    __slots__ = ()

    @renamed(eccentricity="offset", connecting_rod="rod", length="rod", radius="crank")
    def __init__(
        self, crank: npt.ArrayLike, rod: npt.ArrayLike, offset: npt.ArrayLike = 0.0
    ) -> None:
        dimensions = {"crank.length": crank, "rod.length": rod, "bore.offset": offset}
        _copy_from(self, _core.slider_crank_drawing(), dimensions)


def from_drawing(drawing: Any) -> Mechanism:
    """Return the mechanism of a drawing that the core made."""
    slides = {name: Slide(**fields) for name, fields in drawing["slides"]}
    return Mechanism(
        dict(drawing["joints"]), dict(drawing["links"]), drawing["driver"], slides=slides
    )


def _copy_from(mechanism: Mechanism, drawing: Any, dimensions: dict[str, npt.ArrayLike]) -> None:
    # The drawing has fixed lengths, so that neither the assembly nor q0 depends on the dimensions
    # (or on other designs of a batch).
    sized = from_drawing(drawing).with_dimensions(dimensions)
    if not sized.shape:
        sized = _where_it_exists(sized)
    copy_from(mechanism, sized)


def _where_it_exists(mechanism: Mechanism) -> Mechanism:
    """Return one design, drawn within its motion if that does not reach the drawing's q."""
    intervals = mechanism.limits().intervals.tolist()
    q0 = float(mechanism.q0)
    if not intervals or any(low <= q0 <= high for low, high in intervals):
        return mechanism
    # A quarter of the way from the nearest end: change points are in the middle, if anywhere.
    inward = [(end, far) for low, high in intervals for end, far in ((low, high), (high, low))]
    end, far = min(inward, key=lambda ends: abs(math.remainder(ends[0] - q0, math.tau)))
    place_q = end + 0.25 * (far - end)
    for assembly in mechanism.assemblies(place_q):
        place = assembly.place
        if assembly == mechanism.assembly and place is not None:
            core = mechanism.core.drawn_in(mechanism.values.tolist(), list(place.q), place.numbers)
            return at_place(mechanism, place, core)
    return mechanism
