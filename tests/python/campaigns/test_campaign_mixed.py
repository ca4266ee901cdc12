"""A sample of the campaign on mixed groups, its models, and proof that checks detect faults."""

from __future__ import annotations

import pickle
from collections import Counter
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from campaigns import campaign
from campaigns.checks import campaign_checks as checks
from campaigns.checks import campaign_mixed
from campaigns.checks.campaign_mixed import Mixed
from campaigns.checks.campaign_redundant import Overconstrained
from models.mechanisms import mixed_models, named_models, redundant_models
from models.mechanisms.mechanism_data import Description, arguments
from oracles.kinematics.closures import Closures
from oracles.kinematics.pair_jacobian import regularity

if TYPE_CHECKING:
    from pathlib import Path

COUNT = 48  # `make campaign` asks 100 000
PARTS = 6


@pytest.mark.parametrize("part", range(PARTS))
def test_mixed_groups_move_as_they_should(part: int) -> None:
    report = campaign.run(campaign.work(COUNT, "mixed")[part::PARTS], besides=False)
    assert not report.failures, "\n".join(report.failures[:10])
    counts = report.counts
    assert counts["mechanisms"] + counts["overconstrained"] == COUNT // PARTS


# Rods with pins in line, gaps of other dyads, few digits: found in longer scans.
def test_an_end_beside_a_narrow_pole_is_one_at_infinity() -> None:
    # A slide runs off like 9e-6 m rad over the distance, which is 8e-7 rad at the end.
    report = campaign.run([("mixed", 33578)], besides=False)
    assert not report.failures
    assert report.counts["infinite"] == 1


def test_the_fold_of_a_group_beside_that_of_its_dyad_is_one() -> None:
    # 1e-9 m from each other.
    assert not campaign.run([("mixed", 68141)], besides=False).failures


def test_an_error_of_differences_that_passes_through_zero_is_accepted() -> None:
    assert not campaign.run([("mixed", 49727)], besides=False).failures


# Two drivers, a link turned by about half a turn across a gap: unwrapped inconsistently. And one
# driver, between a gap and a joint at infinity.
@pytest.mark.parametrize("seed", [15343, 19549, 22245, 68526])
def test_turns_are_counted_alike_across_a_gap(seed: int) -> None:
    assert not campaign.run([("mixed", seed)], besides=False).failures


@pytest.mark.parametrize(
    "seed", [70, 112, 286, 360, 385, 642, 1326, 2806, 2893, 3263, 3268, 4315, 4333, 4699, 4850]
)
def test_rounded_drawings_once_misjudged_move_or_are_refused(seed: int) -> None:
    assert not campaign.run([("overconstrained", seed)], besides=False).failures


def test_a_group_ends_where_two_of_its_branches_cross() -> None:
    """Links that are hung on the crank's own pivot come into line with the crank."""
    report = campaign.run([("mixed", 3521)], besides=False)
    assert not report.failures
    assert report.counts["crossings"] == 1


def test_a_campaign_goes_on_where_it_was_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(campaign, "PORTION", 2)
    kept = tmp_path / "kept"
    whole = campaign.run_all(6, 1, "class II", kept)
    size = kept.stat().st_size
    with kept.open("rb") as file:
        pickle.load(file)
        first = file.tell()
    kept.write_bytes(kept.read_bytes()[:first])
    assert campaign.run_all(6, 1, "class II", kept) == whole
    assert kept.stat().st_size == size
    # Nothing is done again.
    monkeypatch.setattr(campaign, "run", None)
    assert campaign.run_all(6, 1, "class II", kept) == whole


# -- what is drawn ----------------------------------------------------------------------------


def test_groups_of_all_classes_stand_before_and_behind_dyads() -> None:
    classes: Counter[int] = Counter()
    before = behind = 0
    for seed in range(60):
        case = mixed_models.mixed_case(seed)
        groups = assur.Mechanism(**arguments(case.description)).structure.groups
        classes.update(group.cls for group in groups)
        order = [group.cls > 2 for group in groups]
        before += any(a and not b for a, b in pairwise(order))
        behind += any(b and not a for a, b in pairwise(order))
    assert {2, 3, 4, 5} <= set(classes)
    assert min(before, behind) >= 10


def test_anything_drives() -> None:
    cases = [mixed_models.mixed_case(seed) for seed in range(150)]
    drivers = [driver for case in cases for driver in case.description.drivers]
    assert {case.driver for case in cases} == {*mixed_models.ONE, *mixed_models.TWO, "moved"}
    assert {kind for kind, *_ in drivers} == {"angle", "slide"}
    # Relative to a moving link that the driven one shares no joint with.
    apart = 0
    for case in cases:
        links = case.description.links
        for kind, name, *other in case.description.drivers:
            if kind == "angle" and other[0] != "ground":
                apart += not set(links[name]) & set(links[other[0]])
    assert apart > 0


def test_a_drawing_beside_a_dead_point_is_not_regular() -> None:
    d = named_models.crank_rocker()
    assert regularity(d) > mixed_models.REGULAR
    (bx, by), (dx, dy) = d.joints["B"], d.joints["D"]
    flat = {**d.joints, "C": (0.5 * (bx + dx), 0.5 * (by + dy))}
    assert regularity(replace(d, joints=flat)) < 1e-12


def test_overconstrained_drawings_need_more_rows_than_unknowns() -> None:
    for seed in range(9):
        case = redundant_models.redundant_case(seed)
        assert regularity(case.exact) == 0.0
        assert regularity(case.exact, overconstrained=True) > mixed_models.REGULAR


# -- the checks detect faults -----------------------------------------------------------------


@pytest.mark.parametrize("name", sorted(named_models.NAMED))
def test_closures_hold_and_see_a_changed_dimension(name: str) -> None:
    d = named_models.NAMED[name]()
    m = assur.Mechanism(**arguments(d))
    path = campaign_mixed.Path(m, np.random.default_rng(0))
    motion = m.solve(path.q(path.grid), order=0, on_error="nan")
    reached = motion.status <= assur.Status.SINGULAR
    assert reached.any()
    own = {name: np.asarray(value) for name, value in m.dimensions.items()}
    assert Closures(d, own).misfit(motion)[0][reached].max() < checks.TERMS
    for dimension, value in own.items():
        changed = Closures(d, {**own, dimension: value + 1e-11})
        assert changed.misfit(motion)[0][reached].max() > checks.TERMS, dimension


def test_closures_see_a_driver_that_is_not_at_q() -> None:
    d = named_models.five_bar()
    m = assur.Mechanism(**arguments(d))
    motion = m.solve(np.array([m.q0]), order=0)
    closures = Closures(d, dict(m.dimensions))
    assert closures.misfit(motion)[0].max() < checks.TERMS
    motion.q = motion.q + np.array([0.0, 1e-11])
    assert closures.misfit(motion)[0].max() > checks.TERMS


def test_determinants_vanish_at_a_dead_point() -> None:
    """The rocker of a four-bar drives: dead where crank and coupler are in line."""
    d = named_models.crank_rocker()
    rocker = replace(d, drivers=[("angle", "rocker", "ground")])
    crank, m = (assur.Mechanism(**arguments(one)) for one in (d, rocker))
    closures = Closures(rocker, dict(m.dimensions))
    length = crank.dimensions["crank.length"] + crank.dimensions["coupler.length"]
    a, b, c = (crank.dimensions[n] for n in ("rocker.length", "ground.D.x", "ground.A.x"))
    ground = b - c
    # The triangle A C D with A C = crank + coupler.
    angle = np.arccos((ground**2 + length**2 - a**2) / (2 * ground * length))
    motion = crank.solve(angle, order=0)
    regular = crank.solve(angle + 1.0, order=0)
    assert abs(closures.determinants(motion)) < 1e-12 * abs(closures.determinants(regular))


def test_bits_that_differ_in_a_batch_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def other(m: assur.Mechanism, rng: np.random.Generator) -> assur.Mechanism:
        """A batch of which the first is not the drawing to the last bit."""
        return m.with_dimensions({n: v + 1e-15 * rng.random(4) for n, v in m.dimensions.items()})

    monkeypatch.setattr(campaign_mixed, "designs", other)
    failures = [Mixed(mixed_models.mixed_case(seed)).report.failures for seed in range(3)]
    assert any(text.startswith("bits") for one in failures for text in one)


def test_an_overconstrained_mechanism_that_does_not_fit_is_found() -> None:
    case = next(
        case
        for case in map(redundant_models.redundant_case, range(30))
        if case.kind == "locomotive" and case.everywhere
    )
    name = list(case.exact.joints)[-1]
    x, y = case.exact.joints[name]
    off = replace(case.exact, joints={**case.exact.joints, name: (x + 1e-3, y)})
    wrong = replace(case, exact=off, typed=off)
    assert Overconstrained(wrong).report.failures


def test_rates_along_a_path_of_two_drivers_are_its_own() -> None:
    d: Description = named_models.five_bar()
    m = assur.Mechanism(**arguments(d))
    path = campaign_mixed.Path(m, np.random.default_rng(1))
    t = np.array([0.1, 0.1 + 1e-6])
    sample = path.sample(m, t)
    slope = (sample.value[1] - sample.value[0]) / 1e-6
    assert np.abs(slope - sample.rate.mean(axis=0)).max() < 1e-8
