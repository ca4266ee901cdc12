"""Mechanisms drawn by matplotlib: what is where, how many, and what is written."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex

import assur
from assur.examples import ALL
from assur.pictures.scene.course import course
from assur.pictures.style import DARK, LIGHT
from pictures.drawn_examples import mechanism
from pictures.linkage.picture_overlaps import overlapping
from pictures.picture_reading import named

CRANK_ROCKER = assur.examples.crank_rocker()


def places(ax: Any, gid: str) -> np.ndarray[Any, Any]:
    """Return the drawn points of an artist in the drawing's axes."""
    (artist, *_) = named(ax, gid)
    path = artist.get_path()
    to_data = artist.get_transform() - ax.transData
    return np.asarray(to_data.transform(path.vertices))


def test_links_and_joints_are_drawn_where_they_are() -> None:
    q = 1.1
    ax = CRANK_ROCKER.plot(q)
    motion = CRANK_ROCKER.solve(q)
    for link in ("crank", "rocker"):
        ends = places(ax, f"link {link}")
        expected = [motion.joint(joint).value for joint in CRANK_ROCKER.links[link]]
        assert np.allclose(sorted(ends.tolist()), sorted(np.array(expected).tolist()), atol=1e-12)
    plate = places(ax, "link coupler")[:3]
    corners = [motion.joint(joint).value.tolist() for joint in "BCP"]
    assert np.allclose(sorted(plate.tolist()), sorted(corners), atol=1e-12)
    for joint in "ABCDP":
        assert places(ax, f"joint {joint}")[0] == pytest.approx(motion.joint(joint).value)


def test_fixed_pivots_and_nothing_else_stand_on_hatched_ground() -> None:
    ax = CRANK_ROCKER.plot()
    pivots = {a.get_gid() for a in ax.get_children() if (a.get_gid() or "").startswith("pivot")}
    assert pivots == {"pivot A", "pivot D"}
    # Triangle, base, hatching.
    assert len(named(ax, "pivot A")) == 3


def test_names_are_those_of_the_joints() -> None:
    texts = {t.get_text() for t in CRANK_ROCKER.plot().texts if str(t.get_gid()).startswith("name")}
    assert texts == set("ABCDP")
    plain = CRANK_ROCKER.plot(labels="none")
    assert not [t for t in plain.texts if str(t.get_gid()).startswith("name")]


# A tangent generator's cursor goes out of sight.
@pytest.mark.parametrize("name", [name for name in ALL if name != "tangent_generator"])
def test_the_frame_is_that_of_the_whole_motion(name: str) -> None:
    """Whatever the position, the same limits, and nothing drawn outside them."""
    own = mechanism(name)
    first = own.plot()
    limits = (*first.get_xlim(), *first.get_ylim())
    motion = course(own)
    if not motion.shape:
        return
    known = np.flatnonzero(motion.status < 3)
    assert all(_is_within(motion, int(row), limits) for row in known)
    for row in known[:: max(1, len(known) // 3)]:
        ax = own.plot(motion.coordinate(int(row)))
        assert (*ax.get_xlim(), *ax.get_ylim()) == pytest.approx(limits, rel=1e-3)


def _is_within(motion: Any, row: int, limits: tuple[float, ...]) -> bool:
    low, high = np.array(limits[::2]), np.array(limits[1::2])
    joints = np.array([motion.joint(name).value[row] for name in motion.mechanism.joints])
    return bool(((low < joints) & (joints < high)).all())


def test_proportions_are_true() -> None:
    ax = CRANK_ROCKER.plot()
    ax.figure.canvas.draw()
    one, two = ax.transData.transform([[0.0, 0.0], [0.01, 0.01]])
    assert two[0] - one[0] == pytest.approx(two[1] - one[1], rel=1e-9)


def test_the_scale_bar_is_as_long_as_it_says() -> None:
    ax = CRANK_ROCKER.plot()
    line, text = named(ax, "scale")
    length = float(np.ptp(line.get_xdata()))
    assert text.get_text() == "20 mm"
    assert length == pytest.approx(0.020)
    big = assur.FourBar(1000.0, 3000.0, 2500.0, 3000.0).plot()
    assert named(big, "scale")[1].get_text() == "1 km" or "m" in named(big, "scale")[1].get_text()


def test_drivers_have_the_colour_of_drivers_and_links_are_ink() -> None:
    ax = CRANK_ROCKER.plot()
    assert to_hex(named(ax, "link crank")[0].get_edgecolor()).upper() == LIGHT.driver
    assert to_hex(named(ax, "link rocker")[0].get_edgecolor()).upper() == LIGHT.ink
    dark = CRANK_ROCKER.plot(dark=True)
    assert to_hex(named(dark, "link rocker")[0].get_edgecolor()).upper() == DARK.ink
    assert to_hex(dark.figure.get_facecolor()).upper() == DARK.canvas


def test_groups_have_their_colours_and_the_formula_is_written() -> None:
    watt = assur.examples.watt_1()
    ax = watt.plot(groups=True)
    first, second = watt.structure.groups
    for number, group in enumerate((first, second)):
        for link in group.links:
            colours = {
                to_hex(a.get_edgecolor()).upper()
                for a in named(ax, f"link {link}")
                if a.get_linewidth() > 1.0 and a.get_edgecolor()[3]
            }
            assert colours == {LIGHT.group(number)}
    formula = [t.get_text() for t in named(ax, "formula")]
    assert " ".join(formula) == watt.structure.formula


def test_a_driven_slide_has_an_arrow_along_it() -> None:
    boom = assur.Mechanism(
        joints={"foot": (0, 0), "eye": (2, 1), "base": (1, -1)},
        links={"ground": ["foot", "base"], "boom": ["foot", "eye"]},
        slides={"lift": assur.Cylinder("base", "eye")},
        driver="lift",
    )
    ax = boom.plot()
    shaft = places(ax, "driver")
    along = (shaft[1] - shaft[0]) / np.hypot(*(shaft[1] - shaft[0]))
    # From the base at (1, -1) to the eye at (2, 1): q grows that way.
    assert along == pytest.approx(np.array([1.0, 2.0]) / np.sqrt(5.0))


def test_the_arrow_of_a_crank_turns_with_plus_q() -> None:
    ax = CRANK_ROCKER.plot(0.3)
    shaft = places(ax, "driver") - CRANK_ROCKER.solve(0.3).joint("A").value
    angles = np.unwrap(np.arctan2(shaft[:, 1], shaft[:, 0]))
    assert (np.diff(angles) > 0.0).all()
    assert angles[0] > 0.3


def test_many_positions_are_light_and_numbered() -> None:
    q = np.radians(np.arange(0, 360, 30))
    ax = CRANK_ROCKER.plot(q)
    numbers = [t for t in ax.texts if str(t.get_gid()).startswith("number")]
    assert [t.get_text() for t in numbers] == [str(i) for i in range(12)]
    motion = CRANK_ROCKER.solve(q)
    centre, r = np.zeros(2), CRANK_ROCKER.dimensions["crank.length"]
    for number, pin in zip(numbers, motion.joint("B").value, strict=True):
        x, y = number.get_position()
        assert np.hypot(x, y) > r
        # Shifted by no more than 18 degrees.
        turn = np.arctan2(y, x) - np.arctan2(*(pin - centre)[::-1])
        assert abs((turn + np.pi) % (2 * np.pi) - np.pi) < np.radians(18.5)
    # Crank, coupler, rocker eleven times.
    assert len(named(ax, "position")) == 33


def test_limits_are_written_as_the_closed_form_has_them() -> None:
    """The rocker of a crank-rocker turns back where crank and coupler are in line."""
    ax = CRANK_ROCKER.plot(np.radians(np.arange(0, 360, 30)))
    size = CRANK_ROCKER.dimensions
    a, b, c = (size[f"{link}.length"] for link in ("crank", "coupler", "rocker"))
    d = size["ground.D.x"]

    def angle(reach: float) -> float:
        return float(np.pi - np.arccos((c * c + d * d - reach * reach) / (2 * c * d)))

    low, high = sorted(np.degrees([angle(b - a), angle(b + a)]))
    (text,) = named(ax, "limits")
    assert text.get_text() == f"rocker from {low:.1f}° to {high:.1f}°, positions every 30°"
    ticks = named(ax, "limit C")
    directions = [
        np.degrees(np.arctan2(*(t.get_xydata().mean(axis=0) - (d, 0))[::-1])) for t in ticks
    ]
    assert sorted(directions) == pytest.approx([low, high])


def test_names_everywhere_have_the_numbers_of_their_positions() -> None:
    texts = {t.get_text() for t in CRANK_ROCKER.plot([0.0, 1.0, 2.0], labels="all").texts}
    assert {"A", "B", "B₁", "B₂", "C₁", "P₂"} <= texts
    assert "A₁" not in texts


def test_names_and_numbers_overlap_nothing() -> None:
    """Of a hundred texts over all examples and positions, two at most lie on something."""
    bad: dict[str, list[str]] = {}
    count = 0
    for name in ALL:
        own = mechanism(name)
        motion = course(own)
        known = np.flatnonzero(np.atleast_1d(motion.status) < 3)
        rows = known[np.linspace(0, len(known) - 1, 4).astype(int)].tolist()
        for row in rows if motion.shape else [()]:
            ax = own.plot(motion.coordinate(row))
            found, texts = overlapping(ax)
            bad.setdefault(name, []).extend(found)
            count += texts
            plt.close(ax.get_figure(root=True))
    assert count > 700
    assert sum(map(len, bad.values())) <= 0.02 * count, bad
    # No example is spoiled.
    assert max(map(len, bad.values())) <= 4, bad


def test_a_name_on_a_line_is_found() -> None:
    """The check above can fail: a name moved onto its joint, and one onto another."""
    ax = CRANK_ROCKER.plot()
    assert overlapping(ax)[0] == []
    (name,) = named(ax, "name B")
    name.set_position(places(ax, "joint B")[0])
    assert overlapping(ax)[0] == ["B"]
    (other,) = named(ax, "name D")
    other.set_position(named(ax, "name P")[0].get_position())
    assert set(overlapping(ax)[0]) == {"B", "D", "P"}


def test_pictures_on_given_axes_keep_what_is_there() -> None:
    _, (left, right) = plt.subplots(1, 2)
    assert CRANK_ROCKER.plot(ax=left) is left
    before = (*left.get_xlim(), *left.get_ylim())
    far = assur.FourBar(0.1, 0.3, 0.25, 0.3)
    far.plot(ax=left)
    after = (*left.get_xlim(), *left.get_ylim())
    assert after[0] <= before[0]
    assert after[3] >= before[3]
    assert not right.get_children()[0].get_gid()


def test_what_cannot_be_drawn_is_refused() -> None:
    batch = CRANK_ROCKER.with_dimensions({"rocker.length": [0.07, 0.08]})
    with pytest.raises(assur.InputError, match=r"a batch \(2,\): take one with design"):
        batch.plot()
    with pytest.raises(assur.InputError, match="labels is 'some'"):
        CRANK_ROCKER.plot(labels="some")  # type: ignore[arg-type]
    with pytest.raises(assur.InputError, match="no matplotlib axes"):
        CRANK_ROCKER.plot(ax=3)  # type: ignore[arg-type]
    with pytest.raises(assur.PositionError):
        assur.FourBar(3.0, 2.5, 2.0, 4.0).plot([0.0, 2.0])
    _, polar = plt.subplots(subplot_kw={"projection": "polar"})
    with pytest.raises(assur.InputError, match="projection 'polar'"):
        CRANK_ROCKER.plot(ax=polar)


def test_strange_names_are_written_as_they_are() -> None:
    joints = {"$x^2$": (0, 0), "a_b": (0, 1), "Пятка": (3, 2), "D&^": (3, 0)}
    m = assur.Mechanism(
        joints=joints,
        links={
            "ground": ["$x^2$", "D&^"],
            "crank": ["$x^2$", "a_b"],
            "coupler": ["a_b", "Пятка"],
            "rocker": ["D&^", "Пятка"],
        },
        driver="crank",
    )
    ax = m.plot()
    assert {t.get_text() for t in ax.texts if str(t.get_gid()).startswith("name")} == set(joints)
    ax.figure.canvas.draw()
