"""Circuits, branches and folds, against numbers found by tracing with forty digits."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assemblies.test_numbers import six_bar, triad
from models.errors.refusals import refused

if TYPE_CHECKING:
    from collections.abc import Sequence

FOLD = 1e-9


def folds(curve: assur.ConfigurationCurve, wanted: Sequence[float]) -> None:
    found = sorted(fold.q % math.tau for fold in curve.folds)
    np.testing.assert_allclose(found, sorted(wanted), rtol=0.0, atol=FOLD)


def test_triad_with_three_circuits() -> None:
    curve = triad().configuration_curve()
    folds(
        curve,
        [1.50368157887, 2.21404579285, 2.46560438246, 3.18655732609, 3.90409418670, 5.90120723802],
    )
    assert all(circuit.is_closed for circuit in curve.circuits)
    kinds = sorted((len(circuit.branches), abs(circuit.turns)) for circuit in curve.circuits)
    assert kinds == [(1, 1), (1, 1), (6, 0)]
    assert {fold.group for fold in curve.folds} == {"III(plate, l1, l2, l3)"}


def test_triad_with_four_circuits() -> None:
    mechanism = assur.Mechanism(
        {
            "O": (0.69, 0.7),
            "A": (0.33, 0.39),
            "P": (2.28, 1.12),
            "Q": (0.97, 1.91),
            "R": (0.56, 0.32),
            "U": (2.09, 2.27),
            "V": (0.89, 1.91),
        },
        {"ground": "OUV", "crank": "OA", "plate": "PQR", "l1": "AP", "l2": "UQ", "l3": "VR"},
        "crank",
    )
    curve = mechanism.configuration_curve()
    folds(curve, [2.66029249227, 4.91886687515, 1.00126174941, 2.61635402629])
    kinds = sorted((len(circuit.branches), abs(circuit.turns)) for circuit in curve.circuits)
    assert kinds == [(1, 1), (1, 1), (2, 0), (2, 0)]


@pytest.mark.parametrize(
    ("lengths", "circuits", "count"),
    [
        ((1, 4, 3, 4.5), 2, 0),
        ((3, 2.5, 2, 1), 2, 0),
        ((3, 1, 2.5, 3.2), 2, 4),
        ((3, 4, 1, 4.5), 2, 4),
        ((3, 2.5, 2, 4), 1, 2),
        ((4, 2.5, 3, 2), 1, 2),
        ((2, 4, 2.2, 3), 1, 2),
    ],
)
def test_four_bars_have_two_circuits_if_a_link_goes_round(
    lengths: Sequence[float], circuits: int, count: int
) -> None:
    crank, coupler, rocker, ground = lengths
    curve = assur.FourBar(crank, coupler, rocker, ground).configuration_curve()
    assert (len(curve.circuits), len(curve.folds)) == (circuits, count)
    assert all(circuit.is_closed for circuit in curve.circuits)


def test_kite_is_one_circuit_of_two_turns() -> None:
    curve = assur.FourBar(1, 2, 2, 1).configuration_curve()
    assert next((len(c.branches), c.turns) for c in curve.circuits) == (1, 2)


def test_six_bars() -> None:
    # On each circuit of the crank-rocker the second dyad always closes, or over one arc.
    whole = six_bar(7.0).configuration_curve()
    assert not whole.folds
    assert len(whole.circuits) == 4
    arcs = six_bar(9.0).configuration_curve()
    assert len(arcs.folds) == 2 * len([c for c in arcs.circuits if c.turns == 0])
    assert {fold.group for fold in arcs.folds} == {"II(bar, rocker2)"}


def test_motion_past_dead_points() -> None:
    curve = triad().configuration_curve()
    (index,) = (i for i, c in enumerate(curve.circuits) if len(c.branches) == 6)
    motion = curve.motion(index, samples=400)
    plate = motion.joints["R"]
    assert np.isfinite(plate).all()
    steps = np.hypot(*np.diff(plate, axis=0).T)
    assert steps.max() < 0.1
    # It closes, and every position is one of the mechanism.
    np.testing.assert_allclose(plate[0], plate[-1], atol=1e-5)
    lengths = np.hypot(*(motion.joints["P"] - motion.joints["R"]).T)
    assert np.ptp(lengths) < 1e-12
    assert np.abs(np.diff(motion.links["plate"])).max() < 0.1
    assert len(set(motion.branch.tolist())) == 6


def test_every_assembly_is_on_a_branch() -> None:
    mechanism = triad()
    curve = mechanism.configuration_curve()
    for assembly in mechanism.assemblies(0.77):
        assert assembly.joints is not None
        wanted = assembly.joints["R"]
        on = []
        for branch in curve.branches:
            for turn in range(-2, 3):
                q = 0.77 + math.tau * turn
                if not branch.low <= q <= branch.high or (branch.period and turn):
                    continue
                motion = mechanism.solve(q, order=0, assembly=branch.assembly)
                if np.allclose(motion.joint("R").value, wanted, atol=1e-7):
                    on.append(branch)
        assert len(on) == 1


def test_defects_of_a_crank_rocker() -> None:
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    curve = four_bar.configuration_curve()
    one, other = four_bar.assemblies(1.0)
    good = curve.defects([(0.5, one), (1.0, one), (2.0, one), (5.0, one)])
    assert (good.circuit, good.branch, good.order) == (False, False, False)
    # Backward is an order, too; not back and forth.
    assert not curve.defects([(5.0, one), (2.0, one), (1.0, one)]).order
    assert curve.defects([(0.5, one), (2.0, one), (1.0, one), (5.0, one)]).order
    assert curve.defects([(0.5, one), (2.0, other)]).circuit
    refused(assur.InputError, "no branch", lambda: _without_branches(curve).defects([(0.5, one)]))


def _without_branches(curve: assur.ConfigurationCurve) -> assur.ConfigurationCurve:
    return replace(curve, branches=())


def test_defects_of_a_double_rocker() -> None:
    # Driven by the long link both assemblies are branches of one circuit.
    four_bar = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    curve = four_bar.configuration_curve()
    one, other = four_bar.assemblies(0.3)
    found = curve.defects([(-0.5, one), (0.3, one), (0.3, other)])
    assert (found.circuit, found.branch, found.order) == (False, True, False)
    assert curve.defects([(-0.5, one), (0.3, other), (0.3, one), (-0.2, other)]).order


def test_one_or_two_positions_are_in_order() -> None:
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    curve, one = four_bar.configuration_curve(), four_bar.assemblies(1.0)[0]
    assert not curve.defects([(0.5, one)]).order
    assert not curve.defects([(0.5, one), (2.0, one)]).order
    assert not curve.defects([(0.5, one), (0.5, one), (2.0, one)]).order


def test_refusals() -> None:
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    batch = four_bar.with_dimensions({"coupler.length": [3.0, 3.1]})
    refused(assur.InputError, "one design", batch.configuration_curve)
    refused(assur.InputError, "from 2 to 100000", lambda: four_bar.configuration_curve(positions=1))
    refused(assur.InputError, "circuit", lambda: four_bar.configuration_curve().motion(7))
    curve = four_bar.configuration_curve()
    strange: list[Any] = ["x", 2.5, math.nan, True]
    for count in strange:
        ask = partial(four_bar.configuration_curve, positions=count)
        refused(assur.InputError, "positions", ask)
        refused(assur.InputError, "samples", partial(curve.motion, samples=count))
    places: Any = "abc"
    refused(assur.InputError, "pairs", lambda: curve.defects(places))
    word: Any = "x"
    refused(assur.InputError, "mapping", lambda: four_bar.with_assembly(word))
    refused(assur.InputError, "outside", lambda: batch.limits()[5])
    refused(assur.InputError, "limits", lambda: four_bar.limits()[0])
    part: Any = slice(0, 1)
    refused(assur.InputError, "limits", lambda: batch.limits()[part])


@pytest.mark.parametrize("order", [("O", "A", "B", "C", "P"), ("P", "C", "B", "A", "O")])
@pytest.mark.parametrize("turned", [1e-1, 1e-2, 1e-3, 3e-4])
def test_a_joint_goes_to_infinity_beside_a_fold(turned: float, order: tuple[str, ...]) -> None:
    """Guides on two links are parallel so little before the links are in line.

    The links fold at both ends; of one of the two assemblies the fold is cut off by a joint that
    goes to infinity, and what is left of it goes on through the fold into the other assembly.
    """
    joints = {"O": (-1.7, -0.5), "A": (-3.8, 0.7), "B": (-4.7, 1.4), "C": (-6.0, 2.7)}
    places = {**joints, "P": (-6.0, -0.6)}
    links = {
        "ground": "OC",
        "arm": "OA",
        "driven": "AB",
        "lever": "CB",
        "first": "P",
        "second": "P",
    }
    on_arm = math.atan2(0.7 + 0.5, -3.8 + 1.7)
    on_lever = math.atan2(1.4 - 2.7, -4.7 + 6.0)
    # In line the arm and the lever are half a turn apart.
    apart = math.remainder(on_arm - on_lever - math.pi, math.tau)
    m = assur.Mechanism(
        {name: places[name] for name in order},
        {name: links[name] for name in sorted(links, key=lambda name: order.index(links[name][0]))},
        "driven",
        slides={
            "left": assur.Slide("first", on="arm", angle=0.3, origin="O"),
            "right": assur.Slide("second", on="lever", angle=0.3 - apart + turned, origin="C"),
        },
    )
    curve = m.configuration_curve()
    counts = len(curve.branches), len(curve.folds), len(curve.circuits)
    assert counts == (4, 2, 2)
