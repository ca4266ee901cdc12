"""What is asked of one mechanism or machine in so many, besides the checks of every one.

And what is drawn beside one in so many: cases that no other generator draws.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from campaigns.checks.campaign_cylinders import Cylinders
from campaigns.checks.campaign_ends import Ends
from campaigns.checks.campaign_flat import Flat
from campaigns.checks.campaign_resting import Resting
from campaigns.checks.campaign_saved import Saved
from campaigns.checks.campaign_sweeps import Covered, Swept
from campaigns.checks.campaign_turned import Turned
from campaigns.checks.campaign_units import InUnits
from campaigns.checks.campaign_variants import Variants
from models.machines.resting_models import resting_case
from models.mechanisms.cylinder_models import cylinder_case
from models.mechanisms.flat_models import flat_case

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from campaigns.campaign_report import Findings

# Most cost as much as all other checks of a mechanism, and up to ten times as much of a machine.
ASKED: dict[str, dict[type[Any], int]] = {
    "random": {Saved: 1, Variants: 5, Ends: 5, Swept: 20},
    "changing": {Saved: 1},
    "higher": {Saved: 1, Variants: 5, Ends: 2, Swept: 10},
    "mixed": {Saved: 1, Variants: 5, Ends: 20, Swept: 40},
    "machine": {InUnits: 1, Turned: 2, Covered: 2},
}
DRAWN: dict[str, dict[type[Any], tuple[Callable[[int], Any], int]]] = {
    "random": {Flat: (flat_case, 10), Cylinders: (cylinder_case, 200)},
    "machine": {Resting: (resting_case, 5)},
}


def further(kind: str, seed: int, case: Any) -> Iterator[Findings]:
    """The findings of what is asked of this mechanism or machine, or drawn beside it."""
    for number, (check, one_in) in enumerate(ASKED.get(kind, {}).items()):
        if seed % one_in == number % one_in:
            yield check(case)
    for check, (make, one_in) in DRAWN.get(kind, {}).items():
        if seed % one_in == 0:
            yield check(make(seed // one_in))
