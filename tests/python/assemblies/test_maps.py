"""Maps over two dimensions, against Grashof's condition and closed forms."""

from __future__ import annotations

from functools import partial

import numpy as np

import assur
from assemblies.test_numbers import triad
from models.errors.refusals import refused

# Boundaries are found to a billionth of the distance of two neighbours.
FOUND = 1e-9


def test_full_rotation_is_grashofs_condition() -> None:
    over = {"rocker.length": np.linspace(0.5, 5.0, 19), "ground.D.x": np.linspace(0.6, 5.0, 17)}
    found = assur.FourBar(1.0, 3.0, 2.5, 3.0).map("full_rotation", over)
    c, d = np.meshgrid(*over.values(), indexing="ij")
    lengths = np.sort(np.stack([np.full_like(c, 1.0), np.full_like(c, 3.0), c, d]), axis=0)
    grashof = lengths[0] + lengths[3] <= lengths[1] + lengths[2]
    shortest_turns = np.minimum(1.0, d) == lengths[0]
    np.testing.assert_array_equal(found.values, grashof & shortest_turns)
    assert len(found.boundaries) == 2
    for line in found.boundaries:
        c, d = line.points.T
        lengths = np.sort(np.stack([np.full_like(c, 1.0), np.full_like(c, 3.0), c, d]), axis=0)
        excess = lengths[0] + lengths[3] - lengths[1] - lengths[2]
        assert np.abs(excess).max() < FOUND
        assert not line.is_closed


def test_closed_boundaries_and_saddles() -> None:
    """Assemblies at a fixed crank over where the rocker stands: the ring that the dyad reaches."""
    m = assur.FourBar(1.0, 1.3, 1.1, 1.5)
    over = {"ground.D.x": np.linspace(-3.0, 4.0, 22), "ground.D.y": np.linspace(-3.5, 3.5, 23)}
    found = m.map("assemblies", over, q=0.4)
    x, y = np.meshgrid(*over.values(), indexing="ij")
    away = np.hypot(x - np.cos(0.4), y - np.sin(0.4))
    np.testing.assert_array_equal(found.values, np.where((away > 0.2) & (away < 2.4), 2, 0))
    outer = max(found.boundaries, key=lambda line: len(line.points))
    assert outer.is_closed
    assert outer.level == 2
    np.testing.assert_array_equal(outer.points[0], outer.points[-1])
    away = np.hypot(*(outer.points - [np.cos(0.4), np.sin(0.4)]).T)
    np.testing.assert_allclose(away, 2.4, rtol=0.0, atol=FOUND)


def test_assemblies_of_a_triad_change_across_the_boundaries() -> None:
    m = triad()
    first, second = "l1.length", "l2.length"
    a, b = m.dimensions[first], m.dimensions[second]
    over = {first: np.linspace(0.8, 1.2, 7) * a, second: np.linspace(0.8, 1.2, 7) * b}
    found = m.map("assemblies", over)
    assert {line.level for line in found.boundaries} <= {2, 4, 6}
    assert len(found.boundaries) >= 2
    for line in found.boundaries:
        for x, y in line.points[::3]:
            around = 1e-6 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
            near = m.with_dimensions({first: x + around[:, 0] * a, second: y + around[:, 1] * b})
            counts = [len(one) for one in near.assemblies(m.q0)]
            assert min(counts) < line.level <= max(counts)


def test_refusals() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    one, other = [1.0, 2.0], [2.0, 3.0]
    refused(
        assur.InputError,
        "assemblies",
        partial(m.map, "assemblys", {"rocker.length": one, "ground.D.x": other}),
    )
    refused(
        assur.InputError, "two dimensions", partial(m.map, "assemblies", {"rocker.length": one})
    )
    refused(
        assur.InputError,
        "ascending",
        partial(m.map, "assemblies", {"rocker.length": [2.0, 1.0], "ground.D.x": one}),
    )
    refused(
        assur.InputError,
        "rocker.lenth",
        partial(m.map, "assemblies", {"rocker.lenth": one, "ground.D.x": other}),
    )
    batch = m.with_dimensions({"coupler.length": one})
    refused(
        assur.InputError,
        "batch",
        partial(batch.map, "assemblies", {"rocker.length": one, "ground.D.x": one}),
    )
