"""The metrics of a sweep."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.designs import Designs

__all__ = ["Measures"]

Float: TypeAlias = npt.NDArray[np.float64]


class Measures(Mapping[str, Float]):
    """The metrics of designs by name, arrays of shape S; made by `assur.sweep`.

    Attributes
    ----------
    status : numpy.ndarray
        A `Status` of each design, S: that of a position that cannot be solved, if there is
        one, or the worst. With a ``SINGULAR`` position metrics of derivatives are NaN.
    kept : numpy.ndarray
        Indices (of designs in C order) of those that move over all of q and meet all
        conditions, ascending. All others have NaN.
    """

    def __init__(
        self,
        values: dict[str, Float],
        status: npt.NDArray[np.uint8],
        kept: npt.NDArray[np.intp],
        designs: Designs,
    ) -> None:
        self._values = values
        self.status = status
        self.kept = kept
        self._designs = designs

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the designs."""
        return self.status.shape

    def designs(self, indices: int | Sequence[int] | npt.NDArray[np.intp]) -> Mechanism:
        """Return the designs with these indices (in C order): one mechanism, or a batch (n,).

        Examples
        --------
        >>> import assur, numpy as np
        >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        >>> space = {"coupler.length": np.linspace(2.0, 4.0, 21)}
        >>> angle = {"angle": assur.metric.least_transmission("C")}
        >>> found = assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), space, q, metrics=angle)
        >>> best = found.designs(np.nanargmax(found["angle"]))
        >>> round(best.dimensions["coupler.length"], 3)
        2.0
        """
        wanted = np.asarray(indices)
        count = self._designs.count
        whole = wanted.dtype.kind in "iu" and wanted.ndim <= 1
        if not (whole and ((-count <= wanted) & (wanted < count)).all()):
            message = f"designs: {short(indices)}: indices below {count} are needed, one or (n,)"
            raise InputError(message)
        some = self._designs.some(np.atleast_1d(wanted) % max(1, count))
        return some if wanted.ndim else some.design(0)

    def __getitem__(self, name: str) -> Float:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        names = ", ".join(map(repr, self._values))
        return f"<assur.Measures of {names}, shape {self.shape}, {len(self.kept)} kept>"
