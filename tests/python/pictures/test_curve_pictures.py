"""Pictures of configuration curves, workspaces, singular loci and assemblies."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from matplotlib.collections import QuadMesh

import assur

ARM = assur.Mechanism(
    joints={"O": (0, 0), "A": (1, 0), "P": (1.5, 0.5)},
    links={"ground": "O", "upper": "OA", "fore": "AP"},
    driver=("upper", "fore"),
)
FIVE_BAR = assur.Mechanism(
    joints={"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0)},
    links={"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
    driver=("left", "right"),
)


def lines_named(ax: Any, start: str) -> list[Any]:
    return [line for line in ax.lines if (line.get_gid() or "").startswith(start)]


def points_of(line: Any) -> Any:
    return np.column_stack(line.get_data())


@pytest.mark.parametrize(
    "sides", [(3.0, 2.5, 2.0, 4.0), (1.0, 3.0, 2.5, 3.0), (3.0, 2.0, 3.0, 1.5)]
)
def test_every_point_of_a_curve_closes_the_four_bar(sides: Any) -> None:
    crank, coupler, rocker, ground = sides
    curve = assur.FourBar(*sides).configuration_curve()
    ax = curve.plot("rocker", dark=sides[0] == 1.0)
    drawn = lines_named(ax, "circuit")
    assert len(drawn) == len(curve.circuits)
    for line in drawn:
        q, angle = points_of(line)[np.isfinite(line.get_xdata())].T
        # Where a line is cut at a turn it is interpolated.
        x = ground + rocker * np.cos(angle) - crank * np.cos(q)
        y = rocker * np.sin(angle) - crank * np.sin(q)
        assert np.hypot(x, y) == pytest.approx(coupler, abs=2e-4)
        assert np.ptp(q) <= 2.0 * np.pi + 1e-9


def test_dead_points_are_where_coupler_and_rocker_are_in_line() -> None:
    ax = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().plot("rocker")
    (dead,) = lines_named(ax, "dead points")
    limit = np.arccos((3.0**2 + 4.0**2 - 4.5**2) / (2.0 * 3.0 * 4.0))
    assert np.sort(dead.get_xdata()) == pytest.approx([-limit, limit], abs=1e-9)
    # There the rocker points at B.
    for q, angle in points_of(dead):
        along = 3.0 * np.array([np.cos(q), np.sin(q)]) - (4.0, 0.0)
        assert np.cos(angle - np.arctan2(along[1], along[0])) == pytest.approx(1.0, abs=1e-6)
    texts = {t.get_text() for t in ax.texts if t.get_gid() == "dead point text"}
    assert texts == {f"−{np.degrees(limit):.1f}°", f"{np.degrees(limit):.1f}°"}


def test_the_output_of_an_engine_is_its_piston_and_any_coordinate_can_be_asked() -> None:
    curve = assur.SliderCrank(0.1, 0.4).configuration_curve()
    ax = curve.plot()
    assert ax.get_title(loc="left") == "bore, m"
    first = points_of(lines_named(ax, "circuit 0")[0])
    first = first[np.isfinite(first[:, 0])]
    stroke = 0.1 * np.cos(first[:, 0]) + np.sqrt(0.16 - (0.1 * np.sin(first[:, 0])) ** 2)
    assert first[:, 1] == pytest.approx(stroke, abs=2e-5)
    height = points_of(lines_named(curve.plot("A.y"), "circuit 0")[0])
    assert np.nanmax(height[:, 1]) == pytest.approx(0.1, abs=1e-4)
    with pytest.raises(assur.InputError, match="no such coordinate; there are"):
        curve.plot("A.z")
    with pytest.raises(assur.InputError, match="no such coordinate"):
        curve.plot(3)  # type: ignore[arg-type]


def test_circuits_that_look_alike_are_dashed_and_named() -> None:
    ax = assur.examples.klann_leg().configuration_curve().plot()
    drawn = lines_named(ax, "circuit")
    named = [t for t in ax.texts if (t.get_gid() or "").startswith("name circuit")]
    assert len(named) == len(drawn) > 1
    figure = ax.get_figure(root=True)
    assert figure
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in ax.texts]
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_a_workspace_is_the_ring_of_an_arm() -> None:
    reach = ARM.workspace("P", positions=14)
    ax = reach.plot()
    near, far = np.sqrt(0.5) - 1.0, np.sqrt(0.5) + 1.0
    radii = [np.hypot(*points_of(line).T) for line in lines_named(ax, "singular kind 1")]
    assert sorted(float(r.mean()) for r in radii) == pytest.approx([abs(near), far], abs=1e-9)
    (mesh,) = [one for one in ax.collections if one.get_gid() == "regions"]
    assert isinstance(mesh, QuadMesh)
    edges = np.asarray(mesh.get_coordinates())
    middles = (edges[:-1, :-1] + edges[1:, 1:]) / 2.0
    inside = np.hypot(*np.moveaxis(middles, -1, 0))
    ring = (inside > abs(near)) & (inside < far)
    assert np.mean(np.asarray(mesh.get_array()).astype(bool) == ring) > 0.998
    texts = [t.get_text() for t in ax.texts]
    assert "2 ways" in texts
    assert "limit of reach" in texts
    assert {"O", "A", "P"} <= set(texts)


def test_dead_points_are_drawn_into_a_workspace_and_over_the_drivers() -> None:
    loci = FIVE_BAR.singular_loci(positions=10)
    reach = FIVE_BAR.workspace("P", positions=14)
    ax = reach.plot(loci=loci, dark=True)
    second = lines_named(ax, "singular kind 2")
    assert len(second) == len(loci)
    for line, locus in zip(second, loci, strict=True):
        assert np.array_equal(points_of(line), locus.joints["P"])
    assert [t.get_text() for t in ax.texts].count("dead points") == 1
    own = loci[0].plot()
    assert (own.get_xlabel(), own.get_ylabel()) == ("left", "right")
    assert np.array_equal(points_of(lines_named(own, "singular kind 2")[0]), loci[0].q)
    for locus in loci[1:]:
        assert locus.plot(ax=own) is own
    assert len(lines_named(own, "singular kind 2")) == len(loci)
    alone = loci[0].plot("D")
    assert np.array_equal(points_of(lines_named(alone, "singular")[0]), loci[0].joints["D"])
    with pytest.raises(assur.InputError, match='no joint "X"'):
        loci[0].plot("X")


def test_assemblies_are_drawn_side_by_side_in_one_scale() -> None:
    found = assur.examples.watt_1().assemblies(1.0)
    axes = found.plot()
    assert len(axes) == len(found) == 4
    spans = [np.ptp(one.get_xlim()) for one in axes]
    assert spans == pytest.approx([spans[0]] * 4)
    titles = [one.get_title() for one in axes]
    assert [title[:3] for title in titles] == ["[0]", "[1]", "[2]", "[3]"]
    for one, assembly in zip(axes, found, strict=True):
        assert assembly.joints is not None
        for artist in one.get_children():
            name = (artist.get_gid() or "").partition("joint ")[2]
            if name:
                at = artist.get_transform() - one.transData
                place = at.transform(np.column_stack(artist.get_data()))[0]
                assert place == pytest.approx(assembly.joints[name], abs=1e-9)
        for name, sign in assembly.items():
            assert f"{name} {'+' if sign > 0 else '−'}" in one.get_title()
    with pytest.raises(assur.InputError, match="3 axes, there are 4 assemblies"):
        found.plot(ax=axes[:3])
    with pytest.raises(assur.InputError, match="no assembly"):
        assur.FourBar(3.0, 2.5, 2.0, 4.0).assemblies(3.0).plot()


def test_of_very_many_assemblies_some_are_drawn_and_all_are_counted() -> None:
    """Five dyads in sequence have 32 assemblies."""
    joints: dict[str, tuple[float, float]] = {"O": (0, 0), "P0": (0.3, 1.0)}
    links: dict[str, list[str]] = {"ground": ["O"], "crank": ["O", "P0"]}
    for i in range(5):
        joints |= {f"P{i + 1}": (1.5 * i + 1.5, 2.0), f"G{i}": (1.5 * i + 2.0, 0.0)}
        links["ground"].append(f"G{i}")
        links[f"rod{i}"] = [f"P{i}", f"P{i + 1}"]
        links[f"arm{i}"] = [f"P{i + 1}", f"G{i}"]
    m = assur.Mechanism(joints, links, driver="crank")
    found = m.assemblies(m.q0)
    assert len(found) == 32
    axes = found.plot()
    assert len(axes) == 24
    assert axes[0].figure.get_suptitle() == "24 of 32 assemblies"
