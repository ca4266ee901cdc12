"""From a description to a compiled mechanism: names, mobility, groups, plan."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import assur
import spaces
from subject import OURS, Case, Contender, Subject

if TYPE_CHECKING:
    from collections.abc import Callable


def case(quick: bool) -> Case:
    counts = (5, 10) if quick else (5, 10, 25, 50, 100, 250, 500)
    subjects: dict[str | int, Callable[[], Subject]] = {
        2 * dyads + 1: partial(subject, dyads) for dyads in counts
    }
    return Case("construction", "call", subjects, axis="links", every_level=False)


def side_by_side(dyads: int) -> assur.Mechanism:
    """All dyads on the pin of one crank."""
    joints = {"O": (0.0, 0.0), "C0": (0.0, 0.5)}
    links = {"ground": ["O"], "crank": ["O", "C0"]}
    for k in range(1, dyads + 1):
        x = 3.0 + 0.01 * k
        joints |= {f"D{k}": (x, -2.5), f"C{k}": (x, 0.51)}
        links["ground"].append(f"D{k}")
        links |= {f"coupler{k}": ["C0", f"C{k}"], f"rocker{k}": [f"D{k}", f"C{k}"]}
    return assur.Mechanism(joints, links, "crank")


def subject(dyads: int) -> Subject:
    contenders = {
        f"{OURS}, a chain": Contender(lambda: spaces.chain(dyads, 1), None),
        f"{OURS}, side by side": Contender(lambda: side_by_side(dyads), None),
    }
    return Subject(1, 1, contenders)
