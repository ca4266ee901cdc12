"""`FourBar(ground_angle=)` and `FourBar.grashof`; solutions of `find` by name."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

import assur


@pytest.mark.parametrize("angle", [0.3, -2.0, math.pi / 2, 3.0])
@pytest.mark.parametrize("mode", ["open", "crossed"])
def test_a_turned_ground_is_the_four_bar_turned(angle: float, mode: str) -> None:
    lengths = (1.0, 3.0, 2.5, 3.2)
    plain = assur.FourBar(*lengths, mode=mode)  # type: ignore[arg-type]
    turned = assur.FourBar(*lengths, mode=mode, ground_angle=angle)  # type: ignore[arg-type]
    q = np.linspace(0.0, 2.0 * np.pi, 25)
    one, two = plain.solve(q), turned.solve(q + angle)
    at = np.exp(1j * angle)
    for joint in "ABCD":
        places = one.joint(joint).value @ [1.0, 1j] * at
        np.testing.assert_allclose(two.joint(joint).value @ [1.0, 1j], places, atol=1e-13)
    np.testing.assert_allclose(two.link("rocker").d1, one.link("rocker").d1, atol=1e-13)
    assert turned.dimensions["ground.D.y"] == pytest.approx(3.2 * math.sin(angle), abs=1e-15)


def test_a_batch_of_angles() -> None:
    angles = np.array([0.0, 0.5, 1.0])
    batch = assur.FourBar(1.0, 3.0, 2.5, 3.2, ground_angle=angles)
    assert batch.shape == (3,)
    for k, angle in enumerate(angles):
        one = assur.FourBar(1.0, 3.0, 2.5, 3.2, ground_angle=float(angle))
        assert batch.design(k).dimensions == one.dimensions
    with pytest.raises(assur.InputError, match="ground_angle"):
        assur.FourBar(1.0, 3.0, 2.5, 3.2, ground_angle=math.nan)


def test_types_by_which_links_turn() -> None:
    """A link turns against the ground if its limits say so: another way to the same word."""
    seen = set()
    for lengths in itertools.product([1.0, 1.7, 2.4, 3.3], repeat=4):
        outer, inner = min(lengths) + max(lengths), sum(lengths) - min(lengths) - max(lengths)
        if abs(outer - inner) < 1e-9 or max(lengths) >= sum(lengths) - max(lengths):
            continue
        m = assur.FourBar(*lengths)
        found = m.grashof
        assert (found.s_plus_l, found.p_plus_q) == pytest.approx((outer, inner))
        turns = bool(m.limits().full_rotation), bool(m.with_driver("rocker").limits().full_rotation)
        coupler = m.with_driver(assur.Drive("coupler", relative_to="crank"))
        word = {
            (True, False): "crank-rocker",
            (False, True): "rocker-crank",
            (True, True): "double-crank",
        }.get(turns, "double-rocker" if coupler.limits().full_rotation else "triple-rocker")
        assert found.type == word, lengths
        assert (" < " in repr(found)) == (outer < inner)
        seen.add(word)
    assert len(seen) == 5


def test_change_points_and_batches() -> None:
    assert assur.FourBar(1.0, 2.0, 1.0, 2.0).grashof.type == "change-point"
    batch = assur.FourBar([1.0, 3.0], 3.0, 2.5, 3.2).grashof
    assert np.asarray(batch.type).tolist() == ["crank-rocker", "rocker-crank"]
    assert batch.s_plus_l.tolist() == [4.2, 5.7]
    assert repr(batch) == "<Grashof types of 2 four-bars>"


def test_what_cannot_be_assembled_has_no_type() -> None:
    refused = assur.FourBar(1.0, 9.0, 2.5, 3.2)
    with pytest.raises(assur.DimensionError, match=r"longest link, 9 m, .* together, 6.7 m"):
        _ = refused.grashof
    batch = assur.FourBar([1.0, 1.0, math.nan], [3.0, 9.0, 3.0], 2.5, 3.2)
    assert np.asarray(batch.grashof.type).tolist() == ["crank-rocker", "", ""]
    two = assur.FourBar(1.0, 3.0, 2.5, [3.2, -1.0]).grashof.type
    assert np.asarray(two).tolist() == ["crank-rocker", ""]
    with pytest.raises(assur.InputError, match=r"shape \(2,\) and ground_angle \(3,\)"):
        assur.FourBar(1.0, 3.0, 2.5, [3.2, 3.3], ground_angle=[0.1, 1.0, 2.0])


@pytest.mark.parametrize("names", [*itertools.permutations(["in", "mid", "out"])])
def test_a_four_bar_however_it_is_drawn(names: tuple[str, ...]) -> None:
    """Pins anywhere in their links' lists, links in any order, a ground that is not along +x."""
    crank, coupler, rocker = names
    places = {"A": (0.3, -0.2), "B": (0.6, 0.4), "C": (2.9, 1.6), "D": (2.4, -0.9), "P": (1.0, 3.0)}
    links = {
        rocker: ["P", "D", "C"],
        "ground": ["D", "A"],
        coupler: ["C", "B"],
        crank: ["B", "A"],
    }

    def apart(one: str, two: str) -> float:
        return math.dist(places[one], places[two])

    lengths = apart("A", "B"), apart("B", "C"), apart("C", "D"), apart("A", "D")
    m = assur.Mechanism(places, links, crank)
    found = m.grashof
    assert found.type == assur.crank_rocker.grashof(*lengths)
    assert found.s_plus_l == pytest.approx(min(lengths) + max(lengths))
    batch = m.with_dimensions({f"{coupler}.length": [lengths[1], 0.7 * lengths[1]]})
    assert batch.grashof.type[0] == found.type
    assert batch.design(1).grashof.type == batch.grashof.type[1]
    turned = assur.crank_rocker.grashof(lengths[2], lengths[1], lengths[0], lengths[3])
    assert m.with_driver(rocker).grashof.type == turned


def test_what_is_no_four_bar() -> None:
    for m in (assur.SliderCrank(1.0, 3.0), assur.examples.watt_1(), assur.examples.five_bar()):
        with pytest.raises(assur.InputError, match="grashof is for four-bars"):
            _ = m.grashof


def test_solutions_have_names() -> None:
    engine = assur.SliderCrank(1.0, 3.0)
    for solution in engine.find("bore", 3.0):
        q, assembly = solution
        assert (q, assembly) == (solution.q, solution.assembly)
        assert float(engine.solve(q, assembly=assembly).slide("bore").value) == pytest.approx(3.0)
