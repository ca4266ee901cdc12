"""The class IV mechanism of V. M. Dvorzhak's paper."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur import _core
from assur._arrays import real_number, short, two_numbers
from assur._trig import sin_cos
from assur.description import encode
from assur.description.words import has_analogues
from assur.errors import DimensionError, InputError
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.model import copy_from
from assur.mechanisms.named import from_drawing

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.motion import Motion

__all__ = ["ClassIV"]

JOINTS = tuple(str(i) for i in range(1, 11))
# The paper's names: lengths l, angles U (from the first leg to the last, at the middle joint),
# fixed pivots, and the starting angles f of its iteration (that of "1-2" is the crank's).
LENGTHS = ("1-2", "2-3", "2-4", "3-5", "3-6", "4-8", "6-8", "7-8", "5-9", "7-10")
ANGLES = ("4-2-3", "6-3-5", "7-8-6")
PIVOTS = ("1", "9", "10")
STARTS = ("1-2", "2-4", "3-6", "4-8", "7-8")


class ClassIV(Mechanism):
    """The paper's class IV mechanism, from its joints or from lengths and angles.

    Crank 1-2; ternary links 2-3-4, 3-6-5 and 8-7-6; bar 4-8; rockers 9-5 and 10-7; fixed pivots
    1, 9 and 10. Links 2-3-4, 4-8, 8-7-6 and 3-6-5 form the closed quadrilateral. Links are called
    crank, l234, l365, l48, l876, l95 and l107; driven by the crank.

    Parameters
    ----------
    joints : mapping of str to (x, y), optional
        A drawing, m: joints ``"1"`` to ``"10"``.
    lengths : mapping, optional
        Instead of `joints`, with the paper's names: lengths, m, ``"1-2"``, ``"2-3"``, ``"2-4"``,
        ``"3-5"``, ``"3-6"``, ``"4-8"``, ``"6-8"``, ``"7-8"``, ``"5-9"`` and ``"7-10"``.
    angles : mapping, optional
        The angles U of the ternary links, rad: ``"4-2-3"``, ``"6-3-5"`` and ``"7-8-6"``, measured
        counter-clockwise from the leg named first.
    pivots : mapping, optional
        Positions of ``"1"``, ``"9"`` and ``"10"``, m.
    start : mapping, optional
        Starting angles of the iteration, rad: of 2→4, 3→6, 4→8 and 8→7 (``"2-4"``, ``"3-6"``,
        ``"4-8"``, ``"7-8"``) with the crank at ``"1-2"``. They select the assembly.

    Raises
    ------
    InputError
        Missing or unknown names, or starting angles from which no assembly is found.
    DimensionError
        Lengths that are not positive.

    Notes
    -----
    The paper's four equations state two distances along two routes each, but not that the routes
    meet: they have roots where the quadrilateral is open, and are singular where the rockers are
    parallel. This class closes the quadrilateral itself; `paper_equations` evaluates the paper's
    equations for a solution.

    Examples
    --------
    >>> import assur
    >>> m = assur.ClassIV(joints={"1": (0, 0), "2": (0.35, 0), "3": (1.24, 0.99),
    ...     "4": (0.75, 1.91), "5": (3.02, -0.73), "6": (2.45, 1.02), "7": (3.2, 2.24),
    ...     "8": (1.85, 2.35), "9": (1.62, -1.11), "10": (4.28, 1.52)})
    >>> m.structure.formula
    'I(crank) → IV(l234, l365, l48, l876, l95, l107)'
    >>> m.solve(1.0).joint("6").value.round(6)
    array([2.407411, 1.185773])
    """

    __slots__ = ()

    def __init__(
        self,
        joints: Mapping[str, Sequence[float] | Float] | None = None,
        *,
        lengths: Mapping[str, float] | None = None,
        angles: Mapping[str, float] | None = None,
        pivots: Mapping[str, Sequence[float] | Float] | None = None,
        start: Mapping[str, float] | None = None,
    ) -> None:
        paper = (lengths, angles, pivots, start)
        if joints is not None and all(part is None for part in paper):
            _require_names(joints, JOINTS, "joints")
            copy_from(self, _drawn(joints))
            return
        if joints is not None or any(part is None for part in paper):
            message = "ClassIV needs joints=, or lengths=, angles=, pivots= and start= together"
            raise InputError(message)
        copy_from(self, _from_paper(lengths, angles, pivots, start))

    def paper_equations(self, motion: Motion) -> npt.NDArray[np.float64]:
        """Return the residuals of the paper's four equations at every position of a motion, m².

        ``|5−9|²`` through 3 and through 6, ``|7−10|²`` through 8 and through 6, each minus the
        length squared.

        Parameters
        ----------
        motion : Motion
            A motion of this mechanism.

        Returns
        -------
        numpy.ndarray
            Residuals, m², of shape S + (N, 4).

        References
        ----------
        V. M. Dvorzhak, Computer study of plane mechanisms of the fourth class (in Ukrainian).

        Examples
        --------
        >>> import assur
        >>> loom = assur.ClassIV(joints={
        ...     "1": (0, 0), "2": (0.35, 0), "3": (1.24, 0.99), "4": (0.75, 1.91),
        ...     "5": (3.02, -0.73), "6": (2.45, 1.02), "7": (3.2, 2.24), "8": (1.85, 2.35),
        ...     "9": (1.62, -1.11), "10": (4.28, 1.52),
        ... })
        >>> residuals = loom.paper_equations(loom.solve([0.0, 0.5, 1.0]))
        >>> residuals.shape, bool((abs(residuals) < 1e-13).all())
        ((3, 4), True)
        """
        at = {name: _complex(motion.joint(name).value) for name in JOINTS}
        turn = {
            link: _polar(1.0, motion.link(link).value) for link in ("l234", "l365", "l48", "l876")
        }
        d = {name: np.asarray(value)[..., np.newaxis] for name, value in self.dimensions.items()}
        to3 = turn["l234"] * d["l234.length"]
        to4 = turn["l234"] * (d["l234.4.x"] + 1j * d["l234.4.y"])
        to6 = turn["l365"] * d["l365.length"]
        to5 = turn["l365"] * (d["l365.5.x"] + 1j * d["l365.5.y"])
        to8 = turn["l48"] * d["l48.length"]
        to7 = turn["l876"] * d["l876.length"]
        from8to6 = turn["l876"] * (d["l876.6.x"] + 1j * d["l876.6.y"])
        two, nine, ten = at["2"], at["9"], at["10"]
        routes = (
            (two + to3 + to5 - nine, "l95.length"),
            (two + to4 + to8 + from8to6 - to6 + to5 - nine, "l95.length"),
            (two + to4 + to8 + to7 - ten, "l107.length"),
            (two + to3 + to6 - from8to6 + to7 - ten, "l107.length"),
        )
        misses = [_squared(route) - d[length] ** 2 for route, length in routes]
        return np.stack(np.broadcast_arrays(*misses), axis=-1).reshape((*motion.shape, 4))


def _polar(length: float, angle: npt.ArrayLike) -> Any:
    sine, cosine = sin_cos(angle)
    return length * (cosine + 1j * sine)


def _squared(z: npt.NDArray[np.complex128]) -> npt.NDArray[np.float64]:
    return np.asarray(z.real * z.real + z.imag * z.imag)


def _complex(points: npt.NDArray[np.float64]) -> npt.NDArray[np.complex128]:
    return np.asarray(points[..., 0] + 1j * points[..., 1])


def _drawn(joints: Mapping[str, Any]) -> Mechanism:
    points = [encode.joint(name, joints[name])[1:] for name in JOINTS]
    return from_drawing(_core.class_iv_drawing(points))


def _require_names(mapping: Any, names: Iterable[str], what: str) -> None:
    """Raise InputError for missing or unknown names."""
    try:
        missing, unknown = [n for n in names if n not in mapping], set(mapping) - set(names)
    except TypeError as error:
        message = f"{what} is {short(mapping)}: a mapping is needed"
        raise InputError(message) from error
    if missing or unknown:
        lack = f"{', '.join(map(repr, missing))} missing" if missing else ""
        more = f"{', '.join(sorted(map(repr, unknown)))} unknown" if unknown else ""
        message = f"{what}: {'; '.join(filter(None, (lack, more)))}; its names are {list(names)}"
        raise InputError(message)


def _numbers(mapping: Any, names: Sequence[str], what: str) -> dict[str, float]:
    _require_names(mapping, names, what)
    return {name: real_number(mapping[name], f"{what}[{name!r}]") for name in names}


def _from_paper(lengths: Any, angles: Any, pivots: Any, start: Any) -> Mechanism:
    """Draw at the starting angles, solve with the given lengths, draw the position found."""
    length, angle = _numbers(lengths, LENGTHS, "lengths"), _numbers(angles, ANGLES, "angles")
    first = _numbers(start, STARTS, "start")
    _require_names(pivots, PIVOTS, "pivots")
    for name, value in length.items():
        if value <= 0.0:
            message = f"lengths[{name!r}] is {value!r}: a length must be positive"
            raise DimensionError(message, dimension=name, value=value)
    at: dict[str, complex] = {}
    for name in PIVOTS:
        at[name] = complex(*two_numbers(pivots[name], f"pivots[{name!r}]"))

    def leg(name: str, turn: float) -> complex:
        return complex(_polar(length[name], turn))

    at["2"] = at["1"] + leg("1-2", first["1-2"])
    at["3"] = at["2"] + leg("2-3", first["2-4"] + angle["4-2-3"])
    at["4"] = at["2"] + leg("2-4", first["2-4"])
    at["6"] = at["3"] + leg("3-6", first["3-6"])
    at["5"] = at["3"] + leg("3-5", first["3-6"] + angle["6-3-5"])
    at["8"] = at["4"] + leg("4-8", first["4-8"])
    at["7"] = at["8"] + leg("7-8", first["7-8"])
    # In the frames of the links, at the first joint with x toward the second.
    corner = {
        "l234.4": _polar(length["2-4"], -angle["4-2-3"]),
        "l365.5": _polar(length["3-5"], angle["6-3-5"]),
        "l876.6": _polar(length["6-8"], angle["7-8-6"]),
    }
    dimensions = {"crank.length": length["1-2"], "l234.length": length["2-3"]}
    dimensions |= {"l365.length": length["3-6"], "l48.length": length["4-8"]}
    dimensions |= {"l876.length": length["7-8"], "l95.length": length["5-9"]}
    dimensions |= {"l107.length": length["7-10"]}
    dimensions |= {f"{name}.x": point.real for name, point in corner.items()}
    dimensions |= {f"{name}.y": point.imag for name, point in corner.items()}
    drawn = _drawn({n: (at[n].real, at[n].imag) for n in JOINTS})
    sized = drawn.with_dimensions(dimensions)
    motion = sized.solve(sized.q0, order=0, on_error="nan")
    if not has_analogues(motion.status):
        apart = abs(at["8"] + leg("6-8", first["7-8"] + angle["7-8-6"]) - at["6"])
        message = (
            f"these starting angles lead to no assembly with the crank at {first['1-2']!r} "
            f"(the quadrilateral stays open by {apart:.3g} m): choose angles nearer to one, or "
            f"another crank angle"
        )
        raise InputError(message, q=first["1-2"])
    joints = {name: tuple(motion.joint(name).value.tolist()) for name in JOINTS}
    return _drawn(joints).with_dimensions(dimensions)
