"""Designs in which joints coincide that are apart in the drawing."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur

A, B, C = (0.0, 0.0), (-0.5, 1.2), (1.2, 2.6)
ARM, HAND, ROD = math.dist(A, B), math.dist(B, C), 1.3
# The dyad is flat where the elbow is straight: both links together are as long as arm and hand.
ROCKER = ARM + HAND - ROD


def robot(name: str, place: tuple[float, float]) -> assur.Mechanism:
    """Arm and hand, both driven, and a dyad from the hand to a joint of the ground."""
    across = math.dist(C, place)
    along = (ROD**2 - ROCKER**2 + across**2) / (2 * across)
    ray = complex(place[0] - C[0], place[1] - C[1]) / across
    d = complex(*C) + ray * complex(along, -math.sqrt(ROD**2 - along**2))
    return assur.Mechanism(
        joints={"A": A, "B": B, "C": C, "D": (d.real, d.imag), name: place},
        links={
            "ground": ["A"] if name == "A" else ["A", name],
            "arm": ["A", "B"],
            "hand": ["B", "C"],
            "rod": ["C", "D"],
            "rocker": [name, "D"],
        },
        driver=["arm", "hand"],
    )


@pytest.mark.parametrize("outputs", [["D"], ["D", "rod"], ["rod"]])
@pytest.mark.parametrize("neighbours", [0, 3])
def test_a_joint_placed_on_a_pivot(outputs: list[str], neighbours: int) -> None:
    """Found once: its chord depends on the elbow alone, so paths lead through a change point."""
    drawn, other = robot("A", A), robot("E", (0.9, 0.7))
    x = np.append(np.zeros(1), np.full(neighbours, 0.9))
    y = np.append(np.zeros(1), np.full(neighbours, 0.7))
    designs = other.with_dimensions({**drawn.dimensions, "ground.E.x": x, "ground.E.y": y})
    q0 = np.array(drawn.q0)
    elbow = q0[1] - q0[0]
    # Past the straight elbow, on straight paths from the drawing, and not.
    ways = np.linspace(0.0, 1.0, 20)[:, np.newaxis] * [0.3, 0.3 - 2 * elbow]
    q = q0 + np.concatenate([ways, 0.4 * ways, ways * [1.0, 0.0]])
    expected = drawn.solve(q, order=1, outputs=outputs)
    found = designs.solve(q, order=1, outputs=outputs, on_error="nan")
    assert np.array_equal(found.status[0], expected.status)
    for name in outputs:
        ours, theirs = (
            m.joint(name) if name in drawn.joints else m.link(name) for m in (found, expected)
        )
        # The drawings' angles may differ by a turn.
        moved, way = ours.value[0] - ours.value[0, 0], theirs.value - theirs.value[0]
        np.testing.assert_allclose(moved, way, rtol=0, atol=1e-9)
        np.testing.assert_allclose(ours.d1[0], theirs.d1, rtol=0, atol=1e-6)
