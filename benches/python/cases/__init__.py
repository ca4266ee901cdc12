"""The cases, in the order of the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cases import (
    assemblies,
    chains,
    classes,
    construction,
    control,
    find,
    flywheels,
    forces,
    gradients,
    grids,
    growth,
    jansen_legs,
    many_runs,
    metrics,
    one_design,
    random_four_bars,
    random_six_bars,
    runs,
    slider_cranks,
    steps,
    threads,
    turning_four_bars,
)

if TYPE_CHECKING:
    from subject import Case

MAKERS = (
    one_design.case,
    random_four_bars.case,
    random_six_bars.case,
    turning_four_bars.case,
    slider_cranks.case,
    jansen_legs.case,
    chains.case,
    classes.case,
    metrics.case,
    gradients.case,
    grids.case,
    growth.designs,
    growth.positions,
    threads.case,
    construction.case,
    assemblies.case,
    forces.case,
    flywheels.case,
    runs.case,
    many_runs.case,
    steps.case,
    control.case,
    find.case,
)


def cases(quick: bool) -> dict[str, Case]:
    """All cases by name, small ones if they are to be quick."""
    made = [make(quick) for make in MAKERS]
    return {case.name: case for case in made}
