"""Sensitivities against differences of the 50-digit oracle, for every class and kind of pair."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Status
from models.mechanisms import dyad_models, higher_models, named_models
from models.mechanisms.class_iv_model import class_iv
from models.mechanisms.mechanism_data import Description, arguments
from oracles.kinematics import agreement, oracle, oracle_guess
from oracles.kinematics.oracle_dimension import changed, known
from oracles.kinematics.oracle_system import MP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# Central differences of step h lose h² of a third derivative and nothing to rounding.
STEP = MP.mpf("1e-18")
# Of the greatest sensitivity of its order, for a condition of 1: one order more than an analogue,
# with its law 64 u κ^(k+1).
LAW = 64 * agreement.U


def outputs(solution: oracle.Solution) -> Iterator[tuple[str, str, oracle.Jet]]:
    for kind in ("joint", "link", "slide"):
        for name, jet in getattr(solution, kind + "s").items():
            yield kind, name, jet


def difference(up: oracle.Jet, down: oracle.Jet, order: int, drivers: int) -> Any:
    """Of the tensors of an order, from their 50 digits."""
    parts = {
        index: tuple((a - b) / (2 * STEP) for a, b in zip(up.partials[index], values, strict=True))
        for index, values in down.partials.items()
    }
    return oracle.Jet(parts, drivers, up.scalar).tensor(order)


def check(
    d: Description, move: float, order: int = 2, dimensions: int = 4, seed: int = 0
) -> tuple[int, float]:
    """Every output's sensitivity by some of the dimensions; how many, and the greatest share."""
    m, tracer = assur.Mechanism(**arguments(d)), agreement.Tracer(d)
    start = oracle_guess.drawing_q(d)
    moves = tuple(move * (1 - 1.6 * k) for k in range(len(start)))
    path = tracer.follow(moves)
    part = 1.0 if path.fold is None else path.fold / 2
    q = tuple(a + part * b for a, b in zip(start, moves, strict=True))
    motion = m.solve(q[0] if len(q) == 1 else np.array(q), order=order)
    pose, kappa = path.pose(part), float(motion.condition)
    names = [name for name in m.dimensions if known(d, name)]
    chosen = np.random.default_rng(seed).permutation(names)[:dimensions]
    worst = 0.0
    for name in chosen:
        found = motion.sensitivity(str(name))
        up, down = (
            oracle.solve(d, q, pose, order, changed(str(name), sign * STEP)) for sign in (1, -1)
        )
        lower = 0.0
        for k in range(order + 1):
            errors, sizes = [], []
            for (kind, output, high), (_, _, low) in zip(outputs(up), outputs(down), strict=True):
                wanted = difference(high, low, k, len(q))
                of = f"d{k}" if k else "value"
                got = getattr(getattr(found, kind)(output), of)
                errors.append(float(np.abs(got - wanted).max()))
                sizes.append(float(np.abs(wanted).max()))
            # Where all of an order cancels, the rounding of the orders below is left.
            allowed = LAW * kappa ** (k + 2) * max(sizes) + agreement.POSITION * kappa * lower
            lower = max(lower, *sizes)
            share = max(errors) / allowed
            worst = max(worst, share)
            assert share < 1.0, (name, k, share, kappa)
    return len(chosen), worst


@pytest.mark.parametrize("kind", dyad_models.KINDS)
@pytest.mark.parametrize("seed", range(4))
def test_dyads(kind: str, seed: int) -> None:
    check(dyad_models.build(seed, "crank", (kind,)).description, 0.4, seed=seed)


@pytest.mark.parametrize("driver", dyad_models.DRIVERS)
@pytest.mark.parametrize("seed", range(2))
def test_drivers(driver: str, seed: int) -> None:
    check(dyad_models.build(seed, driver, ("RRR", "RRP")).description, 0.2, seed=seed)


@pytest.mark.parametrize("seed", range(25))
def test_higher_classes(seed: int) -> None:
    check(higher_models.higher_case(seed).description, 0.3, seed=seed)


def paper() -> Description:
    parts = class_iv()
    links = {name: list(joints) for name, joints in parts["links"].items()}
    return Description(parts["joints"], links, {}, [("angle", "crank", "ground")])


def test_all_dimensions_of_the_papers_mechanism() -> None:
    count, _ = check(paper(), 1.0, order=3, dimensions=99)
    assert count == 17  # all but the two of the frame's first joint


@pytest.mark.parametrize("make", [named_models.excavator, named_models.five_bar])
def test_several_drivers(make: Callable[[], Description]) -> None:
    check(make(), 0.05, dimensions=6)


def test_the_frames_first_joint_moves_all() -> None:
    """All the rest of the ground stays: as if that were moved back, and everything ahead."""
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    motion = m.solve(0.7)
    first, other = (motion.sensitivity(f"ground.{joint}.x") for joint in ("A", "D"))
    for name in m.joints:
        total = first.joint(name).value + other.joint(name).value
        np.testing.assert_allclose(total, [1.0, 0.0], atol=1e-14)


def test_scale_does_not_matter() -> None:
    one = assur.FourBar(1.0, 4.1, 2.5, 4.8).solve(0.5).sensitivity("coupler.length")
    for power in (-400, 400):
        s = 2.0**power
        far = assur.FourBar(s, 4.1 * s, 2.5 * s, 4.8 * s).solve(0.5).sensitivity("coupler.length")
        np.testing.assert_array_equal(far.joint("C").value, one.joint("C").value)
        np.testing.assert_array_equal(far.link("rocker").d1 * s, one.link("rocker").d1)


def test_batches_are_the_designs_by_themselves() -> None:
    m = assur.FourBar(1.0, 4.1, 2.5, np.linspace(4.6, 5.0, 5))
    q = np.linspace(0.0, 6.0, 9)
    found = m.solve(q).sensitivity("rocker.length")
    for i in range(5):
        one = m.design(i).solve(q).sensitivity("rocker.length")
        np.testing.assert_array_equal(found.joint("C").d2[i], one.joint("C").d2)
    for threads in (1, 2):
        again = m.solve(q, threads=threads).sensitivity("rocker.length")
        np.testing.assert_array_equal(again.link("coupler").d1, found.link("coupler").d1)


def test_missing_derivatives_are_nan_with_a_status() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 6.0)
    motion = m.solve([0.5, math.pi], on_error="nan", order=1)
    found = motion.sensitivity("coupler.length")
    assert list(found.status) == [Status.OK, Status.UNREACHABLE]
    assert np.isfinite(found.joint("C").d1[0]).all()
    assert np.isnan(found.joint("C").value[1]).all()
    # At a change point no small change of one length leaves the motion smooth.
    parallelogram = assur.FourBar(1.0, 3.0, 1.0, 3.0)
    flat = parallelogram.solve([0.0, 1.0], on_error="nan").sensitivity("coupler.length")
    assert np.isnan(flat.joint("C").value[0]).all()
    assert np.isfinite(flat.joint("C").value[1]).all()


def test_names_are_looked_up() -> None:
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(0.5, outputs=["C"])
    with pytest.raises(assur.InputError, match=r"coupler\.length"):
        motion.sensitivity("couple.length")
    found = motion.sensitivity("coupler.length")
    with pytest.raises(assur.InputError, match="not among the outputs"):
        found.joint("B")
    with pytest.raises(assur.InputError, match="solved to order 2"):
        _ = found.joint("C").d3
    assert "coupler.length" in repr(found)


def test_redundant_links_have_no_sensitivities() -> None:
    d = named_models.parallelogram()
    motion = assur.Mechanism(**arguments(d)).solve(oracle_guess.drawing_q(d)[0])
    with pytest.raises(assur.InputError, match="redundant"):
        motion.sensitivity(next(iter(motion.mechanism.dimensions)))
