"""A drawing that is known to a length: joints are moved so far where redundant links need it."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import assur

C, S = round(0.7 * np.cos(0.6), 3), round(0.7 * np.sin(0.6), 3)


def lift(off: float, tolerance: Any = None) -> assur.Mechanism:
    """A bed on three legs, the third of which is off by so much at its upper end."""
    return assur.Mechanism(
        {"A": (0, 0), "B": (1, 0), "C": (2, 0)}
        | {"a": (C, S), "b": (1 + C, S), "c": (2 + C + off, S)},
        {"ground": "ABC", "l1": "Aa", "l2": "Bb", "l3": "Cc", "bed": "abc"},
        "l1",
        tolerance=tolerance,
    )


@pytest.mark.parametrize("off", [4e-4, -4e-4, 1e-4, 1e-6])
def test_a_lift_moves_if_its_drawing_is_known_to_the_misfit(off: float) -> None:
    with pytest.raises(assur.StructureError, match="tolerance"):
        lift(off)
    m = lift(off, tolerance=5e-4)
    assert m.structure.formula == "I(l1) → II(l2, bed)"
    assert m.structure.redundant == ("l3",)
    moved = [np.subtract(m.joints[name], at) for name, at in drawn(off).items()]
    # At least a sixth: three legs with two ends each.
    assert abs(off) / 6.0 * 0.99 <= np.abs(moved).max() <= 5e-4
    assert m.structure.adjustment == pytest.approx(np.abs(moved).max(), rel=1e-6)
    assert f"moved by up to {m.structure.adjustment:.2g} m" in str(m.structure)
    legs = [np.subtract(m.joints[b], m.joints[a]) for a, b in ("Aa", "Bb", "Cc")]
    np.testing.assert_allclose(legs, [legs[0]] * 3, atol=2e-7)
    motion = m.solve(m.q0 + np.linspace(0.0, 6.2, 100))
    assert motion.residual.max() < 1e-13
    np.testing.assert_allclose(motion.link("bed").d1, 0.0, atol=1e-6)


def drawn(off: float) -> dict[str, tuple[float, float]]:
    return {"A": (0, 0), "B": (1, 0), "C": (2, 0), "a": (C, S), "b": (1 + C, S)} | {
        "c": (2 + C + off, S)
    }


@pytest.mark.parametrize("off", [5e-3, 2e-2, 0.3])
def test_a_real_misfit_is_refused(off: float) -> None:
    with pytest.raises(assur.StructureError):
        lift(off, tolerance=5e-4)


def test_the_refusal_names_the_tolerance() -> None:
    with pytest.raises(assur.StructureError, match=r"its tolerance, 2e-5 m\); give a greater"):
        lift(4e-4, tolerance=2e-5)


def test_a_drawing_that_fits_stays_as_it_is() -> None:
    m = lift(0.0, tolerance=5e-4)
    assert m.structure.adjustment == 0.0
    assert dict(m.joints) == drawn(0.0)
    four_bar = {"A": (0, 0), "B": (0, 1), "C": (3, 2), "D": (4, 0)}
    links = {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"}
    plain = assur.Mechanism(four_bar, links, "crank")
    assert assur.Mechanism(four_bar, links, "crank", tolerance=0.1) == plain


def test_copies_remember_how_far_joints_were_moved() -> None:
    m = lift(4e-4, tolerance=5e-4)
    moved = m.structure.adjustment
    copies = [pickle.loads(pickle.dumps(m)), m.with_driver("l2"), m.with_dimensions({})]
    assert [one.structure.adjustment for one in copies] == [moved] * 3
    assert copies[0] == m


@pytest.mark.parametrize("off", [1e-3, 2e-4])
def test_guides_are_turned_within_the_angle(off: float) -> None:
    def bed(tolerance: Any = None) -> assur.Mechanism:
        return assur.Mechanism(
            {"A": (0, 0), "B": (1, 0.3), "C": (3, 1), "D": (4, 1.5), "E": (0, 1), "F": (0, 1.5)},
            {"ground": "AEF", "crank": "AB", "rod": "BC", "bed": "CD"},
            "crank",
            slides={
                "s0": assur.Slide("bed", on="ground", angle=0.0, origin="E"),
                "s1": assur.Slide("bed", on="ground", angle=off, origin="F"),
            },
            tolerance=tolerance,
        )

    with pytest.raises(assur.StructureError):
        bed()
    with pytest.raises(assur.StructureError):
        bed((1e-3, 0.4 * off))
    m = bed((1e-3, 0.6 * off))
    angles = [m.slides[name].angle for name in ("s0", "s1")]
    assert angles == pytest.approx([off / 2, off / 2], abs=0.11 * off)
    assert m.solve(m.q0 + np.linspace(-0.3, 0.3, 20)).residual.max() < 1e-13


@pytest.mark.parametrize("wrong", [0.0, -1e-3, np.nan, np.inf, "1e-3", (1e-3,), (1e-3, 0.0), [[1]]])
def test_a_tolerance_is_a_positive_length(wrong: object) -> None:
    with pytest.raises(assur.InputError, match=r"tolerance is .*a positive length"):
        lift(0.0, tolerance=wrong)


@pytest.mark.parametrize("seed", range(12))
def test_lifts_rounded_to_three_decimals_move(seed: int) -> None:
    rng = np.random.default_rng(seed)
    angle = rng.uniform(0.3, 1.2)
    leg = rng.uniform(0.8, 2.0) * np.array([np.cos(angle), np.sin(angle)])
    feet = {"A": np.zeros(2), "B": rng.uniform(1, 3, 2), "C": rng.uniform(-3, -1, 2)}
    joints = {name: np.round(at, 3).tolist() for name, at in feet.items()}
    joints |= {name.lower(): np.round(at + leg, 3).tolist() for name, at in feet.items()}
    links = {"ground": "ABC", "l1": "Aa", "l2": "Bb", "l3": "Cc", "bed": "abc"}
    m = assur.Mechanism(joints, links, "l1", tolerance=5.001e-4)
    for name, at in joints.items():
        assert np.abs(np.subtract(m.joints[name], at)).max() <= 5.1e-4
    assert m.solve(m.q0 + np.linspace(-0.2, 0.2, 20)).residual.max() < 1e-9
