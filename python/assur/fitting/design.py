"""A design that a fit has found: its errors by target."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from assur.fitting.found import Fit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float

__all__ = ["DesignFit"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DesignFit(Fit):
    """A design that meets targets; made by `assur.fit`.

    Beside what every `Fit` has. Its `error` is the root mean square of what is missed: of a path
    the distance of its points over their root mean square radius, of poses the same with angles
    times their length, of a function rad or m, of a metric its units. Of several targets it is the
    root mean square of all errors.

    Attributes
    ----------
    errors : mapping of str to float
        The error of each target.
    positions : mapping of str to ndarray
        The driver's coordinate at each position of each target, (N,), rad or m.
    placement : tuple of float or None
        Of a path up to similarity: (a, b, x, y), which take a point p of the mechanism, as a
        complex number, to the target: (a + ib) p + x + iy.

    Examples
    --------
    >>> import assur
    >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    >>> arch = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5), (1.5, 0.4), (2.0, 0.0)]
    >>> fit = assur.fit(m, {"P": arch}, evaluations=1)[0]
    >>> list(fit.errors), fit.placement is None
    (['P'], True)
    >>> fit.mechanism.solve(fit.q).joint("P").value.shape
    (5, 2)
    """

    errors: Mapping[str, float]
    positions: Mapping[str, Float]
    placement: tuple[float, ...] | None

    def _first_line(self) -> str:
        by_target = ", ".join(f"{name} {error:.4g}" for name, error in self.errors.items())
        return f"error {self.error:.4g}" + (f" ({by_target})" if len(self.errors) > 1 else "")
