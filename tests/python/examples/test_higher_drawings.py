"""Named mechanisms of class III, IV and V against the oracle, along their whole range."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Status, examples
from models.mechanisms.mechanism_data import arguments, described
from models.mechanisms.named_drawings import HIGHER
from oracles.kinematics import agreement, oracle, oracle_guess
from oracles.kinematics.agreement_law import along, check_law, solve, whole_turns

CLASSES = {
    "triad": (3, 3),
    "stephenson_reversed": (3, 3),
    "triad_press": (3, 3),
    "triad_two_guides": (3, 3),
    "triad_slotted_plate": (3, 3),
    "platform_on_cylinders": (3, 3),
    "platform_on_cranks": (3, 3),
    "quadrilateral": (4, 2),
    "quadrilateral_with_block": (4, 2),
    "quadrilateral_on_guide": (4, 2),
    "loom": (4, 3),
    "pentagon": (5, 3),
}
# How far each is followed in both directions from the drawing, rad or m; a fold may come before.
FAR = {"platform_on_cylinders": 0.4, "platform_on_cranks": 0.6}
PLACES = (0.13, 0.31, 0.5, 0.77, 1.0)


@pytest.mark.parametrize("name", HIGHER)
def test_structure(name: str) -> None:
    m = HIGHER[name]()
    (group,) = [g for g in m.structure.groups if g.cls > 2]
    assert (group.cls, group.order) == CLASSES[name]
    assert len(m.links) <= 10


@pytest.mark.parametrize("name", HIGHER)
def test_agrees_with_the_oracle(name: str) -> None:
    """Joints, angles, slides and three orders of analogues, wherever the tracer comes."""
    m = HIGHER[name]()
    d = described(m)
    tracer, start = agreement.Tracer(d), oracle_guess.drawing_q(d)
    qs, poses, beyond = [start], [oracle_guess.drawing_pose(d)], []
    for sign in (1.0, -1.0):
        far = sign * FAR.get(name, math.tau)
        move = tuple(far * (1 - 0.7 * k) for k in range(len(start)))
        path = tracer.follow(move)
        end = 1.0 if path.fold is None else 0.98 * path.fold
        if path.fold is not None:
            beyond.append(along(start, move, 1.02 * path.fold))
        for part in PLACES:
            qs.append(along(start, move, end * part))
            poses.append(path.pose(end * part))
    motion = solve(m, qs + beyond)
    turns: dict[str, float] = {}
    for i, (q, pose) in enumerate(zip(qs, poses, strict=True)):
        assert motion.status[i] <= Status.NEAR_SINGULAR, motion.explain(i)
        solution = oracle.solve(d, q, pose, 3)
        turns = turns or whole_turns(motion, i, solution)
        gap = agreement.compare(d, motion, (i,), solution, 3, turns)
        check_law(d, q, solution, gap)
    # Where the oracle meets a fold, the branch ends.
    assert (motion.status[len(qs) :] == Status.LOST).all()


@pytest.mark.parametrize("name", HIGHER)
def test_bits_depend_on_dimensions_assembly_and_q_alone(name: str) -> None:
    """Neighbours in a batch, blocks of positions, threads, order, other positions asked for."""
    m, rng = HIGHER[name](), np.random.default_rng(1)
    free = [n for n in m.dimensions if n.endswith(".length")]
    sizes = {n: m.dimensions[n] * rng.uniform(0.99, 1.01, 19) for n in free}
    batch = m.with_dimensions(sizes)
    q0, drivers = np.asarray(m.q0), np.size(m.q0)
    if drivers == 1:
        q = q0 + np.concatenate([np.linspace(-1.0, 4.0, 70), rng.uniform(-9, 9, 30)])
    else:
        q = q0 + rng.uniform(-0.1, 0.1, (9, drivers))
    whole = batch.solve(q, on_error="nan", order=2, threads=1)

    def same(a: assur.Motion, rows: Any) -> None:
        np.testing.assert_array_equal(a.status, whole.status[rows])
        for joint in m.joints:
            for of in ("value", "d1", "d2"):
                mine, its = getattr(a.joint(joint), of), getattr(whole.joint(joint), of)[rows]
                np.testing.assert_array_equal(mine, its)

    same(batch.solve(q, on_error="nan", threads=2), (slice(None), slice(None)))
    some = rng.permutation(len(q))[: len(q) // 2]
    same(batch.solve(q[some], on_error="nan"), (slice(None), some))
    for i in (0, 7, 18):
        same(batch.design(i).solve(q, on_error="nan"), (i, slice(None)))
        same(batch.design(i).solve(q[3], on_error="nan"), (i, 3))
    few = m.with_dimensions({n: values[5:14] for n, values in sizes.items()})
    same(few.solve(q, on_error="nan"), (slice(5, 14), slice(None)))


def past(m: assur.Mechanism, q: float) -> assur.Motion:
    return m.solve(q, order=0)


def test_past_a_dead_point_by_another_driver_and_back() -> None:
    """The triad's crank turns back at its dead point; along a rocker the motion goes on."""
    triad = examples.triad()
    links = {n: list(js) for n, js in triad.links.items()}
    # With a crank twice as long it has one.
    m = assur.Mechanism(joints={**triad.joints, "A": (0.6, 0.4)}, links=links, driver="crank")
    q = float(m.q0) + np.linspace(0.0, 0.6, 6001)
    by_crank = m.solve(q, on_error="nan")
    last = int(np.flatnonzero(by_crank.status <= Status.NEAR_SINGULAR)[-1])
    assert (by_crank.status[last + 1 :] == Status.LOST).all()
    dead = q[last]
    rocker = by_crank.link("right").value[: last + 1]
    # By the rocker from the drawing: to the dead point, and as far again beyond it.
    other = m.with_driver("right")
    path = np.linspace(rocker[0], 2.0 * rocker[last] - rocker[0], 401)
    by_rocker = other.solve(path, on_error="nan")
    given = by_rocker.status <= Status.NEAR_SINGULAR
    crank = by_rocker.link("crank").value
    top = int(np.nanargmax(np.where(given, crank, np.nan)))
    assert abs(crank[top] - dead) < 2e-3
    # Up to there both give the same positions.
    monotone = np.diff(rocker) * np.sign(rocker[last] - rocker[0]) > 0
    assert monotone.all()
    for i in range(0, top - 3, 20):
        alone = past(m, float(crank[i]))
        for joint in m.joints:
            np.testing.assert_allclose(
                alone.joint(joint).value, by_rocker.joint(joint).value[i], atol=1e-10
            )
    # Beyond it the crank goes back, in another assembly, drawn there.
    beyond = top + (int(np.flatnonzero(given)[-1]) - top) // 2
    assert given[beyond]
    assert crank[beyond] < dead - 1e-3
    places = {n: tuple(by_rocker.joint(n).value[beyond].tolist()) for n in m.joints}
    back = assur.Mechanism(joints=places, links=links, driver="crank")
    moved = back.solve(np.linspace(crank[beyond], crank[top] - 1e-3, 9))
    here = past(m, float(crank[beyond]))
    assert np.linalg.norm(here.joint("D").value - moved.joint("D").value[0]) > 1e-2
    for i in range(9):
        near = np.argmin(np.abs(np.where(given, crank, 9.0)[top:] - moved.q[i])) + top
        step = 2.0 * np.abs(np.diff(by_rocker.joint("D").value[top:][given[top:]], axis=0)).max()
        gap = np.abs(moved.joint("D").value[i] - by_rocker.joint("D").value[near]).max()
        assert gap < step
    # And back over the dead point along the rocker, to the drawing.
    again = back.with_driver("right").solve(path[beyond::-1])
    np.testing.assert_allclose(
        again.joint("D").value, by_rocker.joint("D").value[beyond::-1], atol=1e-10
    )
    np.testing.assert_allclose(again.joint("D").value[-1], m.joints["D"], atol=1e-10)


def test_a_ring_of_ternary_links_is_not_class_v() -> None:
    """Five links in a ring, each pinned to the frame: the counts forbid it."""
    joints = {"O": (0, 0), "A": (0.3, 0.2), "p": (1, 2), "r": (2.5, 2.4), "s": (3.4, 1.3)}
    joints |= {"t": (2.6, 0.1), "u": (1.1, 0.3), "B": (1.6, 3.1), "C": (3.9, 2.4)}
    joints |= {"D": (3.5, 0.2), "E": (1.9, -0.6)}
    links = {"ground": "OBCDE", "crank": "OA", "a": "Apu", "b": "pBr", "c": "rCs", "d": "sDt"}
    with pytest.raises(assur.StructureError, match="cannot move"):
        assur.Mechanism(joints=joints, links={**links, "e": "tEu"}, driver="crank")


def test_sizes_of_the_library() -> None:
    """As many mechanisms as there must be, sliding pairs among them."""
    higher = [name for name, (cls, _) in CLASSES.items() if cls in (3, 4)]
    assert len(higher) >= 10
    assert sum(bool(HIGHER[name]().slides) for name in higher) >= 5
    assert CLASSES.keys() == HIGHER.keys()
    assert all(arguments(described(make()))["joints"] for make in HIGHER.values())
