"""The crank-rocker with friction, in the convention of its paper.

Crank l₁ turns at A, coupler l₂, rocker l₃ at D, ground l₄ = AD, which may change with time. The
crank angle φ₁ is 0 where the crank's pin B is farthest from D; with A at the origin, D is at
(−l₄, 0). Angles are counter-clockwise, rad.

References
----------
V. K. Manzhosov, T. E. Petrova, *Modelling of the motion of the crank-rocker mechanism with
non-ideal constraints* (in Russian).
"""

from assur.papers.crank_rocker.figures import (
    plot_least_angle,
    plot_push_and_pull,
    plot_transmission,
    plot_zone,
)
from assur.papers.crank_rocker.jamming import JammingEvent, JammingRun, run
from assur.papers.crank_rocker.theory import (
    Solution,
    Table1,
    blocked,
    crank_turns,
    grashof,
    ground_range,
    least_transmission_angle,
    solve,
    table1,
    transmission_extremes,
)

__all__ = [
    "JammingEvent",
    "JammingRun",
    "Solution",
    "Table1",
    "blocked",
    "crank_turns",
    "grashof",
    "ground_range",
    "least_transmission_angle",
    "plot_least_angle",
    "plot_push_and_pull",
    "plot_transmission",
    "plot_zone",
    "run",
    "solve",
    "table1",
    "transmission_extremes",
]
