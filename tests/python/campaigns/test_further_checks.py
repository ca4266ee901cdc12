"""A sample of what campaigns ask besides, and proof that the checks detect faults."""

from __future__ import annotations

import random
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur._arrays import as_number
from campaigns import campaign_cases
from campaigns.checks.campaign_cylinders import Cylinders
from campaigns.checks.campaign_ends import Ends
from campaigns.checks.campaign_flat import Flat
from campaigns.checks.campaign_resting import Resting
from campaigns.checks.campaign_saved import Saved
from campaigns.checks.campaign_sweeps import Covered, Swept
from campaigns.checks.campaign_turned import Turned
from campaigns.checks.campaign_units import InUnits
from campaigns.checks.campaign_variants import Variants, variant_of
from campaigns.checks.everything_asked import asked
from models.machines import machine_models
from models.machines.resting_models import resting_case
from models.mechanisms import dyad_models, named_models
from models.mechanisms.cylinder_models import cylinder_case
from models.mechanisms.flat_models import flat_case
from models.mechanisms.frames import Frame
from models.mechanisms.mechanism_data import Description, arguments
from models.mechanisms.mixed_models import mixed_case
from models.mechanisms.variants import Variant, framed, redrawn, renamed, shuffled
from oracles.kinematics import variant_queries
from oracles.kinematics.variant_results import Pairing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from campaigns.campaign_report import Findings

higher_case = campaign_cases.MAKE["higher"]
# The check, how its cases are drawn, and which seeds: each about a second at most.
SAMPLE: dict[str, tuple[Callable[[Any], Findings], Callable[[int], Any], Iterable[int]]] = {
    "descriptions of class II": (Variants, campaign_cases.random_case, (295, *range(302, 309))),
    "descriptions of mixed groups": (Variants, mixed_case, (0, 2, 3, 5, 1960, 40131)),
    "descriptions of higher groups": (Variants, higher_case, (0, 1, 2, 3, 768)),
    # In 19267 a joint stands still beside a dead point.
    "limits and extremes of class II": (Ends, campaign_cases.random_case, [*range(40, 54), 19267]),
    "limits and extremes of mixed groups": (Ends, mixed_case, range(4)),
    "limits and extremes of higher groups": (Ends, higher_case, range(4)),
    "sweeps of class II": (Swept, campaign_cases.random_case, range(10, 30)),
    "sweeps of mixed groups": (Swept, mixed_case, (20, 21, 22)),
    "files of class II": (Saved, campaign_cases.random_case, range(20)),
    "files of mixed groups": (Saved, mixed_case, range(20)),
    "files of higher groups": (Saved, higher_case, range(20)),
    "tables that end": (Covered, machine_models.machine_case, range(20)),
    "other units": (InUnits, machine_models.machine_case, (0, 1, 91, 591)),
    "other frames": (Turned, machine_models.machine_case, range(5, 17)),
    "pairs at rest": (Resting, resting_case, range(52, 64)),
    "nearly flat drawings": (Flat, flat_case, range(320, 360)),
    "cylinders": (Cylinders, cylinder_case, (0, 1)),
}


@pytest.mark.parametrize("what", SAMPLE)
def test_a_sample(what: str) -> None:
    check, make, seeds = SAMPLE[what]
    failures = [f"{seed}: {text}" for seed in seeds for text in check(make(seed)).report.failures]
    assert not failures, "\n".join(failures[:10])


# Driven by the angle between two moving links: both turn, and either may be the one whose angle is
# nearest to that before the gap.
@pytest.mark.parametrize("seed", [178, 329])
def test_turns_behind_a_gap_are_the_same_in_any_order(seed: int) -> None:
    d = campaign_cases.random_case(seed).description
    m = assur.Mechanism(**arguments(d))
    p = Pairing(d, m, shuffled(Variant.same(d), random.Random(seed)))
    assert not list(p.motions(float(m.q0) + np.linspace(-3.1, 3.1, 150)))


# -- what is drawn ----------------------------------------------------------------------------


def test_every_list_is_shuffled_and_every_step_is_taken() -> None:
    steps: set[str] = set()
    moved = dict.fromkeys(("joints", "links", "slides", "joints of links"), 0)
    for seed in range(40):
        d = campaign_cases.random_case(seed).description
        v = shuffled(Variant.same(d), random.Random(seed))
        for what in ("joints", "links", "slides"):
            moved[what] += list(getattr(d, what)) != list(getattr(v.description, what))
        moved["joints of links"] += any(v.description.links[n] != own for n, own in d.links.items())
        m = assur.Mechanism(**arguments(d))
        steps |= set(variant_of(d, m, random.Random(seed)).steps)
    assert steps == {"redrawn", "shuffled", "renamed", "framed"}
    assert min(moved.values()) >= 10


def test_a_part_turns_as_one_body_and_its_pairs_rub() -> None:
    resting = [len(resting_case(seed).resting) for seed in range(16)]
    assert sum(count > 1 for count in resting) >= 8


def test_nearly_flat_drawings_are_nearly_flat() -> None:
    conditions = []
    for seed in range(30):
        case = flat_case(seed)
        try:
            m = assur.Mechanism(**arguments(case.description))
        except assur.StructureError:
            continue
        conditions.append(float(m.solve(m.q0, order=0, on_error="nan").condition))
    assert sum(condition > 1e4 for condition in conditions) >= 10


# -- the checks detect faults -----------------------------------------------------------------


def four_bar() -> tuple[Description, assur.Mechanism]:
    d = named_models.crank_rocker()
    return d, assur.Mechanism(**arguments(d))


def pairing(change: Callable[[Variant], Variant]) -> Pairing:
    d, m = four_bar()
    return Pairing(d, m, change(Variant.same(d)))


def steps(v: Variant) -> Variant:
    rng = random.Random(4)
    return framed(renamed(shuffled(v, rng), rng), Frame(0.7, (1.0, -2.0), mirror=True))


def test_a_variant_has_the_same_motion() -> None:
    p = pairing(steps)
    q = float(p.one.q0) + np.linspace(-3.0, 3.0, 20)
    assert not list(p.motions(q))
    assert not list(variant_queries.same_assemblies(p, np.array([1.0])))
    assert not list(variant_queries.same_finds(p, "link", "rocker", 1.6))


def test_another_position_of_the_motion_is_the_same_mechanism() -> None:
    d, m = four_bar()
    q = np.array([float(m.q0) + 1.0])
    p = Pairing(d, m, redrawn(d, m, q))
    assert float(p.two.q0) == pytest.approx(float(q[0]))
    assert not list(p.motions(float(m.q0) + np.linspace(-3.0, 3.0, 20)))


@pytest.mark.parametrize("off", [1e-9, 1e-3])
def test_another_mechanism_is_not_a_variant(off: float) -> None:
    def changed(v: Variant) -> Variant:
        name = "C"
        x, y = v.description.joints[name]
        joints = {**v.description.joints, name: (x + off, y)}
        return steps(replace(v, description=replace(v.description, joints=joints)))

    p = pairing(changed)
    q = float(p.one.q0) + np.linspace(-3.0, 3.0, 20)
    assert list(p.motions(q))


def shifted(monkeypatch: pytest.MonkeyPatch, by: float) -> None:
    """Limits that are off."""
    own = assur.Mechanism.limits

    def limits(self: assur.Mechanism, *args: Any, **more: Any) -> assur.Limits:
        found = own(self, *args, **more)
        return replace(found, intervals=found.intervals + by)

    monkeypatch.setattr(assur.Mechanism, "limits", limits)


@pytest.mark.parametrize("by", [1e-4, np.pi])
def test_limits_that_are_off_are_found(by: float, monkeypatch: pytest.MonkeyPatch) -> None:
    case = rocker_case()
    assert not any("limits" in text for text in Ends(case).report.failures)
    shifted(monkeypatch, by)
    assert any(text.startswith("limits") for text in Ends(case).report.failures)


def rocker_case() -> dyad_models.Case:
    """A four-bar that its rocker drives between two dead points."""
    d = replace(named_models.crank_rocker(), drivers=[("angle", "rocker", "ground")])
    return dyad_models.Case(d, "rocker", (), 0)


def test_an_extreme_that_is_beaten_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    own = assur.Mechanism.extremes

    def extremes(self: assur.Mechanism, name: str, order: int = 0, **more: Any) -> Any:
        found = own(self, name, order=order, **more)
        least = found.min._replace(value=as_number(found.min.value + 1e-4))
        return replace(found, min=least)

    d = named_models.crank_rocker()
    case = dyad_models.Case(d, "crank", (), 0)
    assert not Ends(case).report.failures
    monkeypatch.setattr(assur.Mechanism, "extremes", extremes)
    assert any(text.startswith("extremes") for text in Ends(case).report.failures)


class Faulty:
    """A result as the library might give it, whose properties fail."""

    @property
    def good(self) -> float:
        return 1.0

    @property
    def documented(self) -> float:
        message = "friction locks the machine"
        raise assur.MotionError(message)

    @property
    def panics(self) -> float:
        message = "a fault of assur, not of your input"
        raise assur.AssurError(message)

    def fails(self) -> float:
        return 1.0 / 0.0

    def warns(self) -> float:
        return float(np.float64(1.0) / np.float64(0.0))

    def needs(self, name: str) -> str:
        raise ValueError(name)


def test_what_a_result_raises_is_found() -> None:
    found = [text.split(":")[0] for text in asked(Faulty())]
    assert found == ["Faulty.fails", "Faulty.panics", "Faulty.warns"]


def test_a_sweep_that_hands_back_other_designs_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    case = dyad_models.Case(named_models.crank_rocker(), "crank", (), 1)
    measures = type(
        assur.sweep(four_bar()[1], {}, [0.0, 0.1], metrics={"x": assur.metric.mean("C.x")})
    )
    own = measures.designs

    def designs(self: Any, indices: Any) -> Any:
        found = own(self, indices)
        return found.with_dimensions({"coupler.length": found.dimensions["coupler.length"] * 1.01})

    monkeypatch.setattr(measures, "designs", designs)
    assert any(text.startswith("sweep designs") for text in Swept(case).report.failures)


def test_a_run_in_other_units_that_is_off_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    case = machine_models.machine_case(7)
    own = InUnits.run_of

    def run_of(self: InUnits, machine: assur.Machine, u: Any) -> Any:
        run = own(self, machine, u)
        if machine is not self.machine:
            run.q = run.q * (1.0 + 1e-4)
        return run

    monkeypatch.setattr(InUnits, "run_of", run_of)
    kinds = {text.split(":")[0] for text in InUnits(case).report.failures}
    assert {"units run", "units end"} & kinds
