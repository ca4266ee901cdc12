"""Pictures of sweeps and design maps, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur import metric
from assur.pictures.maps.raster import finer
from pictures.picture_reading import named

Q = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.0)


def strokes() -> assur.Measures:
    grid = assur.Grid({"rod.length": [0.5, 0.6, 0.8], "crank.length": np.linspace(0.1, 0.3, 5)})
    asked = {"stroke": metric.span("bore")}
    return assur.sweep(assur.SliderCrank(0.1, 0.5), grid, Q, metrics=asked)


def test_contours_lie_where_the_stroke_is_twice_the_crank() -> None:
    ax = strokes().plot("stroke")
    (lines,) = named(ax, "contours")
    paths = lines.get_paths()
    assert len(paths) >= 3
    for level, path in zip(lines.levels, paths, strict=True):
        assert path.vertices[:, 1] == pytest.approx(level / 2.0, abs=1e-12)
    texts = {text.get_text() for text in named(ax, "contour value")}
    assert texts <= {f"{level:.6g}" for level in lines.levels}


def test_the_best_designs_are_marked_where_they_are() -> None:
    ax = strokes().plot("stroke")
    (least,), (greatest,) = named(ax, "best min"), named(ax, "best max")
    assert least.get_ydata() == [0.1]
    assert greatest.get_ydata() == [0.3]
    assert [t.get_text() for t in named(ax, "best text")] == ["min 0.200", "max 0.600"]
    assert not named(strokes().plot("stroke", best="none"), "best text")


def test_reasons_are_those_of_the_closed_form() -> None:
    from assur.sweeps.reasons import reasons

    lengths = np.linspace(0.57, 6.03, 23)
    grid = assur.Grid({"coupler.length": lengths, "ground.D.x": lengths})
    found = assur.sweep(FOUR_BAR, grid, Q, metrics={"angle": metric.min_transmission_angle("C")})
    coupler, ground = np.meshgrid(lengths, lengths, indexing="ij")
    sides = np.stack([np.ones_like(coupler), coupler, np.full_like(coupler, 2.5), ground])
    never = 2.0 * sides.max(axis=0) > sides.sum(axis=0)
    why = dict(reasons(found, found["angle"]))
    assert set(why) == {"cannot be assembled", "crank stops"}
    assert np.array_equal(why["cannot be assembled"].reshape(never.shape), never)
    stops = np.isnan(found["angle"]) & ~never
    assert np.array_equal(why["crank stops"].reshape(never.shape), stops)


def test_regions_without_value_are_hatched_with_their_reason() -> None:
    lengths = np.linspace(0.8, 6.0, 27)
    grid = assur.Grid({"coupler.length": lengths, "ground.D.x": lengths})
    where = [metric.min_transmission_angle("C") > 0.5]
    found = assur.sweep(FOUR_BAR, grid, Q, metrics={"swing": metric.span("rocker")}, where=where)
    ax = found.plot("swing", degrees=True)
    wanted = {"crank stops", "cannot be assembled", "min_transmission_angle(C) ≤ 0.5"}
    patches = [p for p in ax.patches if (p.get_gid() or "").startswith("region ")]
    assert {str(p.get_gid()).removeprefix("region ") for p in patches} == wanted
    assert len({p.get_hatch() for p in patches}) == 3
    said = {text.get_text() for text in named(ax, "reason")}
    legend = ax.get_legend()
    assert legend
    said |= {text.get_text() for text in legend.get_texts()}
    assert said == wanted
    # A node is hatched exactly if it has no value.
    nodes = np.stack(np.meshgrid(lengths, lengths, indexing="ij"), axis=-1).reshape(-1, 2)
    inside = [p.get_path().contains_points(nodes, radius=0.0) for p in patches]
    kept = np.isfinite(found["swing"]).reshape(-1)
    assert not (np.any(inside, axis=0) & kept).any()


@pytest.mark.parametrize("dark", [False, True])
def test_texts_of_a_map_do_not_overlap(dark: bool) -> None:
    lengths = np.linspace(0.8, 6.0, 33)
    grid = assur.Grid({"coupler.length": lengths, "ground.D.x": lengths})
    found = assur.sweep(FOUR_BAR, grid, Q, metrics={"angle": metric.min_transmission_angle("C")})
    ax = found.plot("angle", degrees=True, dark=dark)
    figure = ax.get_figure(root=True)
    assert figure
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in ax.texts]
    assert len(boxes) >= 6
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_where_nothing_moves_the_whole_map_says_why() -> None:
    grid = assur.Grid({"coupler.length": [9.0, 10.0, 11.0], "ground.D.x": [2.5, 3.0]})
    found = assur.sweep(FOUR_BAR, grid, Q, metrics={"angle": metric.min_transmission_angle("C")})
    ax = found.plot("angle")
    assert [text.get_text() for text in named(ax, "reason")] == ["cannot be assembled"]
    assert not named(ax, "colours")


def test_over_one_dimension_a_curve_has_gaps() -> None:
    lengths = np.linspace(0.06, 0.66, 13)
    found = assur.sweep(
        assur.SliderCrank(0.1, 0.4),
        {"crank.length": lengths},
        Q,
        metrics={"s": metric.span("bore")},
    )
    ax = found.plot("s")
    (line,) = named(ax, "s")
    assert line.get_xdata() == pytest.approx(lengths)
    known = lengths < 0.4
    assert np.array_equal(np.isfinite(line.get_ydata()), known)
    assert line.get_ydata()[known] == pytest.approx(2.0 * lengths[known], rel=1e-3)
    assert [text.get_text() for text in named(ax, "reason")] == ["crank stops"]
    (span,) = named(ax, "region crank stops")
    assert span.get_x() == pytest.approx((0.36 + 0.41) / 2.0)


def test_what_is_no_map_is_refused_by_name() -> None:
    asked = {"s": metric.span("bore")}
    engine = assur.SliderCrank(0.1, 0.4)
    grid = assur.Grid(
        {"crank.length": [0.1, 0.2], "rod.length": [0.5, 0.6], "bore.offset": [0.0, 0.1]}
    )
    found = assur.sweep(engine, grid, Q, metrics=asked)
    with pytest.raises(assur.InputError, match=r"3 dimensions .*fix the others, as at=.*bore"):
        found.plot("s")
    ax = found.plot("s", at={"bore.offset": 0.1}, best="max")
    both = assur.SliderCrank(0.2, 0.6, offset=0.1), assur.SliderCrank(0.2, 0.5, offset=0.1)
    spans = [float(np.ptp(m.solve(Q).slide("bore").value)) for m in both]
    (text,) = named(ax, "best text")
    assert text.get_text() == f"max {max(spans):.3f}"
    with pytest.raises(assur.InputError, match=r"0\.3 is not a value of the sweep; the nearest"):
        found.plot("s", at={"bore.offset": 0.3})
    with pytest.raises(assur.InputError, match=r"'crank' is not a dimension of the sweep"):
        found.plot("s", at={"crank": 0.3})
    pairs = {"crank.length": [0.1, 0.2], "rod.length": [0.5, 0.6]}
    paired = assur.sweep(engine, pairs, Q, metrics=asked)
    with pytest.raises(assur.InputError, match=r"changes crank\.length, rod\.length"):
        paired.plot("s")
    with pytest.raises(assur.InputError, match="one design alone"):
        assur.sweep(engine, {}, Q, metrics=asked).plot("s")
    with pytest.raises(assur.InputError, match="no metric has this name"):
        paired.plot("stroke")
    with pytest.raises(assur.InputError, match="best"):
        paired.plot("s", best="most")  # type: ignore[arg-type]


def test_a_map_of_full_rotation_is_grashof_at_every_finer_node() -> None:
    lengths = np.linspace(0.55, 5.9, 15)
    found = FOUR_BAR.map("full_rotation", {"rocker.length": lengths, "ground.D.x": lengths})
    x, y, values = finer(found.x, found.y, found.values, [b.points for b in found.boundaries])
    rocker, ground = np.meshgrid(x, y, indexing="ij")
    sides = np.sort(np.stack([np.ones_like(rocker), np.full_like(rocker, 3.0), rocker, ground]), 0)
    shortest = np.minimum(ground, 1.0) == sides[0]
    turns = (sides[0] + sides[3] < sides[1] + sides[2]) & shortest
    wrong = np.argwhere(values != turns)
    assert len(wrong) < 0.005 * turns.size
    # Of two boundaries that meet within a cell the map knows nothing.
    at = np.stack([x[wrong[:, 0]], y[wrong[:, 1]]], axis=-1)
    corners = np.array([[1.0, 3.0], [3.0, 1.0]])
    gaps = np.abs(at[:, None] - corners).max(axis=-1).min(axis=1)
    assert gaps.max() < lengths[1] - lengths[0]


def test_a_design_map_shows_its_boundaries_and_names() -> None:
    lengths = np.linspace(0.55, 5.9, 15)
    found = FOUR_BAR.map("assemblies", {"rocker.length": lengths, "ground.D.x": lengths})
    ax = found.plot(dark=True)
    drawn = [line for line in ax.lines if (line.get_gid() or "").startswith("boundary")]
    assert len(drawn) == len(found.boundaries)
    for line, boundary in zip(drawn, found.boundaries, strict=True):
        assert np.array_equal(np.column_stack(line.get_data()), boundary.points)
    assert {text.get_text() for text in ax.texts} == {"cannot be assembled", "2 assemblies"}
