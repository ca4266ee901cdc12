"""Pictures of bad arguments, of what is far out of sight, and of mechanisms without extent."""

from __future__ import annotations

import io
import pickle
from typing import TYPE_CHECKING, Any, cast

import matplotlib.pyplot as plt
import numpy as np
import pytest

import assur
from assur.pictures import centrodes, hodograph, inflection_circle, instant_centres
from assur.pictures.scene.labels import along
from assur.pictures.text import printable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

CRANK_ROCKER: Any = assur.examples.crank_rocker()
TURN: Any = CRANK_ROCKER.solve(np.linspace(0.0, 2.0 * np.pi, 37), order=2)


@pytest.fixture(autouse=True)
def _closed() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda: TURN.plot(3), "joint is 3: a name or a list"),
        (lambda: TURN.plot(b"P"), "joint: the name b'P'"),
        (lambda: TURN.plot("P", vectors=1), "vectors is 1"),
        (lambda: TURN.animate("never.gif", joint=1.5), "joint is 1.5"),
        (lambda: TURN.animate("never.gif", seconds=1e9), "seconds is 1000000000.0"),
        (lambda: TURN.plot("P", vectors="velocity", speed=np.inf), "speed is inf"),
        (lambda: hodograph(TURN, "P", speed=np.nan), "speed is nan"),
        (lambda: TURN.polygon("velocity", at=1, speed=np.inf), "speed is inf"),
        (
            lambda: TURN.polygon("acceleration", at=1, acceleration=[1.0, 2.0]),
            r"acceleration has shape \(2,\)",
        ),
        (lambda: TURN.polygon("velocity", at=1, speed=[]), r"speed has shape \(0,\)"),
        (lambda: TURN.polygon("velocity", at=1, speed=1e250), "wide: from 1e-100 to 1e"),
        (lambda: CRANK_ROCKER.plot([]), r"shape \(0,\): there is no position"),
        (lambda: CRANK_ROCKER.plot(groups=[1, 2]), "groups is"),
        (lambda: CRANK_ROCKER.plot(dark=None), "dark is None"),
    ],
)
def test_bad_arguments_are_named(draw: Callable[[], Any], words: str) -> None:
    with pytest.raises(assur.InputError, match=words):
        draw()


def test_centrodes_take_an_index_of_numpy() -> None:
    axes = centrodes(TURN, "coupler", at=cast("int", np.int8(2)))
    pole = next(line for line in axes.lines if line.get_gid() == "pole")
    drawn = np.asarray(pole.get_xydata())[0]
    assert np.allclose(drawn, TURN[2].instant_centre("coupler", "ground"))


def test_a_pole_out_of_sight_is_written_and_not_drawn() -> None:
    parallelogram = assur.FourBar(1.0, 3.0, 1.0, 3.0001)
    axes = centrodes(parallelogram.solve(1.0), "coupler")
    assert not [one for one in axes.get_children() if one.get_gid() in ("pole", "pole name")]
    assert any("out of sight" in text.get_text() for text in axes.texts)
    axes.figure.canvas.draw()


def test_an_inflection_circle_of_a_million_times_the_size_is_drawn() -> None:
    long = assur.FourBar(1e-6, 1.0, 1.0, 1.0)
    axes = inflection_circle(long.solve(1.0, order=2), "coupler")
    axes.figure.canvas.draw()


def test_lines_are_sampled_where_they_are_seen() -> None:
    bounds = np.array([0.0, 0.0]), np.array([10.0, 5.0])
    line = np.array([[-1e9, 2.0], [1e9, 2.0]])
    points = along([line], 1.0, bounds)
    assert 20 < len(points) < 50
    assert np.allclose(points[:, 1], 2.0)
    assert points[:, 0].min() <= 0.0
    assert points[:, 0].max() >= 10.0
    beside = np.array([[-1e9, 20.0], [1e9, 20.0]])
    assert not len(along([beside], 1.0, bounds))
    inside = np.array([[1.0, 1.0], [4.0, 3.0], [4.0, 4.0]])
    assert np.array_equal(along([inside], 1.0, bounds), along([inside], 1.0))


def test_a_link_of_one_joint_is_drawn_with_room_about_it(tmp_path: Path) -> None:
    knob = assur.Mechanism(joints={"O": (2, 3)}, links={"ground": "O", "knob": "O"}, driver="knob")
    axes = knob.plot()
    axes.figure.canvas.draw()
    assert 0.5 < np.ptp(axes.get_xlim()) < 5.0
    with pytest.raises(assur.InputError, match="width is not given"):
        knob.to_drawing(tmp_path / "knob.svg")
    assert knob.to_drawing(tmp_path / "knob.svg", width=0.02) > 0.0


def test_many_centres_in_one_place_are_counted() -> None:
    star = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0), **{f"B{i}": (2.0, i + 1.0) for i in range(8)}},
        links={
            "ground": ["O", *(f"B{i}" for i in range(8))],
            "crank": ["O", "A"],
            **{f"pin{i}": ["A"] for i in range(8)},
            **{f"bar{i}": [f"B{i}"] for i in range(8)},
        },
        slides={f"s{i}": assur.Slide(f"pin{i}", on=f"bar{i}", angle=1.0) for i in range(8)},
        driver="crank",
    )
    axes = instant_centres(star.solve(0.3))
    assert any(text.get_text().endswith(" more") for text in axes.texts)
    frame = axes.figure.bbox
    for text in axes.texts:
        box = text.get_window_extent()
        assert box.x0 >= frame.x0 - 4.0
        assert box.x1 <= frame.x1 + 4.0


def test_sizes_along_paths_keep_clear_of_names_and_each_other() -> None:
    axes = TURN.plot(["B", "C", "P"], at=5, vectors=["velocity", "acceleration"], speed=4.0)
    axes.figure.canvas.draw()
    sizes = [text for text in axes.texts if str(text.get_gid()).endswith("text")]
    names = [text for text in axes.texts if str(text.get_gid()).startswith("name ")]
    assert len(sizes) == 6
    assert sum("_{P}" in text.get_text() for text in sizes) == 2
    boxes = [text.get_window_extent().padded(-1.0) for text in [*sizes, *names]]
    pairs = [(one, two) for i, one in enumerate(boxes) for two in boxes[:i] if one.overlaps(two)]
    assert not pairs


NAMES = ["点🦾", "a" * 300, "$x$", "$^_$&"]


@pytest.mark.parametrize("name", NAMES)
def test_names_of_any_letters_are_drawn(name: str, tmp_path: Path) -> None:
    strange = assur.Mechanism(
        joints={"O": (0, 0), name: (1, 0), "Z": (3, 0)},
        links={"ground": ["O"], f"{name}L": ["O", name], f"{name}R": [name, "Z"], "piston": ["Z"]},
        slides={f"{name}S": assur.Slide("piston", on="ground", angle=0.0)},
        driver=f"{name}L",
    )
    motion = strange.solve(np.linspace(0.0, 2.0 * np.pi, 13), order=2)
    pictures: list[Any] = [
        strange.plot([0.0, 1.0, 2.0], labels="all", groups=True),
        motion.plot([name, "Z"], vectors="velocity"),
        motion.diagram(f"{name}S", orders=[0]),
        motion.diagram(["Z.x", f"{name}.x"], orders=[0]),
        motion.polygon("acceleration", at=2),
        instant_centres(motion, at=2),
        centrodes(motion, f"{name}R"),
        hodograph(motion, name),
        strange.configuration_curve().plot(f"{name}R"),
    ]
    for picture in pictures:
        np.atleast_1d(picture).flat[0].figure.canvas.draw()
    strange.to_drawing(tmp_path / "parts.pdf", link="all")
    names = [text for text in pictures[0].texts if str(text.get_gid()) == f"name {name}"]
    assert printable("ω²\nφ") == "ω²\nφ"
    # Without a font that has them letters are boxes.
    assert [text.get_text() for text in names] == ["□□" if name == "点🦾" else name]


def test_axes_that_cannot_show_true_proportion_are_refused() -> None:
    _, (left, right) = plt.subplots(1, 2)
    left.set_xscale("log")
    with pytest.raises(assur.InputError, match="logarithmic scale"):
        CRANK_ROCKER.plot(ax=left)
    with pytest.raises(assur.InputError, match="logarithmic scale"):
        TURN.diagram("rocker", ax=left, orders=0)
    right.remove()
    with pytest.raises(assur.InputError, match="removed from its figure"):
        CRANK_ROCKER.plot(ax=right)


@pytest.mark.parametrize("layout", ["constrained", "compressed", "tight"])
def test_a_layout_changes_no_limits(layout: Any, caplog: pytest.LogCaptureFixture) -> None:
    figure, axes = plt.subplots(2, 2, layout=layout)
    one = CRANK_ROCKER.plot(ax=axes[0, 1])
    limits = *one.get_xlim(), *one.get_ylim()
    axes[0, 0].set_title("high\nand higher")
    figure.canvas.draw()
    assert (*one.get_xlim(), *one.get_ylim()) == limits
    assert not caplog.records


@pytest.mark.parametrize("parameter", ["figure.autolayout", "figure.constrained_layout.use"])
def test_layouts_of_rcparams_leave_pictures_alone(parameter: str) -> None:
    changed: Any = {parameter: True}
    with plt.rc_context(changed):
        for axes in (CRANK_ROCKER.plot(), CRANK_ROCKER.assemblies(1.0).plot()[0]):
            before = axes.get_position().bounds
            axes.figure.savefig(io.BytesIO(), format="svg")
            assert axes.get_position().bounds == before


def test_figures_can_be_pickled() -> None:
    curve = CRANK_ROCKER.configuration_curve().plot("rocker")
    diagram = TURN.diagram("rocker", orders=0, degrees=True)
    for axes in (curve, diagram, TURN.plot("P")):
        pickle.loads(pickle.dumps(axes.figure)).canvas.draw()
