"""The comparison of reactions sees faults, and random machines have all that can be reacted to."""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import numpy as np
import pytest

from models.machines.machine_models import DRAWN
from models.machines.reaction_machines import Case, reaction_case
from oracles.dynamics.reaction_shares import Compared, Worst
from oracles.dynamics.reaction_view import View

SEEDS = range(3)  # with slides on moving links


class WrongMoment(View):
    def slide(self, name: str) -> Any:
        own = super().slide(name)
        own.moment = -own.moment
        return own


class WrongShakingMoment(View):
    @property
    def shaking_moment(self) -> Any:
        return -super().shaking_moment


class WrongForce(View):
    def joint(self, name: str, on: str) -> Any:
        return super().joint(name, on) * (1 + 1e-11)


class Missing(View):
    def joint(self, name: str, on: str) -> Any:
        return super().joint(name, on) * (math.nan if on == "ground" else 1.0)


class WrongDriver(View):
    @property
    def driver(self) -> Any:
        return -super().driver


def compared(view: type[View]) -> Worst:
    worst = Worst()
    for seed in SEEDS:
        case = reaction_case(seed)
        where = case.q, case.speed, case.acceleration
        Compared(case, worst, view(case.machine, *where), View(case.machine, *where).driver)
    return worst


def test_the_oracle_agrees_with_itself() -> None:
    assert compared(View).greatest < 8.0


@pytest.mark.parametrize(
    ("view", "kinds"),
    [
        (WrongMoment, {"moment", "balance of moments"}),
        (WrongShakingMoment, {"shaking moment", "frame's moment"}),
        (WrongForce, {"joint", "balance", "frame"}),
        (Missing, {"joint", "frame", "frame's moment"}),
        (WrongDriver, {"driver", "power", "balance of moments"}),
    ],
)
def test_faults_are_seen(view: type[View], kinds: set[str]) -> None:
    shares = compared(view).shares
    assert {kind for kind in kinds if shares[kind][0] <= 64.0} == set()


def test_every_kind_is_drawn() -> None:
    """Classes, slides on moving links, links without joints, drivers, loads, pins of three."""
    found: Counter[str] = Counter()
    for seed in range(200):
        case: Case = reaction_case(seed)
        m = case.mechanism
        found[f"class {m.structure.cls}"] += 1
        found[f"{np.size(m.q0)} drivers"] += 1
        found["driven slide"] += any(kind == "slide" for kind, *_ in case.description.drivers)
        found["driven coupler"] += any(
            kind == "angle" and rest[1:] != ["ground"] for kind, *rest in case.description.drivers
        )
        found["moving guide"] += any(s.on != "ground" for s in m.slides.values())
        found["no joint"] += any(not own for own in m.links.values())
        at = Counter(joint for own in m.links.values() for joint in own)
        found["pin of three"] += max(at.values()) > 2
        found.update({type(load).__name__ for load in case.machine.loads})
        assert set(case.machine.bodies) == set(m.links) - {"ground"}
    wanted = {
        *(f"class {k}" for k in (2, 3, 4, 5)),
        *("1 drivers", "2 drivers", "driven slide", "driven coupler"),
        *("moving guide", "no joint", "pin of three"),
        *DRAWN,
    }
    assert {name for name in wanted if found[name] < 5} == set()
