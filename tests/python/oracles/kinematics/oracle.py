"""Independent oracle: body coordinates at 50 digits, sharing no code with assur.

Positions come from Newton with a float64 inverse and 50-digit residuals (oracle_system.py),
analogues from the same residuals read as truncated power series in the driver.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from models.mechanisms.mechanism_data import GROUND
from oracles.kinematics.oracle_system import MP, System, as_tuple, inverted

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from models.mechanisms.mechanism_data import Description
    from oracles.kinematics.oracle_system import Pose, Real

POSITION_TOL = MP.mpf("1e-40")  # residual, relative to the size of the mechanism
SERIES_TOL = MP.mpf("1e-35")  # last correction, relative to the coefficient
MAX_ITERATIONS = 80  # each gains a factor of about 1e-16 times the condition


class NoConvergenceError(ArithmeticError):
    """No assembled position was found from the guess."""


@dataclass(frozen=True)
class Jet:
    """A value and its partial derivatives: `partials[()]`, `[(0,)]`, `[(0, 1)]`, ... as mp."""

    partials: dict[tuple[int, ...], tuple[Real, ...]]
    drivers: int
    scalar: bool

    def tensor(self, order: int) -> NDArray[np.float64]:
        """float64 array: the component axis (2, for joints only), then one axis a derivative.

        With a single driver the derivative axes are left out.
        """
        size = len(self.partials[()])
        out = np.empty((size, *(self.drivers,) * order))
        for index in np.ndindex(out.shape[1:]):
            out[(slice(None), *index)] = [float(v) for v in self.partials[tuple(sorted(index))]]
        if self.drivers == 1:
            out = out.reshape(size)
        return out[0, ...] if self.scalar else out

    @property
    def value(self) -> NDArray[np.float64]:
        """Order 0."""
        return self.tensor(0)

    @property
    def d1(self) -> NDArray[np.float64]:
        """First analogue(s)."""
        return self.tensor(1)

    @property
    def d2(self) -> NDArray[np.float64]:
        """Second analogue(s)."""
        return self.tensor(2)

    @property
    def d3(self) -> NDArray[np.float64]:
        """Third analogue(s)."""
        return self.tensor(3)


@dataclass(frozen=True)
class Solution:
    """One position; link angles include the drawing's and may be whole turns away."""

    joints: dict[str, Jet]
    links: dict[str, Jet]
    slides: dict[str, Jet]
    pose: Pose
    residual: float  # relative to the size
    condition: float  # 2-norm condition of the scaled body Jacobian


def _number(v: Any) -> Any:
    return v.item() if isinstance(v, (np.ndarray, np.generic)) else v  # mpf takes no NumPy scalar


def solve(
    description: Description,
    q: Any,
    guess: Mapping[str, Any],
    order: int = 3,
    change: Callable[[System], None] | None = None,
) -> Solution:
    """The position near `guess` (link -> x, y, rotation) at q (one number a driver), with jets.

    q may be float or mpf.  Whole turns between guess and q are ignored (see `angle_gap`).
    `change` may give the system other dimensions than the drawing's.
    """
    system = System(description)
    if change is not None:
        change(system)
    count = len(system.unit)
    here = [MP.mpf(_number(v)) / u for v, u in zip(as_tuple(q), system.unit, strict=True)]
    for turn in system.turns:
        if turn.q is not None:
            a, b = (guess[system.names[i]][2] if i else 0.0 for i in (turn.a, turn.b))
            turns = round(float(here[turn.q] - (turn.shift + a - b)) / math.tau)
            here[turn.q] -= 2 * MP.pi * turns
    scale = (1 / system.size, 1 / system.size, 1.0)
    z = [
        MP.mpf(float(v)) * f for n in system.names[1:] for v, f in zip(guess[n], scale, strict=True)
    ]
    inverse, step, error = np.empty(0), 1.0, MP.inf
    for _ in range(MAX_ITERATIONS):
        system.put(0, z)
        rows = system.residual(0, here)
        error = max((abs(v) for v in rows), default=MP.mpf(0))
        if error <= POSITION_TOL or not error < 1e6:
            break
        if step > 1e-14:  # the pose's last double still changes, so the matrix does
            jacobian = system.jacobian()
            inverse = inverted(jacobian)
        dz = inverse @ np.array([float(v) for v in rows])
        step = float(np.max(np.abs(dz)))
        z = [v - d for v, d in zip(z, dz.tolist(), strict=True)]
    if not error <= POSITION_TOL:
        raise NoConvergenceError(f"residual {float(error):.3g} at q = {q}")
    jacobian = system.jacobian()
    jets = _jets(system, inverted(jacobian) if order else inverse, count, order)
    condition = float(np.linalg.cond(jacobian))
    return Solution(*jets, system.pose(), float(error), condition)


def _series(
    system: System, inverse: NDArray[np.float64], along: tuple[int, ...], order: int
) -> dict[tuple[str, str], list[tuple[Real, ...]]]:
    """All outputs along q + t*along: k-th derivative in t at 0, k = 0..order."""
    zero = MP.mpf(0)
    for k in range(1, order + 1):
        v = [MP.mpf(a) / u if k == 1 else zero for a, u in zip(along, system.unit, strict=True)]
        z = [zero] * (3 * len(system.names) - 3)
        for _ in range(MAX_ITERATIONS):  # affine in z: iterative refinement
            system.put(k, z)
            dz = (inverse @ np.array([float(r) for r in system.residual(k, v)])).tolist()
            z = [a - d for a, d in zip(z, dz, strict=True)]
            # what moves by less than roundoff of the lower orders does not move
            if max(map(abs, dz)) <= SERIES_TOL * max(MP.mpf("1e-10"), *map(abs, z)):
                break
        else:
            raise NoConvergenceError(f"analogue of order {k} does not converge")
        system.put(k, z)
    out: dict[tuple[str, str], list[tuple[Real, ...]]] = {}
    factor = [MP.mpf(math.factorial(k)) for k in range(order + 1)]
    for name, (body, u) in system.points.items():
        points = (system.point(body, u, k) for k in range(order + 1))
        grow = [f * system.size for f in factor]
        out["joint", name] = [(x * f, y * f) for (x, y), f in zip(points, grow, strict=True)]
    for i, name in enumerate(system.names):
        angle = [system.series[i][2][k] * f for k, f in enumerate(factor)]
        out["link", name] = [(v if k else v + system.angle0[i],) for k, v in enumerate(angle)]
    for name, r in system.values.items():
        out["slide", name] = [(system.reach(r, k) * f * system.size,) for k, f in enumerate(factor)]
    return out


def _jets(
    system: System, inverse: NDArray[np.float64], count: int, order: int
) -> tuple[dict[str, Jet], dict[str, Jet], dict[str, Jet]]:
    """Partials by polarisation: D(v1..vk) = 1/k! sum over subsets S of (-1)^(k-|S|) D^k[sum S]."""
    cache: dict[tuple[int, ...], Any] = {}

    def derivative(key: tuple[str, str], along: tuple[int, ...], k: int) -> tuple[Real, ...]:
        g = math.gcd(*along) or 1
        unit = tuple(a // g for a in along)
        if unit not in cache:
            cache[unit] = _series(system, inverse, unit, order)
        return tuple(v * g**k for v in cache[unit][key][k])

    first = tuple(int(i == 0) for i in range(count))
    found: dict[str, dict[str, Jet]] = {"joint": {}, "link": {}, "slide": {}}
    derivative(("link", GROUND), first, 0)
    for key in cache[first]:
        partials: dict[tuple[int, ...], tuple[Real, ...]] = {(): derivative(key, first, 0)}
        for k in range(1, order + 1):
            for index in itertools.combinations_with_replacement(range(count), k):
                total = [MP.mpf(0)] * len(partials[()])
                for r in range(1, k + 1):
                    for subset in itertools.combinations(index, r):
                        along = tuple(subset.count(i) for i in range(count))
                        part = derivative(key, along, k)
                        total = [t + (-1) ** (k - r) * p for t, p in zip(total, part, strict=True)]
                partials[index] = tuple(t / math.factorial(k) for t in total)
        found[key[0]][key[1]] = Jet(partials, count, key[0] != "joint")
    return found["joint"], found["link"], found["slide"]


def angle_gap(a: Any, b: Any) -> Any:
    """a - b without whole turns, at 50 digits."""
    d = MP.mpf(_number(a)) - MP.mpf(_number(b))
    return d - 2 * MP.pi * MP.nint(d / (2 * MP.pi))
