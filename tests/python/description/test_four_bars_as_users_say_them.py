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


def test_solutions_have_names() -> None:
    engine = assur.SliderCrank(1.0, 3.0)
    for solution in engine.find("bore", 3.0):
        q, assembly = solution
        assert (q, assembly) == (solution.q, solution.assembly)
        assert float(engine.solve(q, assembly=assembly).slide("bore").value) == pytest.approx(3.0)
