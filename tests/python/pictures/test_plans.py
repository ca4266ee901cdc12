"""Plans of velocities and accelerations: closed forms, similarity, slides, names."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import assur
from assur.pictures.plans.plan import plan_of
from assur.pictures.style import DARK
from pictures.picture_reading import gids, named, one, overlapping, texts, vector

LINES = {"velocity", "acceleration", "normal", "tangential", "sliding", "coriolis"}


def _mechanism(name: str) -> assur.Mechanism:
    made = assur.examples.ALL[name]()
    mechanism = made if isinstance(made, assur.Mechanism) else made.mechanism
    assert mechanism is not None
    return mechanism


def _example(name: str) -> tuple[assur.Motion, Any, Any]:
    """Return a position of an example away from its ends, a speed and an acceleration."""
    mechanism = _mechanism(name)
    low, high = (np.asarray(end) for end in assur.examples.RANGES[name])
    n = mechanism.driver_count
    speed = 3.0 if n == 1 else np.array([1.0, -2.0, 1.5])[:n]
    return mechanism.solve((low + 0.29 * (high - low)).tolist()), speed, 0.7 * speed


def test_velocities_of_a_four_bar() -> None:
    """By the angles of its links: v_CB and v_C are perpendicular to their links."""
    a, b, c, w = 1.0, 3.0, 2.5, 7.0
    motion = assur.FourBar(a, b, c, 3.0).solve(1.1)
    p1, p2 = 1.1, float(motion.link("coupler").value)
    rocker = motion.joint("C").value - motion.joint("D").value
    p3 = float(np.arctan2(rocker[1], rocker[0]))
    w2 = w * a * np.sin(p3 - p1) / (b * np.sin(p2 - p3))
    w3 = w * a * np.sin(p1 - p2) / (c * np.sin(p3 - p2))
    ax = motion.polygon("velocity", speed=w)
    tip_b = w * a * np.array([-np.sin(p1), np.cos(p1)])
    tip_c = w3 * c * np.array([-np.sin(p3), np.cos(p3)])
    for joint, tip in (("B", tip_b), ("C", tip_c)):
        drawn = vector(ax, f"velocity {joint}")
        np.testing.assert_allclose(drawn, np.array([[0.0, 0.0], tip]), atol=1e-12)
    relative = vector(ax, "velocity C relative to B")
    np.testing.assert_allclose(relative[0], tip_b, atol=1e-12)
    np.testing.assert_allclose(
        relative[1] - relative[0], w2 * b * np.array([-np.sin(p2), np.cos(p2)]), atol=1e-12
    )
    size = float(np.hypot(*tip_c))
    assert one(ax, "velocity C text").get_text() == f"$v_{{C}}$ = {size:#.3g}"


def test_accelerations_of_a_slider_crank() -> None:
    r, l, w, q = 0.1, 0.35, 20.0, 0.8  # noqa: E741
    motion = assur.SliderCrank(r, l).solve(q)
    beta = -np.arcsin(r * np.sin(q) / l)
    wb = -r * w * np.cos(q) / (l * np.cos(beta))
    eb = (r * w**2 * np.sin(q) + l * wb**2 * np.sin(beta)) / (l * np.cos(beta))
    ax = motion.polygon("acceleration", speed=w)
    along, across = np.array([np.cos(beta), np.sin(beta)]), np.array([-np.sin(beta), np.cos(beta)])
    pin = -r * w**2 * np.array([np.cos(q), np.sin(q)])
    normal, tangential = (
        vector(ax, f"{part} B relative to A") for part in ("normal", "tangential")
    )
    np.testing.assert_allclose(vector(ax, "acceleration A")[1], pin, atol=1e-10)
    np.testing.assert_allclose(normal, [pin, pin - l * wb**2 * along], atol=1e-10)
    np.testing.assert_allclose(tangential[1] - tangential[0], l * eb * across, atol=1e-10)
    np.testing.assert_allclose(tangential[1], vector(ax, "acceleration B")[1], atol=1e-10)
    assert abs(tangential[1][1]) < 1e-10
    # The crank's pin is driven at constant speed: nothing but its whole acceleration is drawn.
    assert not named(ax, "normal A")
    assert {"normal A", "tangential A"} <= gids(
        motion.polygon("acceleration", speed=w, acceleration=90.0)
    )


@pytest.mark.parametrize("name", assur.examples.ALL)
def test_plans_of_examples(name: str) -> None:
    """Images of links are similar to them; relative parts have the directions of their kind."""
    motion, speed, acceleration = _example(name)
    for what in ("velocity", "acceleration"):
        plan = plan_of(motion, what, speed, acceleration)
        greatest = max(np.hypot(*image) for image in plan.images.values())
        for joint in set(plan.images) & set(motion.mechanism.joints):
            of = motion.joint(joint)
            is_first = what == "velocity"
            exact = of.velocity(speed) if is_first else of.acceleration(speed, acceleration)
            np.testing.assert_array_equal(plan.images[joint], exact)
        for link, points in plan.links.items():
            turn = complex(motion.link(link).velocity(speed))
            factor = 1j * turn
            if what == "acceleration":
                factor = 1j * complex(motion.link(link).acceleration(speed, acceleration)) - turn**2
            for first, second in pairwise(p for p in points if p in motion.mechanism.joints):
                arm = complex(*(motion.joint(second).value - motion.joint(first).value))
                edge = complex(*(plan.images[second] - plan.images[first]))
                assert abs(edge - factor * arm) < 1e-8 * greatest
        for part in plan.vectors:
            # What is laid off first begins at the other point's image, what comes last ends at its
            # own.
            begins = part.part in ("absolute", "relative", "normal", "coriolis")
            if begins:
                image = plan.images[part.other] if part.other else np.zeros(2)
                np.testing.assert_allclose(part.start, image, atol=1e-9 * greatest)
            if part.part not in ("normal", "coriolis"):
                np.testing.assert_allclose(part.end, plan.images[part.point], atol=1e-9 * greatest)


@pytest.mark.parametrize(
    "name", ["shaper", "whitworth", "excavator", "oldham", "platform_on_cylinders"]
)
def test_slides_on_moving_guides(name: str) -> None:
    """Relative vectors have the size of the slide's own rates; Coriolis' is 2 ω v across."""
    motion, speed, acceleration = _example(name)
    m = motion.mechanism
    velocities, accelerations = (
        plan_of(motion, what, speed, acceleration).vectors for what in ("velocity", "acceleration")
    )
    moving = {n: s for n, s in m.slides.items() if s.on != "ground"}
    assert moving
    for slide_name, slide in moving.items():
        joints = m.links[slide.link]
        point = joints[0] if joints else slide.link
        under = f"{point} of {slide.on}"
        own = motion.slide(slide_name)
        angle = float(motion.link(slide.on).value) + m.dimensions.get(f"{slide_name}.angle", 0.0)
        guide = np.array([np.cos(angle), np.sin(angle)])
        (v,) = [v for v in velocities if v.other == under]
        np.testing.assert_allclose(v.end - v.start, own.velocity(speed) * guide, atol=1e-9)
        parts = {a.part: a for a in accelerations if a.other == under}
        sliding = parts["sliding"]
        np.testing.assert_allclose(
            sliding.end - sliding.start, own.acceleration(speed, acceleration) * guide, atol=1e-9
        )
        if "coriolis" in parts:
            across = np.array([-guide[1], guide[0]])
            size = 2.0 * motion.link(slide.on).velocity(speed) * own.velocity(speed)
            coriolis = parts["coriolis"].end - parts["coriolis"].start
            np.testing.assert_allclose(coriolis, size * across, atol=1e-9)


def test_a_shaper_names_what_slides() -> None:
    motion = _mechanism("shaper").solve(0.7)
    ax = motion.polygon("acceleration", speed=10.0)
    written = {text.get_gid(): text.get_text() for text in texts(ax)}
    assert "coriolis A relative to A of lever" in gids(ax)
    assert written["coriolis A relative to A of lever text"].startswith("$a^{k}_{A3A4}$")
    assert written["sliding A relative to A of lever text"].startswith("$a^{r}_{A3A4}$")
    assert "image a4" in written
    assert "a4 is the image of the point of lever at A" in [
        t.get_text() for t in named(ax, "heading")
    ]
    # The joints of the ground are at the pole.
    assert "image o" in written
    assert "image d" not in written


def test_names_of_images() -> None:
    links = {
        "ground": ["A1", "D"],
        "crank": ["A1", "o"],
        "coupler": ["o", "wrist"],
        "arm": ["D", "wrist"],
    }
    joints = {"A1": (0, 0), "o": (1, 0.4), "wrist": (3, 2), "D": (4, 0)}
    ax = assur.Mechanism(joints, links, driver="crank").solve(0.5).polygon("velocity")
    written = {text.get_text() for text in texts(ax)}
    # The pole is not called as a joint that moves.
    assert {"π", "o", "wrist"} <= written
    assert any(text.startswith("$v_{wrist/o}$") for text in written)


def test_heading_and_scale() -> None:
    motion = assur.FourBar(0.04, 0.12, 0.08, 0.1).solve(np.radians([10.0, 335.0]))
    ax = motion.polygon("velocity", at=1, speed=10.0)
    assert one(ax, "title").get_text() == "Plan of velocities"
    assert one(ax, "heading").get_text() == "q = 335°, ω = 10.0 rad/s"
    bar = named(ax, "scale")
    (text,) = [a.get_text() for a in bar if hasattr(a, "get_text")]
    (line,) = [a for a in bar if hasattr(a, "get_xdata")]
    size, unit = text.split()
    assert unit == "m/s"
    assert np.ptp(line.get_xdata()) == pytest.approx(float(size), rel=1e-12)


def test_axes_and_palette_are_used() -> None:
    _, ax = plt.subplots()
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0)
    assert motion.polygon("acceleration", ax=ax, dark=True) is ax
    colours = {line.get_color() for line in ax.lines}
    assert {DARK.driver, DARK.acceleration, DARK.second} <= colours


def test_texts_are_clear() -> None:
    """Over all examples at most 2 % of the texts touch a vector or another text."""
    bad, count = 0, 0
    for i, name in enumerate(assur.examples.ALL):
        motion, speed, _ = _example(name)
        for what in ("acceleration",) if i % 3 else ("acceleration", "velocity"):
            ax = motion.polygon(what, speed=speed)
            some, of = overlapping(ax, LINES)
            bad, count = bad + some, count + of
            plt.close("all")
    assert count > 500
    assert bad <= 0.02 * count, f"{bad} of {count}"


def test_plans_refused() -> None:
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.0, 1.0])
    with pytest.raises(assur.InputError, match="what is 'jerk'"):
        motion.polygon("jerk")
    with pytest.raises(assur.InputError, match="at"):
        motion.polygon("velocity", at=2)
    with pytest.raises(assur.InputError, match="speed = 0"):
        motion.polygon("velocity", at=1, speed=0.0)
    with pytest.raises(assur.InputError, match="cannot be assembled"):
        assur.FourBar(40, 120, 80, 300).solve([0.0, 3.0], on_error="nan").polygon("velocity", at=1)
    with pytest.raises(assur.InputError, match="order 1"):
        assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(0.0, order=1).polygon("acceleration")
