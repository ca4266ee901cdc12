"""Random mechanisms of class III and IV over three turns: a short campaign."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur import Status
from assur.examples import loom
from campaigns import campaign_cases as cases
from campaigns.checks import campaign_checks as checks
from campaigns.checks.campaign_geometry import Geometry, Sample
from models.mechanisms import higher_models
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from collections.abc import Callable

    from campaigns.checks.campaign_geometry import Array

SEEDS = 50  # `make campaign` asks 10 000


def solver(m: assur.Mechanism) -> Callable[[Array], Sample]:
    return lambda q: Sample(m.solve(q, order=1, on_error="nan", threads=1))


@pytest.mark.parametrize("first", range(0, SEEDS, 25))
def test_the_sample_has_no_failures(first: int) -> None:
    classes = set()
    for seed in range(first, first + 25):
        case = higher_models.higher_case(seed)
        m = assur.Mechanism(**arguments(case.description))
        classes.add(m.structure.cls)
        rng = np.random.default_rng(seed)
        grid, _ = cases.grid_of(m, rng)
        solve = solver(m)
        fine = solve(grid)
        assert not fine.wrong.any(), seed
        assert not set(np.unique(fine.status)) & {Status.UNREACHABLE, Status.NOT_CONVERGED}, seed
        # The same bits at a user's steps.
        assert not fine.differs(solve(grid[:: cases.FINER]), cases.FINER).any(), seed
        # Every pin and guide holds, by equations that share no code.
        geometry = Geometry(case.description)
        misfit, condition = geometry.misfit(fine)
        assert (misfit[fine.reached] <= checks.TERMS).all(), seed
        # No jump; analogues are differences; the branch ends at folds.
        found, edges, _ = checks.broken(solve, fine, geometry.drawn, checks.jumps)
        assert not found, (seed, found[:1])
        failed, _, _ = checks.differences(solve, fine, condition, rng)
        assert not failed, (seed, failed)
        if len(edges):
            failed, _ = checks.unreal(solve, geometry, checks.bisected(solve, edges))
            assert not failed, (seed, failed)
    assert classes == {3, 4}


def test_the_determinant_keeps_its_sign() -> None:
    """Where two assemblies meet, their determinants have opposite signs."""
    for seed in range(40):
        case = higher_models.higher_case(seed)
        m = assur.Mechanism(**arguments(case.description))
        q = float(m.q0) + np.linspace(-4.0, 4.0, 401)
        given = solver(m)(q).given
        motion = solver(m)(q[given]).motion
        signs = np.sign(Geometry(case.description).determinants(motion))
        assert len(set(signs.tolist())) == 1, seed


def test_orders_and_grids_share_their_bits() -> None:
    m = assur.Mechanism(**arguments(higher_models.higher_case(3).description))
    q = float(m.q0) + np.linspace(-0.2, 0.2, 33)
    whole = m.solve(q, order=3, on_error="nan")
    for order in range(3):
        for one in (m.solve(q, order=order, on_error="nan"), m.solve(q[5], order=order)):
            some = slice(None) if one.q.ndim else 5
            for name in m.joints:
                a, b = one.joint(name).value, whole.joint(name).value[some]
                np.testing.assert_array_equal(a, b)


def test_designs_are_those_by_themselves() -> None:
    m = assur.Mechanism(**arguments(higher_models.higher_case(12).description))
    name = next(n for n in m.dimensions if n.endswith(".length") and not n.startswith("crank"))
    value = m.dimensions[name]
    batch = m.with_dimensions({name: value * np.linspace(0.98, 1.02, 11)})
    q = float(m.q0) + np.linspace(-0.3, 0.3, 21)
    together = batch.solve(q, on_error="nan")
    for i in range(11):
        alone = batch.design(i).solve(q, on_error="nan")
        np.testing.assert_array_equal(alone.status, together.status[i])
        for joint in m.joints:
            np.testing.assert_array_equal(alone.joint(joint).d2, together.joint(joint).d2[i])


def test_with_several_drivers_they_are_followed_straight() -> None:
    """A triad whose plate hangs on two cranks and a bar."""
    joints = {"O": (0, 0), "A": (0.3, 0.2), "B": (1, 2), "C": (2.5, 1.5), "D": (2, 3), "E": (4, 0)}
    joints |= {"G": (4.3, -0.4), "F": (0, 4)}
    links = {"ground": ["O", "G", "F"], "left": ["O", "A"], "right": ["G", "E"]}
    links |= {"b1": ["A", "B"], "plate": ["B", "C", "D"], "b2": ["C", "E"], "b3": ["D", "F"]}
    m = assur.Mechanism(joints=joints, links=links, driver=["left", "right"])
    q = np.asarray(m.q0) + np.array([[0.0, 0.0], [0.05, 0.02], [-0.04, 0.03]])
    motion = m.solve(q, order=2)
    assert motion.residual.max() < 1e-14
    h = 1e-4
    steps = np.asarray(m.q0) + h * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    around = m.solve(steps, order=0).joint("D").value
    first = np.stack([around[0] - around[1], around[2] - around[3]], axis=-1) / (2 * h)
    np.testing.assert_allclose(motion.joint("D").d1[0], first, rtol=1e-6, atol=1e-7)


def test_slides_drive_them_as_well() -> None:
    """No jump, no false position, and no bit that depends on the requested range."""
    seen = 0
    for seed in range(60):
        description = higher_models.higher_case(seed).description
        if not description.slides:
            continue
        driver = ("slide", next(iter(description.slides)))
        try:
            m = assur.Mechanism(**arguments(replace(description, drivers=[driver])))
        except assur.StructureError:  # that slide cannot drive
            continue
        if m.structure.cls < 3:
            continue
        seen += 1
        q = float(m.q0) + np.linspace(-1.0, 1.0, 401)
        solve = solver(m)
        track = solve(q)
        assert not track.wrong.any(), seed
        assert not track.differs(solve(q[::8]), 8).any(), seed
        part = solve(q[150:251]).value.view(np.uint64)
        np.testing.assert_array_equal(part, track.value[150:251].view(np.uint64))
        geometry = Geometry(replace(description, drivers=[driver]))
        misfit, _ = geometry.misfit(track)
        assert (misfit[track.reached] <= checks.TERMS).all(), seed
        found, _, _ = checks.broken(solve, track, geometry.drawn, checks.jumps)
        assert not found, (seed, found[:1])
    assert seen > 20


def test_a_branch_to_infinity_ends_with_its_reason() -> None:
    """Guides become parallel: a block runs off as A / (distance to that), with no dead point."""
    m = assur.Mechanism(**arguments(higher_models.higher_case(1313).description))
    motion = m.solve(-1.46, on_error="nan")
    assert motion.status == Status.LOST
    sentence = str(motion.explain())
    end = float(re.findall(r"to q = (-[0-9.]+), where a joint is 530 times", sentence)[0])
    assert "size away" in sentence
    assert "dead point" not in sentence
    before = m.solve(np.linspace(-1.99, end, 2000), on_error="nan")
    assert (before.status[:-1] <= Status.NEAR_SINGULAR).all()
    assert before.status[-1] <= Status.SINGULAR
    near, far = abs(m.solve([end, end - 1e-6], order=0).slide("sI").value)
    assert 1e-4 < 1e-6 * far / (near - far) < 1e-3


def test_dimensions_beyond_a_fold_say_where_it_is() -> None:
    mechanism = loom()
    drawn = float(mechanism.dimensions["l48.length"])
    with pytest.raises(assur.PositionError, match="to these dimensions") as error:
        mechanism.with_dimensions({"l48.length": 9.0}).solve(0.1)
    part = float(re.findall(r"dead point ([0-9.]+) % of the way", str(error.value))[0]) / 100.0
    for share, status in ((part - 2e-6, Status.OK), (part + 2e-6, Status.LOST)):
        there = mechanism.with_dimensions({"l48.length": drawn + share * (9.0 - drawn)})
        at = there.solve(float(mechanism.q0), order=0, on_error="nan").status
        assert (at == Status.LOST) == (status == Status.LOST), share


def test_a_short_bar_closes() -> None:
    """Found once: a bar of 7 % of the size was left 56 units in the last place too long."""
    case = higher_models.higher_case(2276)
    m = assur.Mechanism(**arguments(case.description))
    grid, _ = cases.grid_of(m, np.random.default_rng(2276))
    fine = solver(m)(grid)
    misfit, _ = Geometry(case.description).misfit(fine)
    assert misfit[fine.reached].max() < 1.0
