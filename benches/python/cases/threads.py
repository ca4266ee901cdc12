"""One thread beside two: what the second one gains, where arithmetic alone gains most."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import assur
import spaces
from assur import metric
from assur.examples import loom
from subject import OURS, Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from spaces import Space
    from subject import Float

ONE, TWO = f"{OURS}, 1 thread", f"{OURS}, 2 threads"


def case(quick: bool) -> Case:
    few, many, space = (10, 20, 50) if quick else (20, 10_000, 100_000)
    subjects: dict[str | int, Callable[[], Subject]] = {
        f"{few} four-bars × 360, two analogues": partial(
            sweeps, few, 360, ("coupler", "rocker"), 2, spaces.turning_four_bars
        ),
        f"{many} four-bars × 360, two analogues": partial(
            sweeps, many, 360, ("coupler", "rocker"), 2, spaces.turning_four_bars
        ),
        f"{space} random six-bars × 72, a point": partial(
            sweeps, space, 72, ("T",), 0, spaces.random_six_bars
        ),
        f"{many // 10} of class IV × 360, positions": partial(
            sweeps, many // 10, 360, tuple("2345678"), 0, partial(spaces.near, loom())
        ),
        f"{space} random four-bars × 72, a metric": partial(metrics, space),
    }
    if installed("numba"):
        subjects["multiplications alone"] = partial(arithmetic, 20 if quick else 5000)
    return Case("threads", "design", subjects, plotted=False)


def sweeps(
    designs: int,
    positions: int,
    outputs: Sequence[str],
    order: int,
    make: Callable[[int], Space],
) -> Subject:
    space, q = make(designs), turn(positions)

    def run(threads: int, out: assur.Motion | None = None) -> assur.Motion:
        return assur.sweep(
            space.mechanism,
            space.columns,
            q,
            outputs=outputs,
            order=order,
            out=out,
            threads=threads,
        )

    def answer(motion: assur.Motion) -> list[Float]:
        return [motion.status.astype(float)]

    contenders = {
        ONE: Contender(partial(run, 1, run(1)), answer),
        TWO: Contender(partial(run, 2, run(2)), answer),
    }
    return Subject(designs, positions, contenders, designs)


def metrics(designs: int) -> Subject:
    space, q = spaces.random_four_bars(designs), turn(72)

    def run(threads: int) -> assur.Measures:
        asked = {"angle": metric.min_transmission_angle("C")}
        return assur.sweep(space.mechanism, space.columns, q, metrics=asked, threads=threads)

    def answer(measures: assur.Measures) -> list[Float]:
        return [measures["angle"]]

    contenders = {
        name: Contender(partial(run, threads), answer) for name, threads in ((ONE, 1), (TWO, 2))
    }
    return Subject(designs, 72, contenders, designs)


def arithmetic(count: int) -> Subject:
    import numba

    from rivals import specialist

    sums = np.ones(count)

    def run(threads: int) -> None:
        numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
        specialist.arithmetic(sums)

    contenders = {name: Contender(partial(run, threads)) for name, threads in ((ONE, 1), (TWO, 2))}
    return Subject(count, 1, contenders, count)
