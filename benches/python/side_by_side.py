"""A mechanism for `assur` and for the closed forms, with the same designs and positions."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from closed_form import blocked

from assur import _core

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from closed_form import Float, Form

    import assur

DESIGNS = 10_000
Q: Float = np.linspace(0, 2 * np.pi, 360, endpoint=False)
SIZE = f"{DESIGNS} designs x {len(Q)} positions"
ONE = f"1 design x {len(Q)} positions"

# The level is read once a process: `ASSUR_SIMD=baseline pytest benches/python -k assur`.
ASSUR = f"assur {_core.simd_level()}"


@dataclass(frozen=True)
class Case:
    """One mechanism or a batch of designs, and what is asked for."""

    mechanism: assur.Mechanism
    dimensions: Sequence[Any]
    outputs: Sequence[str]
    order: int
    # Arrays that are there already, for NumPy and for `assur`.
    out: Sequence[Float] = ()
    motion: assur.Motion | None = None

    @classmethod
    def make(
        cls,
        one: assur.Mechanism,
        names: Sequence[str],
        outputs: Sequence[str],
        order: int,
        designs: int | None,
    ) -> Case:
        """Return one mechanism, or designs with dimensions up to 1 % above its own."""
        values = [one.dimensions[name] for name in names]
        if designs is None:
            return cls(one, values, outputs, order)
        random = np.random.default_rng(1)
        columns = [x * random.uniform(1.0, 1.01, (designs, 1)) for x in values]
        rows = {name: column[:, 0] for name, column in zip(names, columns, strict=True)}
        case = cls(one.with_dimensions(rows), columns, outputs, order)
        out = [np.zeros_like(values) for _, values in case._arrays()]
        return replace(case, out=out, motion=case.assur())

    def assur(self, threads: int = 1, out: assur.Motion | None = None) -> assur.Motion:
        return self.mechanism.solve(
            Q, order=self.order, outputs=self.outputs, on_error="nan", threads=threads, out=out
        )

    def numpy(self, form: Form) -> Sequence[Float]:
        return form(*self.dimensions, Q)

    def blocked(self, form: Form, threads: int = 1) -> Sequence[Float]:
        return blocked(form, self.dimensions, Q, self.out, threads)

    def _arrays(self) -> Iterator[tuple[str, Float]]:
        """What `assur` finds, in the order of the closed forms."""
        motion = self.assur()
        for name in self.outputs:
            joint = name in self.mechanism.joints
            track = motion.joint(name) if joint else motion.link(name)
            for order in range(self.order + 1):
                values = getattr(track, f"d{order}") if order else track.value
                label = f"{name}, analogue {order}" if order else name
                if joint:
                    yield from ((f"{label}, {xy}", values[..., i]) for i, xy in enumerate("xy"))
                else:
                    yield label, values

    def check(self, *found: Sequence[Float]) -> None:
        """Assert that the closed forms' arrays agree with `assur` within 1e-9 m or rad."""
        for (name, expected), *others in zip(self._arrays(), *found, strict=True):
            for values in others:
                difference = np.subtract(values, expected)
                if name in self.mechanism.links:
                    difference -= math.tau * np.round(difference / math.tau)
                assert np.abs(difference).max() < 1e-9, name


ONE_THREAD: dict[str, Callable[[Case], object]] = {
    f"{ASSUR}, 1 thread": lambda case: case.assur(1),
}
MANY: dict[str, Callable[[Case], object]] = ONE_THREAD | {
    f"{ASSUR}, 2 threads": lambda case: case.assur(2),
    f"{ASSUR}, 1 thread, out=": lambda case: case.assur(1, case.motion),
    f"{ASSUR}, 2 threads, out=": lambda case: case.assur(2, case.motion),
}
