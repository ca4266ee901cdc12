"""Diagrams of motions: what they show is what was solved, their marks are the exact extremes."""

from __future__ import annotations

import math
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex

import assur
from assur.pictures.style import DARK, LIGHT
from pictures.diagrams.chart_overlaps import overlapping

TURN = 2.0 * math.pi
Q = np.linspace(0.0, TURN, 61)
FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.0)
ENGINE = assur.SliderCrank(0.05, 0.2, 0.01)


def curve(ax: Any, name: str) -> Any:
    (line,) = (line for line in ax.lines if line.get_gid() == f"curve {name}")
    return line.get_data()


def marks(ax: Any) -> list[tuple[float, float]]:
    return [
        (float(line.get_xdata()[0]), float(line.get_ydata()[0]))
        for line in ax.lines
        if line.get_gid() == "mark"
    ]


def titles(axes: Any) -> list[str]:
    return [ax.get_title(loc="left") for ax in np.atleast_1d(axes).flat]


def written(ax: Any) -> list[str]:
    return [t.get_text() for t in ax.texts if str(t.get_gid()).startswith("extreme")]


@pytest.mark.parametrize(
    ("mechanism", "name"),
    [
        (FOUR_BAR, "rocker"),
        (FOUR_BAR, "C.x"),
        (ENGINE, "bore"),
        (assur.examples.shaper(), "ram"),
        (assur.examples.loom(), "l95"),
    ],
)
def test_marks_are_the_exact_extremes(mechanism: assur.Mechanism, name: str) -> None:
    """Samples 6° apart; `extremes` finds the roots of the next derivative."""
    slides = list(mechanism.slides)
    name = slides[-1] if name == "ram" else name
    axes = mechanism.solve(Q).diagram(name)
    for order, ax in enumerate(axes.flat):
        exact = mechanism.extremes(name, order=order)
        size = max(abs(exact.max.value), abs(exact.min.value))
        (x1, y1), (x0, y0) = marks(ax)
        assert y1 == pytest.approx(exact.max.value, abs=1e-9 * size)
        assert y0 == pytest.approx(exact.min.value, abs=1e-9 * size)
        for x, end in ((x1, exact.max), (x0, exact.min)):
            # Nearly the same value may be taken elsewhere too.
            apart = abs(math.remainder(x - end.q, TURN))
            other = getattr(mechanism.solve(x)[name.split(".")[0]], ("value", "d1", "d2")[order])
            same = float(np.ravel(other)[0])
            assert apart < 1e-4 or same == pytest.approx(end.value, abs=1e-9 * size)


def test_curves_titles_and_ticks_with_a_speed() -> None:
    motion = FOUR_BAR.solve(Q, order=3)
    rocker = motion.link("rocker")
    axes = motion.diagram("rocker", speed=10.0, acceleration=3.0, jerk=-2.0, degrees=True)
    assert axes.shape == (2, 2)
    wanted = (
        np.degrees(rocker.value),
        rocker.velocity(10.0),
        rocker.acceleration(10.0, 3.0),
        rocker.jerk(10.0, 3.0, -2.0),
    )
    for ax, values in zip(axes.flat, wanted, strict=True):
        x, y = curve(ax, "rocker")
        np.testing.assert_allclose(x, np.degrees(Q), rtol=1e-15)
        np.testing.assert_array_equal(y, values)
        ticks = [tick for tick in ax.get_xticks() if 0.0 <= tick <= 360.0]
        assert ticks == [0, 60, 120, 180, 240, 300, 360]
        assert ax.get_title(loc="right") == "rocker"
        low, high = ax.get_ylim()
        assert low < values.min() < values.max() < high
    assert titles(axes) == [
        "Angle, °",
        "Angular velocity, rad/s",
        "Angular acceleration, rad/s²",
        "Angular jerk, 10³ rad/s³",
    ]
    # ω C-D cos = …: the text has the number beside the axis, in thousands.
    fine = FOUR_BAR.solve(np.linspace(0.0, TURN, 36001), order=3).link("rocker")
    jerk = fine.jerk(10.0, 3.0, -2.0)
    place = math.degrees(TURN * int(np.argmax(jerk)) / 36000)
    assert written(axes[1, 1])[0] == f"{jerk.max() / 1000:#.3g} at {place:.0f}°"
    axes[0, 0].figure.canvas.draw()
    labels = [label.get_text() for label in axes[1, 1].get_xticklabels()]
    assert "60°" in labels


def test_analogues_have_their_units() -> None:
    motion = ENGINE.solve(Q, order=3)
    assert titles(motion.diagram("bore")) == [
        "Displacement, m",
        "Velocity analogue, mm/rad",
        "Acceleration analogue, mm/rad²",
        "Third analogue, mm/rad³",
    ]
    assert titles(motion.diagram("rod", orders=[1, 2])) == [
        "Velocity analogue, rad/rad",
        "Acceleration analogue, rad/rad²",
    ]
    by_slide = ENGINE.with_driver("bore").solve(np.linspace(0.17, 0.24, 31))
    ax = by_slide.diagram("crank", orders=1)
    assert titles(ax) == ["Velocity analogue, rad/m"]
    assert ax.get_xlabel() == "q, m"
    assert " m" in written(ax)[0]
    ax = motion.diagram("bore", speed=200.0, orders=2)
    assert titles(ax) == ["Acceleration, 10³ m/s²"]
    assert ax.get_xlabel() == "q, rad"
    np.testing.assert_array_equal(curve(ax, "bore")[1], motion.slide("bore").acceleration(200.0))


def test_a_joint_has_components_and_a_magnitude() -> None:
    motion = FOUR_BAR.solve(Q)
    axes = motion.diagram("C", speed=2.0)
    np.testing.assert_array_equal(curve(axes[0], "x")[1], motion.joint("C").value[:, 0])
    np.testing.assert_array_equal(curve(axes[0], "y")[1], motion.joint("C").value[:, 1])
    velocity = motion.joint("C").velocity(2.0)
    np.testing.assert_array_equal(curve(axes[1], "y")[1], velocity[:, 1])
    size = np.linalg.norm(velocity, axis=1)
    np.testing.assert_allclose(curve(axes[1], "|v|")[1], size, rtol=1e-14)
    assert {t.get_text() for t in axes[1].texts} >= {"x", "y", "|v|"}
    # C turns about D: the greatest of |v| is that of the rocker's speed.
    fastest = max(abs(e.value) for e in (FOUR_BAR.extremes("rocker", order=1).max,
                                         FOUR_BAR.extremes("rocker", order=1).min))  # fmt: skip
    assert marks(axes[1])[0][1] == pytest.approx(2.0 * 2.5 * fastest, rel=1e-9)
    one = motion.diagram("C.y", speed=2.0, orders=1)
    np.testing.assert_array_equal(curve(one, "C.y")[1], velocity[:, 1])
    assert one.get_title(loc="right") == "C.y"


def test_several_names_stand_beside_their_lines() -> None:
    motion = FOUR_BAR.solve(Q)
    axes = motion.diagram(["coupler", "rocker"], speed=1.0)
    for ax in axes:
        names = [t.get_text() for t in ax.texts if str(t.get_gid()).startswith("name")]
        assert sorted(names) == ["coupler", "rocker"]
        assert ax.get_legend() is None
        colours = {line.get_color() for line in ax.lines if "curve" in str(line.get_gid())}
        assert len(colours) == 2
    both = motion.diagram(["B", "C"], speed=1.0, orders=[0, 1])
    assert [len([x for x in ax.lines if "curve" in str(x.get_gid())]) for ax in both] == [4, 2]


def test_constants_and_zero() -> None:
    motion = FOUR_BAR.solve(Q)
    axes = motion.diagram("crank", speed=10.0)
    assert [t.get_text() for t in axes[1].texts] == ["10.0 throughout"]
    assert [t.get_text() for t in axes[2].texts] == ["0 throughout"]
    assert marks(axes[1]) == marks(axes[2]) == []


def test_a_batch_is_a_band() -> None:
    lengths = np.linspace(2.3, 2.8, 12).reshape(3, 4)
    batch = FOUR_BAR.with_dimensions({"rocker.length": lengths})
    motion = batch.solve(Q)
    values = motion.link("rocker").d1.reshape(12, -1)
    ax = motion.diagram("rocker", orders=1)
    np.testing.assert_allclose(curve(ax, "rocker")[1], np.median(values, axis=0), rtol=1e-14)
    edges = [x.get_ydata() for x in ax.lines if str(x.get_gid()) == "edge rocker"]
    np.testing.assert_array_equal(edges, [values.min(axis=0), values.max(axis=0)])
    (band,) = ax.collections
    assert band.get_gid() == "band rocker"
    assert ax.get_title(loc="right") == "rocker, 12 designs"
    exact = [batch.design(divmod(i, 4)).extremes("rocker", order=1)
             for i in range(12)]  # fmt: skip
    greatest = max(one.max.value for one in exact)
    least = min(one.min.value for one in exact)
    assert [y for _, y in marks(ax)] == pytest.approx([greatest, least], rel=1e-9)


def test_gaps_stay_gaps_and_what_runs_to_infinity_is_cut() -> None:
    """A double-rocker: the rocker is driven to both dead points, where its partner flies off."""
    mechanism = assur.FourBar(2.5, 3.0, 2.5, 3.5)
    ((low, high),) = mechanism.limits().intervals
    q = np.linspace(low - 0.1, high + 0.1, 401)
    motion = mechanism.solve(q, on_error="nan")
    axes = motion.diagram("rocker", degrees=True)
    _, y = curve(axes[1], "rocker")
    assert np.isnan(y).sum() == (motion.status > 2).sum() > 10
    np.testing.assert_array_equal(y, motion.link("rocker").d1)
    d2 = motion.link("rocker").d2
    top = axes[2].get_ylim()[1]
    assert top < 0.2 * np.nanmax(d2)
    (arrow,) = (line for line in axes[2].lines if line.get_marker() == "^")
    assert arrow.get_ydata()[0] == top
    first = float(written(axes[2])[0].split()[0])
    assert first >= np.nanmax(d2) * 0.999
    nothing = assur.FourBar(1.0, 1.0, 1.0, 9.0).solve(Q, on_error="nan")
    assert marks(nothing.diagram("rocker", orders=0)) == []


def test_speeds_of_their_own_at_every_position() -> None:
    """A flywheel's motion: between samples a parabola."""
    motion = FOUR_BAR.solve(np.linspace(0.0, TURN, 361))
    omega = 10.0 + np.sin(motion.q)
    ax = motion.diagram("rocker", speed=omega, orders=1)
    np.testing.assert_array_equal(curve(ax, "rocker")[1], motion.link("rocker").d1 * omega)
    fine = FOUR_BAR.solve(np.linspace(0.0, TURN, 36001))
    speed = fine.link("rocker").d1 * (10.0 + np.sin(fine.q))
    assert [y for _, y in marks(ax)] == pytest.approx([speed.max(), speed.min()], rel=1e-6)


def test_over_time() -> None:
    """Half a turn of a cycloid: its greatest speed is twice the mean, in the middle."""
    law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
    moved = ENGINE.follow(law, np.linspace(0.0, 0.5, 40))
    axes = moved.diagram("crank")
    assert axes.shape == (2, 2)
    assert marks(axes[0, 1])[0] == pytest.approx((0.25, 4.0 * np.pi), rel=1e-4)
    # The greatest acceleration of a cycloid is 2π h/T², at a quarter of the time.
    assert marks(axes[1, 0])[0] == pytest.approx((0.125, 2.0 * np.pi**2 / 0.25), rel=1e-3)
    x, y = curve(axes[1, 1], "crank")
    np.testing.assert_array_equal(x, moved.t)
    np.testing.assert_array_equal(y, moved.jerk)
    ax = moved.diagram("A", orders=1)
    assert ax.get_xlabel() == "t, s"
    np.testing.assert_array_equal(curve(ax, "y")[1], moved.joint("A").velocity()[:, 1])


def test_colours_and_axes_given() -> None:
    motion = FOUR_BAR.solve(Q)
    figure, given = plt.subplots(1, 3)
    assert motion.diagram("rocker", ax=given, speed=1.0)[1] is given[1]
    assert given[1].lines[0].get_color() == LIGHT.velocity
    dark = motion.diagram("rocker", speed=1.0, orders=2, dark=True)
    assert dark.lines[0].get_color() == DARK.acceleration
    assert to_hex(dark.figure.get_facecolor()) == DARK.canvas.lower()
    assert len(figure.axes) == 3


def test_refusals() -> None:
    motion = FOUR_BAR.solve(Q)
    batch = FOUR_BAR.with_dimensions({"rocker.length": [2.4, 2.5]})
    own = batch.solve(np.stack([Q, Q + 0.1]))
    several = assur.examples.five_bar()
    cases: tuple[tuple[Any, str], ...] = (
        (lambda: motion.diagram("X"), r"'X'.*no joint, link or slide has this name"),
        (lambda: motion.diagram([]), "not a name"),
        (lambda: motion.diagram(["C", "rocker"]), "different units"),
        (lambda: motion.diagram("C.z"), "no joint, link or slide has this name"),
        (lambda: motion.diagram("rocker", orders=3), r"order=3"),
        (lambda: motion.diagram("rocker", orders=4), "orders"),
        (lambda: motion.diagram("rocker", orders=[]), "orders is empty"),
        (lambda: motion.diagram("rocker", ax=plt.gca()), "ax has 1 axes: 3 are needed"),
        (lambda: motion.diagram("rocker", speed=np.ones((2, 1))), "one speed at each position"),
        (lambda: motion[3].diagram("rocker"), r"positions \(N,\)"),
        (lambda: own.diagram("rocker"), "its own q"),
        (
            lambda: several.solve(np.stack([several.q0] * 2)).diagram("P"),
            "one driver's coordinate.*follow",
        ),
    )
    for make, said in cases:
        with pytest.raises(assur.InputError, match=said):
            make()


def test_texts_are_clear_of_curves_and_of_each_other() -> None:
    """Of joints and links of some examples, in all orders; at most 2 % may overlap."""
    count = 0
    bad: list[str] = []
    for name in ("engine", "shaper", "jansen_leg", "loom"):
        made: Any = assur.examples.ALL[name]()
        first, last = assur.examples.RANGES[name]
        motion = made.solve(np.linspace(first, last, 121))
        moving = [joint for joint in made.joints if joint not in made.links["ground"]]
        joint = moving[len(name) % len(moving)]
        of = joint if len(name) % 2 else [link for link in made.links if link != "ground"][-2:]
        axes = motion.diagram(of, speed=5.0, degrees=True)
        written, wrong = overlapping(axes[0].figure)
        count += written
        bad += [f"{name}: {text}" for text in wrong]
        plt.close("all")
    assert count > 40
    assert len(bad) <= 0.02 * count, bad
