"""P4's mechanism of class IV beside a Newton iteration in numba: places of joints 2 to 8."""

from __future__ import annotations

from typing import TYPE_CHECKING

import newton
import numba
import numpy as np
import pytest
from higher_library import loom
from side_by_side import ASSUR, Q

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    import numpy.typing as npt
    from pytest_benchmark.fixture import BenchmarkFixture

    import assur

    Float = npt.NDArray[np.float64]

DESIGNS = 1024
OUTPUTS = ["2", "3", "4", "5", "6", "7", "8"]
# In the order that the iteration takes them.
NAMES = [
    *("crank.length", "l234.length", "l234.4.x", "l234.4.y", "l365.length", "l365.5.x"),
    *("l365.5.y", "l48.length", "l876.length", "l876.6.x", "l876.6.y", "l95.length"),
    *("l107.length", "ground.9.x", "ground.9.y", "ground.10.x", "ground.10.y"),
]
STARTS = (("2", "3"), ("3", "6"), ("4", "8"), ("8", "7"))


class Case:
    """The same designs for both, with arrays that are there already."""

    def __init__(self, order: int) -> None:
        one = loom()
        random = np.random.default_rng(1)
        values = {n: one.dimensions[n] * random.uniform(1.0, 1.01, DESIGNS) for n in NAMES}
        self.order = order
        self.batch = one.with_dimensions(values)
        self.dimensions = np.stack([values[n] for n in NAMES], axis=1)
        ends = [np.subtract(one.joints[b], one.joints[a]) for a, b in STARTS]
        self.start = np.array([np.arctan2(y, x) for x, y in ends])
        self.out = np.zeros((DESIGNS, len(Q), 7 * (order + 1), 2))
        self.motion = self.assur(1)
        numba.set_num_threads(2)

    def assur(self, threads: int, out: assur.Motion | None = None) -> assur.Motion:
        return self.batch.solve(
            Q, order=self.order, outputs=OUTPUTS, on_error="nan", threads=threads, out=out
        )

    def numba(self, sweep: Callable[..., Any]) -> None:
        sweep(self.dimensions, self.start, Q, self.order, self.out)

    def check(self) -> None:
        """Assert that both find the same, within 1e-12."""
        for place, name in enumerate(OUTPUTS):
            track = self.motion.joint(name)
            for order in range(self.order + 1):
                mine = getattr(track, f"d{order}") if order else track.value
                assert np.abs(mine - self.out[:, :, 7 * order + place]).max() < 1e-12, name


RUNS: dict[str, Callable[[Case], object]] = {
    f"{ASSUR}, 1 thread": lambda case: case.assur(1),
    f"{ASSUR}, 2 threads": lambda case: case.assur(2),
    f"{ASSUR}, 1 thread, out=": lambda case: case.assur(1, case.motion),
    f"{ASSUR}, 2 threads, out=": lambda case: case.assur(2, case.motion),
    "numba, 1 thread": lambda case: case.numba(newton.one_thread),
    "numba, 2 threads": lambda case: case.numba(newton.two_threads),
}


@pytest.fixture(scope="module", params=[0, 2])
def case(request: pytest.FixtureRequest) -> Case:
    c = Case(request.param)
    for sweep in (newton.one_thread, newton.two_threads):
        c.numba(sweep)
        c.check()
    return c


@pytest.mark.parametrize("name", RUNS)
def test_designs(benchmark: BenchmarkFixture, case: Case, name: str) -> None:
    benchmark.group = f"class IV, {DESIGNS} designs x {len(Q)} positions, order {case.order}"
    benchmark.pedantic(RUNS[name], (case,), rounds=9, warmup_rounds=1)
