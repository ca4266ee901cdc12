"""Why there is no front: which conditions are in the way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.errors import FitError
from assur.fitting.pareto.candidates import unit_of

if TYPE_CHECKING:
    from assur.fitting.pareto.candidates import Candidates
    from assur.fitting.pareto.evolution import Budget


def no_design(candidates: Candidates, budget: Budget) -> FitError:
    """Return the error that says what is in the way."""
    tried = f"{candidates.evaluations} designs were measured in {budget.elapsed:.3g} s"
    if not candidates.moving:
        message = f"no design within the bounds moves over all of q and has all metrics: {tried}"
        hint = "widen the bounds, vary more dimensions, or take fewer coordinates q"
        return FitError(f"{message}; {hint}", hint=hint)
    missed = [
        f"{condition!r} by {miss * unit_of(condition):.3g}"
        for condition, miss in zip(candidates.conditions, candidates.nearest, strict=True)
        if miss > 0.0
    ]
    message = (
        f"no design keeps all conditions: {tried}, {candidates.moving} of them move over all of q; "
        f"the nearest misses {', '.join(missed)}"
    )
    hint = "relax what is missed, widen the bounds, or go on for more generations"
    return FitError(f"{message}; {hint}", hint=hint)
