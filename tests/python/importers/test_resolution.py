"""Redundant linkages of files whose coordinates are rounded: joints move within the decimals."""

from __future__ import annotations

import json

import numpy as np
import pytest

import assur
from assur import importers
from importers.pmks_plus_writer import Joint, Link, written

ANGLES = (0.6, 1.1, 2.2, 0.35)


def lift(angle: float, decimals: int = 3, off: float = 0.0) -> dict[str, tuple[float, float]]:
    """Three equal legs, rounded; the third is off at its upper end."""
    u, v = 0.7 * np.cos(angle), 0.7 * np.sin(angle)
    feet = {"A": (0.0, 0.0), "B": (1.0, 0.2), "C": (1.3, -0.6)}
    heads = {name.lower(): (x + u, y + v) for name, (x, y) in feet.items()}
    heads["c"] = (heads["c"][0] + off, heads["c"][1])
    return {
        name: (round(float(x), decimals), round(float(y), decimals))
        for name, (x, y) in (feet | heads).items()
    }


LINKS = {"l1": "Aa", "l2": "Bb", "l3": "Cc", "bed": "abc"}


def pmks_plus(joints: dict[str, tuple[float, float]]) -> str:
    flags = {"A": "input frame", "B": "frame", "C": "frame"}
    records = [Joint(name, at, flags.get(name, "")) for name, at in joints.items()]
    return written(records, [Link(name, tuple(on)) for name, on in LINKS.items()])


def pmks(joints: dict[str, tuple[float, float]]) -> str:
    rows = []
    for name, (x, y) in joints.items():
        links = ["ground"] * (name in "ABC") + [link for link, on in LINKS.items() if name in on]
        flags = " 0 ffft" if name == "A" else ""
        rows.append(f"{' '.join(links)} R {x!r} {y!r}{flags}")
    return "\n".join(rows)


def pylinkage(joints: dict[str, tuple[float, float]]) -> str:
    points = [
        {"id": name, "type": "ground" if name in "ABC" else "revolute", "position": at}
        for name, at in joints.items()
    ]
    bars = [
        {"id": name, "type": "driver" if name == "l1" else "link", "joints": list(on)}
        | ({"motor_joint": "A"} if name == "l1" else {})
        for name, on in LINKS.items()
    ]
    return json.dumps({"joints": points, "links": bars})


def linkage2(joints: dict[str, tuple[float, float]]) -> str:
    number = {name: str(i) for i, name in enumerate(joints)}
    lines = []
    for name, (x, y) in joints.items():
        flags = ' anchor="true"' if name in "ABC" else ""
        flags += ' input="true"' if name == "A" else ""
        lines.append(f'<connector id="{number[name]}" x="{x}" y="{y}"{flags}/>')
    for i, on in enumerate(LINKS.values()):
        inside = "".join(f'<connector id="{number[name]}"/>' for name in on)
        lines.append(f'<Link id="{i}">{inside}</Link>')
    return f"<linkage2>{''.join(lines)}</linkage2>"


@pytest.mark.parametrize("write", [pmks_plus, pmks, pylinkage, linkage2])
@pytest.mark.parametrize("angle", ANGLES)
def test_a_lift_of_three_decimals_moves(angle: float, write) -> None:  # type: ignore[no-untyped-def]
    joints = lift(angle)
    found = importers.read(write(joints), scale=1.0)
    mechanism = found.mechanism
    assert mechanism.structure.redundant
    at = dict(zip(joints, mechanism.joints.values(), strict=True))
    moved = max(np.abs(np.subtract(at[name], joints[name])).max() for name in joints)
    assert moved <= 5.01e-4
    legs = [np.subtract(at[b], at[a]) for a, b in ("Aa", "Bb", "Cc")]
    np.testing.assert_allclose(legs, [legs[0]] * 3, atol=1e-6)
    said = [sentence for sentence in found.omitted if sentence.startswith("Joints are moved")]
    assert len(said) == (moved > 1e-9)
    if said:
        assert f"by up to {mechanism.structure.adjustment:.2g} m, within the decimals" in said[0]
    assert mechanism.solve(mechanism.q0 + np.linspace(-0.2, 0.2, 9)).residual.max() < 1e-12


def test_the_move_is_in_metres() -> None:
    text = pmks_plus(lift(1.1, off=1e-3))
    whole, small = importers.read(text), importers.read(text, scale=0.01)
    ratio = small.mechanism.structure.adjustment / whole.mechanism.structure.adjustment
    assert ratio == pytest.approx(0.01, rel=1e-6)


@pytest.mark.parametrize("write", [pmks_plus, pmks, linkage2])
def test_a_real_misfit_is_refused(write) -> None:  # type: ignore[no-untyped-def]
    for off in (0.02, -0.05):
        with pytest.raises(assur.StructureError):
            importers.read(write(lift(0.6, off=off)))


def test_more_digits_allow_less() -> None:
    joints = lift(0.6, decimals=6)
    assert importers.read(pmks(joints)).mechanism.structure.adjustment < 5.1e-7
    joints["c"] = (joints["c"][0] + 1e-4, joints["c"][1])
    with pytest.raises(assur.StructureError, match="its tolerance, 5"):
        importers.read(pmks(joints))


def test_places_that_fit_stay() -> None:
    text = "ground a R 0 0 0 ffft\na b R 0 1\nb c R 3 2.125\nc ground R 4 0"
    found = importers.read(text)
    assert list(found.mechanism.joints.values()) == [(0, 0), (0, 1), (3, 2.125), (4, 0)]
    assert found.omitted == ()
