"""The peak of a load inside a link over a motion, refined between its positions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._arrays import as_number
from assur._search import narrowed
from assur._summary import summary
from assur.dynamics.motion.motion_input import DrivenMotion
from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float, Number
    from assur.dynamics.internal.beam import Beam
    from assur.dynamics.internal.rod import Rod

MEASURES = ("size", "max", "min")
# Positions tried at a time between the neighbours of a peak, and the last distance of neighbours
# relative to the first: a maximum is known to the square of that.
TRIED = 9
CLOSEST = 1e-8
# Peaks this close to the greatest, relative to the range of all positions, are refined too.
NEAR = 0.2


class Peak(NamedTuple):
    """An extreme over a link and a motion.

    Attributes
    ----------
    value : float
        With its sign, N or N·m.
    x : float
        Distance from the first joint, m.
    q : float or ndarray
        The driver's coordinate; with n drivers (n,).

    Examples
    --------
    >>> import assur, numpy as np
    >>> rod = assur.Body(mass=1.2, inertia=1.2 * 0.35**2 / 12, at=(0.175, 0.0))
    >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={"rod": rod})
    >>> inside = machine.internal_loads("rod", np.linspace(0.0, np.pi, 37), speed=100.0)
    >>> peak = inside.peak("axial", of="max")
    >>> print(f"tension {peak.value:.1f} N at {peak.x:.3f} m, {peak.q:.3f} rad")
    tension 1371.4 N at 0.000 m, 0.000 rad
    """

    value: float
    x: float
    q: Number

    def __repr__(self) -> str:
        return summary(self)


def find_peak(
    rod: Rod, beam: Beam, motion: DrivenMotion, is_row: bool, quantity: str, of: str
) -> Peak:
    """Return the peak over P positions: coordinates and rates (P, n), times (P,)."""
    q = motion.q
    measure, value, x = _measured(beam, quantity, of)
    known = np.isfinite(measure)
    if not known.any():
        message = f"no position has a value of {quantity}"
        raise InputError(message)
    at = int(np.argmax(measure))
    best = Peak(
        float(value[at]), float(x[at]), as_number(float(q[at, 0]) if q.shape[1] == 1 else q[at])
    )
    steps = np.diff(q[:, 0])
    steady = all((part == part[0]).all() for part in motion[1:4])
    ordered = (steps > 0.0).all() or (steps < 0.0).all()
    if q.shape[1] > 1 or not is_row or not steady or not ordered:
        return best
    beside = np.concatenate([[-np.inf], measure, [-np.inf]])
    enough = measure[at] - NEAR * (measure[at] - measure[known].min())
    peaks = np.flatnonzero(
        known & (measure >= beside[:-2]) & (measure >= beside[2:]) & (measure >= enough)
    )
    # Not toward a position without a value, where loads may grow without a limit.
    before = np.where(np.isfinite(beside[peaks]), peaks - 1, peaks)
    after = np.where(np.isfinite(beside[peaks + 2]), peaks + 1, peaks)
    rates = float(motion.speed[0, 0]), float(motion.acceleration[0, 0]), float(motion.t[0])
    refined = _refined(rod, rates, (quantity, of), q[before, 0], q[after, 0])
    return max([(float(measure[at]), best), *refined], key=lambda candidate: candidate[0])[1]


def _refined(
    rod: Rod, rates: tuple[float, float, float], asked: tuple[str, str], low: Float, high: Float
) -> list[tuple[float, Peak]]:
    """Return the peaks between positions: narrowed down to the best of a few, repeatedly."""
    last: tuple[Float, ...] = ()

    def height(q: Float) -> Float:
        nonlocal last
        flat = q.reshape(-1, 1)
        v, a, t = (np.full(flat.shape, rate) for rate in rates)
        with np.errstate(over="ignore", invalid="ignore"):
            beam = rod.solve(DrivenMotion(flat, v, a, t[:, 0]), "nan")
            last = tuple(part.reshape(q.shape) for part in _measured(beam, *asked))
        return last[0]

    q, best = narrowed(height, low, high, TRIED + 2, CLOSEST)
    chosen = (column[np.arange(low.size), best].tolist() for column in (*last, q))
    return [(m, Peak(*peak)) for m, *peak in zip(*chosen, strict=True)]


def _measured(beam: Beam, quantity: str, of: str) -> tuple[Float, Float, Float]:
    """Return the measure to maximise at each position (−inf: no value), the value and its place."""
    least, least_x, greatest, greatest_x = beam.extremes(quantity)
    up = np.abs(greatest) >= np.abs(least) if of == "size" else np.full(least.shape, of != "min")
    value, x = np.where(up, greatest, least), np.where(up, greatest_x, least_x)
    measure = {"size": np.abs(value), "max": value, "min": -value}[of]
    return np.where(np.isfinite(measure), measure, -np.inf), value, x
