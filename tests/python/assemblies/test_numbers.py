"""Assemblies with known numbers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Float = NDArray[np.float64]

# The printed numbers have twelve digits.
PRINTED = 2e-11


def rotations(mechanism: assur.Mechanism, q: float, links: Sequence[str]) -> Float:
    """Rotations of links from the drawing, a row for each assembly, sorted."""
    rows = []
    for assembly in mechanism.assemblies(q):
        motion = mechanism.solve(q, order=0, assembly=assembly)
        drawn = mechanism.solve(mechanism.q0, order=0)
        turned = [float(motion.link(link).value - drawn.link(link).value) for link in links]
        rows.append([math.remainder(angle, 2.0 * math.pi) for angle in turned])
    return np.array(sorted(rows), dtype=float)


def same(found: Float, printed: Sequence[Sequence[float]]) -> None:
    wanted = np.array(sorted(map(list, printed)))
    assert found.shape == wanted.shape
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=PRINTED)


def triad() -> assur.Mechanism:
    return assur.Mechanism(
        {
            "O": (0.45, 2.8),
            "A": (-0.34, 3.2),
            "P": (2.43, 0.41),
            "Q": (1.26, 2.45),
            "R": (0.04, 1.89),
            "U": (2.38, 1.54),
            "V": (2.18, 0.68),
        },
        {
            "ground": "OUV",
            "crank": "OA",
            "plate": "PQR",
            "l1": "AP",
            "l2": "UQ",
            "l3": "VR",
        },
        "crank",
    )


def test_triad_with_six_real_assemblies() -> None:
    mechanism = triad()
    assert mechanism.q0 == pytest.approx(2.67289458248, abs=PRINTED)
    found = mechanism.assemblies(mechanism.q0)
    assert found.complex_count == (6,)
    assert found.is_complete
    assert not found.failures
    printed = [
        0.0,
        2.39780385246,
        2.49149386447,
        -0.163176950242,
        -1.24799444567,
        -1.11184625901,
    ]
    same(rotations(mechanism, 2.67289458248, ["plate"]), [[angle] for angle in printed])


def test_two_slides_with_six_real_assemblies() -> None:
    # The drawing shows the piston at Q on a line through U, and the block V on a line through P.
    mechanism = assur.Mechanism(
        {
            "O": (0.45, 2.8),
            "A": (-0.34, 3.2),
            "P": (2.43, 0.41),
            "Q": (1.26, 2.45),
            "U": (0.04, 1.89),
            "V": (2.38, 1.54),
        },
        {
            "ground": "OUV",
            "crank": "OA",
            "leg": "AP",
            "plate": "PQ",
            "piston": "Q",
            "block": "V",
        },
        "crank",
        slides={
            "bore": assur.Slide("piston", on="ground", angle=0.68, origin="U"),
            "slot": assur.Slide("block", on="plate", angle=-0.82, origin="P"),
        },
    )
    coordinate = mechanism.q0
    found = mechanism.assemblies(coordinate)
    assert found.complex_count == (6,)
    assert len(found) == 6
    rows = []
    for assembly in found:
        motion = mechanism.solve(coordinate, order=0, assembly=assembly)
        turned = (
            motion.link("plate").value - mechanism.solve(coordinate, order=0).link("plate").value
        )
        slides = [float(motion.slide(name).value) for name in ("bore", "slot")]
        rows.append([math.remainder(float(turned), 2.0 * math.pi), *slides])
    printed = [
        [0.0, 1.30076281033, -0.860305847956],
        [2.49211643894, 2.75835455327, -4.10553880560],
        [-2.01523038520, -1.45906275523, -5.65255013326],
        [-1.39812301419, 6.46164769915, 2.76942372449],
        [1.23664197629, -4.39778159829, 3.86824712607],
        [0.405636864709, 0.647929411065, -0.598748674080],
    ]
    same(np.array(sorted(rows)), printed)


def test_two_plates_with_six_real_assemblies() -> None:
    mechanism = assur.Mechanism(
        {
            "O": (1.66, 2.42),
            "A": (1.61, 2.61),
            "B": (2.46, 2.03),
            "C": (1.93, 1.22),
            "D": (1.67, 1.19),
            "E": (2.23, 1.14),
            "F": (1.4, 2.27),
        },
        {
            "ground": "OD",
            "crank": "OA",
            "p1": "ABC",
            "p2": "DEF",
            "b1": "BE",
            "b2": "CF",
        },
        "crank",
    )
    printed = [
        [0.0, 0.0],
        [-0.318798445048, -0.497684377884],
        [-1.11902860795, -0.112877987377],
        [-0.128728981588, 1.99973512984],
        [-0.508428934596, 2.72172419276],
        [-1.63783268666, 1.25993178484],
    ]
    same(rotations(mechanism, float(mechanism.q0), ["p1", "p2"]), printed)


def test_class_v_with_twelve_real_assemblies() -> None:
    mechanism = assur.Mechanism(
        {
            "O": (0.11, 2.83),
            "X": (0.16, 2.23),
            "Y": (2.46, 1.3),
            "Z": (2.14, 2.48),
            "M": (2.47, 2.08),
            "a": (1.61, 0.15),
            "K": (2.73, 0.81),
            "L": (2.36, 2.62),
            "N": (1.07, 1.23),
            "Q": (1.0, 0.02),
        },
        {
            "ground": "OYZ",
            "crank": "OX",
            "t1": "MaK",
            "t2": "XML",
            "b": "LN",
            "t3": "YNQ",
            "c": "QK",
            "pend": "Za",
        },
        "crank",
    )
    found = mechanism.assemblies(mechanism.q0)
    assert found.complex_count == (16,)
    assert found.is_complete
    printed = [
        0.0,
        0.230108074404,
        -1.90315117233,
        -1.04543673375,
        2.09138547703,
        2.10242168003,
        2.11239136040,
        -1.30701533669,
        -2.82745070390,
        2.02981008234,
        2.10783322996,
        2.13984411046,
    ]
    same(rotations(mechanism, float(mechanism.q0), ["t1"]), [[angle] for angle in printed])


def six_bar(x: float = 7.0) -> assur.Mechanism:
    return assur.Mechanism(
        {
            "A": (0, 0),
            "B": (1, 0),
            "C": (4.1, 3.2),
            "D": (4.8, 0),
            "P": (3, 4),
            "E": (5.5, 5),
            "F": (x, 2),
        },
        {
            "ground": "ADF",
            "crank": "AB",
            "coupler": "BCP",
            "rocker": "DC",
            "bar": "PE",
            "rocker2": "FE",
        },
        "crank",
    )


def test_class_ii_six_bar_with_all_its_assemblies() -> None:
    mechanism = six_bar()
    links = ["coupler", "rocker", "bar", "rocker2"]
    found = mechanism.assemblies(0.6)
    rows = []
    for assembly in found:
        motion = mechanism.solve(0.6, order=0, assembly=assembly)
        rows.append([math.remainder(float(motion.link(name).value), math.tau) for name in links])
    printed = [
        [0.646580336773, 1.69895147802, 0.368521932897, 1.89562436614],
        [0.646580336773, 1.69895147802, -1.47356035604, -3.00066278929],
        [-0.928812686170, -1.98118382742, 1.75966181672, -2.71107983857],
        [-0.928812686170, -1.98118382742, 0.259506320966, -1.55293733093],
    ]
    same(np.array(sorted(rows)), printed)
