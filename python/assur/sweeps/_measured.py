"""What the tables, axes and reasons of a sweep need of its measures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import ItemsView

    import numpy as np
    import numpy.typing as npt

    from assur._arrays import Float
    from assur._table import Column
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.designs import Designs


class Undefined(NamedTuple):
    """A metric without a value."""

    metric: str
    reason: str
    # The load, body or motor to blame.
    subject: str | None = None


class Asked(Protocol):
    """What was measured: see `Measuring`."""

    @property
    def conditions(self) -> Any: ...
    @property
    def metrics(self) -> Any: ...
    @property
    def q(self) -> Float: ...
    @property
    def gradient_by(self) -> tuple[str, ...]: ...
    def undefined(self, design: Mechanism) -> Undefined:
        """Return which metric of a design has no value, and why."""


class Measured(Protocol):
    """See `assur.Measures`."""

    _designs: Designs
    _measuring: Asked

    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def status(self) -> npt.NDArray[np.uint8]: ...
    @property
    def kept(self) -> npt.NDArray[np.intp]: ...
    @property
    def missed(self) -> npt.NDArray[np.intp]: ...
    def designs(self, indices: Any) -> Mechanism: ...
    def _metric_column(self, name: str, shown: str, values: Float, degrees: bool) -> Column: ...
    def items(self) -> ItemsView[str, Float]: ...
