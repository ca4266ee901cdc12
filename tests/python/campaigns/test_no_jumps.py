"""Random mechanisms over whole turns: a short campaign, and that it sees what it is for.

`HYPOTHESIS_PROFILE=slow` asks 100 000 mechanisms; `make campaign` does the same on every core.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from campaigns import campaign
from campaigns import campaign_cases as cases
from campaigns.checks import campaign_checks as checks
from campaigns.checks.campaign_geometry import Geometry, Sample
from models.mechanisms import mechanism_data, mixed_models
from support.samples import sample

if TYPE_CHECKING:
    from collections.abc import Callable

    from campaigns.checks.campaign_geometry import Array

COUNT = sample(100, 100_000)
PARTS = 10


@pytest.mark.parametrize("part", range(PARTS))
def test_campaign(part: int) -> None:
    report = campaign.run(campaign.work(COUNT)[part::PARTS], besides=False)
    assert not report.failures, "\n".join(report.failures[:10])
    assert report.counts["mechanisms"] == COUNT // PARTS


# Islands between gaps, and guides that pass parallel beside a gap, found in longer scans.
@pytest.mark.parametrize("seed", [649, 1276, 1636, 5571, 17859, 22685, 66560])
def test_former_jumps_are_gone(seed: int) -> None:
    assert not campaign.run([("random", seed)], besides=False).failures


def test_a_motion_ends_at_two_folds_that_nearly_meet() -> None:
    """Some 1e-9 rad beyond the fold another branch continues, its determinant of the same sign."""
    m = assur.Mechanism(**mechanism_data.arguments(mixed_models.mixed_case(20118).description))
    fold = -1.612990846616
    before, behind = fold + np.geomspace(1e-10, 0.1, 200), fold - np.geomspace(1e-10, 0.1, 200)
    assert before.max() < m.q0
    x = m.solve(before, order=1).joint("J15")
    # Along the branch, with steps that its slopes know.
    change = np.diff(x.value[:, 0])
    slopes = x.d1[:, 0]
    assert (np.abs(slopes[:-1]) >= np.abs(slopes[1:])).all()
    between = np.sort(
        np.stack([slopes[:-1] * np.diff(before), slopes[1:] * np.diff(before)]), axis=0
    )
    assert ((between[0] <= change) & (change <= between[1])).all()
    assert (m.solve(behind, on_error="nan").status == assur.Status.LOST).all()


# -- the checks themselves: each detects its fault---------------------------------------------


def four_bar() -> mechanism_data.Description:
    return mechanism_data.Description(
        joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
        links={
            "ground": ["A", "D"],
            "crank": ["A", "B"],
            "coupler": ["B", "C"],
            "rocker": ["D", "C"],
        },
        drivers=[("angle", "crank", "ground")],
    )


def samples(order: int, assembly: dict[str, int] | None = None) -> checks.Solve:
    m = assur.Mechanism(**mechanism_data.arguments(four_bar()))

    def solve(q: Array) -> Sample:
        motion = m.solve(q, order=order + 1, on_error="nan", assembly=assembly)
        return Sample(motion, order)

    return solve


GRID = np.linspace(0.0, 6.0, 1001)


def found(solve: checks.Solve, test: checks.Test) -> list[str]:
    return checks.broken(solve, solve(GRID), 1.0, test)[0]


@pytest.mark.parametrize(("order", "test"), [(0, checks.jumps), (1, checks.bends)])
def test_a_motion_is_smooth(order: int, test: checks.Test) -> None:
    assert not found(samples(order), test)


def test_another_assembly_is_a_jump() -> None:
    one, other = samples(0), samples(0, {"C": -1})

    def solve(q: Array) -> Sample:
        sample, beyond = one(q), other(q)
        for name in ("value", "rate"):
            array = np.where(q[:, np.newaxis] < 2.0, getattr(sample, name), getattr(beyond, name))
            setattr(sample, name, array)
        return sample

    (jump,) = found(solve, checks.jumps)
    assert "2.0" in jump or "1.99999" in jump


def test_the_same_way_back_is_a_bend() -> None:
    def turned(solve: checks.Solve) -> Callable[[Array], Sample]:
        def back(q: Array) -> Sample:
            sample = solve(2.0 - np.abs(q - 2.0))
            sample.q = q
            sign = np.sign(2.0 - q)[:, np.newaxis]
            if sample.order:
                sample.value = sample.value * sign
            else:
                sample.rate = sample.rate * sign
            return sample

        return back

    assert not found(turned(samples(0)), checks.jumps)
    assert found(turned(samples(1)), checks.bends)


def test_the_check_finds_loops_that_do_not_close() -> None:
    geometry = Geometry(four_bar())
    motion = samples(0)(GRID)
    assert geometry.misfit(motion)[0].max() < 1.0
    longer = geometry.description.joints | {"C": (4.1, 3.2 + 1e-13)}
    other = Geometry(
        mechanism_data.Description(longer, four_bar().links, {}, [*four_bar().drivers])
    )
    assert other.misfit(motion)[0].max() > checks.TERMS


def test_an_end_without_a_fold_is_unreal() -> None:
    edges = np.array([[1.0, np.nextafter(1.0, 2.0)]])
    assert len(checks.unreal(samples(0), Geometry(four_bar()), edges)[0]) == 1


def test_cases_with_change_points_are_what_they_are_called() -> None:
    for seed in range(60):
        case = cases.changing_case(seed)
        assert case.driver == cases.CHANGING[seed % len(cases.CHANGING)]
