"""Sweeps beside numba by a specialist and beside memory, two threads each, arrays reused."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numba
import numpy as np
import pytest
import specialist
from side_by_side import ASSUR

import assur

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from pytest_benchmark.fixture import BenchmarkFixture
    from specialist import Float

THREADS = 2
# A design space of 72 positions each; designs near each other at 360.
SPACE, FEW = 100_000, np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
NEAR, MANY = 10_000, np.linspace(0.0, 2 * np.pi, 360, endpoint=False)
RANDOM = np.random.default_rng(3)


@dataclass(frozen=True)
class Sweep:
    """A batch (made anew in every round), its request, and the specialist's kernel."""

    one: assur.Mechanism
    dimensions: dict[str, Float]
    q: Float
    outputs: tuple[str, ...]
    order: int
    kernel: Callable[[Sequence[Float]], None]
    arrays: tuple[Float, ...]

    def assur(self, out: assur.Motion | None = None) -> assur.Motion:
        batch = self.one.with_dimensions(self.dimensions)
        return batch.solve(
            self.q, self.order, self.outputs, on_error="nan", threads=THREADS, out=out
        )

    def found(self, motion: assur.Motion) -> list[Float]:
        """The arrays of a motion in the kernel's order."""
        found = []
        for name in self.outputs:
            kind = motion.joint if name in self.one.joints else motion.link
            track = motion.slide(name) if name in self.one.slides else kind(name)
            found += [track.value, *(getattr(track, f"d{k}") for k in range(1, self.order + 1))]
        return found

    def check(self) -> None:
        """Assert that both find the same, within 1e-8 of what is not near a dead point."""
        self.kernel(self.arrays)
        motion = self.assur()
        good = motion.condition < 1e3
        for ours, theirs in zip(self.found(motion), self.arrays, strict=True):
            difference = (ours - theirs)[good]
            difference -= 2 * np.pi * np.round(difference / (2 * np.pi))
            assert np.abs(difference).max() < 1e-8


def space(six_bar: bool) -> Sweep:
    """Random four-bars or Stephenson III six-bars: the position of a traced point."""
    joints = {"A": (0, 0), "B": (0, 1), "C": (2.5, 2.0), "D": (3.2, 0), "P": (1.0, 2.0)}
    links = {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}
    lengths = RANDOM.uniform(0.5, 4.0, (4, SPACE))
    point = RANDOM.uniform(-1.0, 2.0, (2, SPACE))
    names = ["crank.length", "coupler.length", "rocker.length", "ground.D.x"]
    values = [*lengths, *point]
    names += ["coupler.P.x", "coupler.P.y"]
    arrays = (np.zeros((SPACE, len(FEW), 2)),)
    cos, sin = np.cos(FEW), np.sin(FEW)

    def four_bars(out: Sequence[Float]) -> None:
        specialist.four_bar_point(lengths, point, cos, sin, out[0])

    if not six_bar:
        one = assur.Mechanism(joints, {n: list(of) for n, of in links.items()}, "crank")
        columns = dict(zip(names, values, strict=True))
        return Sweep(one, columns, FEW, ("P",), 0, four_bars, arrays)
    joints |= {"E": (6.0, 0.5), "S": (4.0, 3.5), "T": (3.0, 4.5)}
    links |= {"ground": "ADE", "fifth": "PST", "sixth": "ES"}
    second = RANDOM.uniform([[2.0], [2.0], [3.0], [-1.0]], [[5.0], [5.0], [7.0], [2.0]], (4, SPACE))
    tip = RANDOM.uniform(-1.0, 2.0, (2, SPACE))
    names += ["fifth.length", "sixth.length", "ground.E.x", "ground.E.y", "fifth.T.x", "fifth.T.y"]
    values += [*second, *tip]

    def six_bars(out: Sequence[Float]) -> None:
        specialist.stephenson_point(lengths, point, second, tip, cos, sin, out[0])

    one = assur.Mechanism(joints, {n: list(of) for n, of in links.items()}, "crank")
    columns = dict(zip(names, values, strict=True))
    return Sweep(one, columns, FEW, ("T",), 0, six_bars, arrays)


def near(engine: bool) -> Sweep:
    """Slider-cranks or four-bars that turn fully: two outputs with two analogues each."""
    cos, sin = np.cos(MANY), np.sin(MANY)
    arrays = tuple(np.zeros((NEAR, len(MANY))) for _ in range(6))
    one: assur.Mechanism
    if engine:
        one = assur.SliderCrank(1.0, 3.0, 0.1)
        names, nominal = ["crank.length", "rod.length", "bore.offset"], [1.0, 3.0, 0.1]
        outputs, kernel = ("bore", "rod"), specialist.slider_crank
    else:
        one = assur.FourBar(1.0, 3.0, 2.5, 3.2)
        names = ["crank.length", "coupler.length", "rocker.length", "ground.D.x"]
        nominal, outputs, kernel = [1.0, 3.0, 2.5, 3.2], ("coupler", "rocker"), specialist.four_bar
    lengths = np.array(nominal)[:, None] * RANDOM.uniform(1.0, 1.01, (len(names), NEAR))

    def compute(out: Sequence[Float]) -> None:
        kernel(lengths, cos, sin, tuple(out[:3]), tuple(out[3:]))

    columns = dict(zip(names, lengths, strict=True))
    return Sweep(one, columns, MANY, outputs, 2, compute, arrays)


SWEEPS = {
    f"{SPACE} random four-bars x 72, traced point": lambda: space(False),
    f"{SPACE} random six-bars x 72, traced point": lambda: space(True),
    f"{NEAR} slider-cranks x 360, 2 outputs to order 2": lambda: near(True),
    f"{NEAR} four-bars x 360, 2 outputs to order 2": lambda: near(False),
}


@pytest.fixture(scope="module", params=SWEEPS)
def sweep(request: pytest.FixtureRequest) -> Sweep:
    numba.set_num_threads(THREADS)
    made = SWEEPS[request.param]()
    made.check()
    return made


@pytest.mark.parametrize("who", [ASSUR, "specialist", "memory"])
def test_sweep(benchmark: BenchmarkFixture, sweep: Sweep, who: str) -> None:
    benchmark.group = f"{sweep.one.structure.formula}, {len(sweep.q)} positions, 2 threads"
    if who == ASSUR:
        run: Callable[[], object] = partial(sweep.assur, sweep.assur())
    elif who == "specialist":
        run = partial(sweep.kernel, sweep.arrays)
    else:
        run = partial(specialist.fill, tuple(a.reshape(len(a), -1) for a in sweep.arrays), 1.5)
    benchmark.pedantic(run, rounds=9, warmup_rounds=2)
