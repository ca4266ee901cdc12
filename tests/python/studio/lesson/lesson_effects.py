"""What an act at a control of the lesson has done, as the table of its controls says."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from studio.lesson.lesson_page import DEGREE, LENGTHS

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from studio.lesson.lesson_page import LessonPage


def check(
    lesson: LessonPage, at: Locator | None, effect: dict[str, Any], before: dict[str, Any]
) -> None:
    """Check every effect that the table states."""
    page = lesson.page
    for key, value in effect.items():
        EFFECTS[key](lesson, at, effect, before, value)
    if "running" not in effect:
        assert not page.evaluate("lesson.isRunning")


def check_design(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    angles = ("start", "least")
    wanted = {name: n * DEGREE if name in angles else n for name, n in value.items()}
    lesson.until("!lesson.fields.isDirty")
    # What is applied is shown when the server has answered.
    near = (f"Math.abs(lesson.design.{name} - {n!r}) < 1e-9" for name, n in wanted.items())
    lesson.until(" && ".join(near) or "true")
    design = lesson.design
    for name, number in wanted.items():
        assert design[name] == pytest.approx(number), name
    # The bar says where the crank turns, with friction and without.
    l1, l2, l3 = (design[name] for name in LENGTHS[:3])
    ends = [
        [
            end * l1
            for end in assur.crank_rocker.ground_range(
                l2 / l1, l3 / l1, margin=0.0, gamma_min=angle
            )
        ]
        for angle in (0.0, design["least"])
    ]
    label = lesson.page.locator(".lesson-bar").get_attribute("aria-label") or ""
    said = [float(one) for one in re.findall(r"\d+\.\d+", label)]
    assert said == pytest.approx([design["l4"], *ends[0], *ends[1]], abs=1e-3)


def check_jams(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    design = lesson.design
    l1, l2, l3, l4 = (float(design[name]) for name in LENGTHS)
    blocked = assur.crank_rocker.blocked(l1, l2, l3, l4, design["least"])
    assert bool(blocked) == value
    warning = lesson.page.locator(".lesson-warning")
    assert warning.is_visible() == value
    strokes = lesson.page.locator(".lesson-blocked-stroke").count()
    hatched = lesson.page.locator(".lesson-hatched").count()
    assert (strokes > 0, hatched > 0) == (value, value)
    if value and "γ falls" in warning.inner_text():
        low, high = np.degrees(blocked[0]) % 360.0
        ends = (low, high) if design["speed"] > 0.0 else (high, low)
        angles = [float(one) for one in re.findall(r"= (\d+(?:\.\d+)?)°", warning.inner_text())]
        assert angles == pytest.approx(ends, abs=0.06)


def check_friction(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    design = lesson.design
    friction = design["friction"]
    for name, number in value.items():
        assert friction[name] == pytest.approx(number)
    f_c, r_c, f_d, r_d = (friction[name] for name in ("f_c", "r_c", "f_d", "r_d"))
    least = assur.crank_rocker.least_transmission_angle(f_c, r_c, f_d, r_d, design["l3"])
    assert design["least"] == pytest.approx(least)
    shown = lesson.control("textbox", "γmin").input_value()
    assert float(shown) == pytest.approx(least, abs=1e-5)


def check_visible(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    assert lesson.control("textbox", value).is_visible()
    lesson.page.get_by_role("button", name="give γmin itself").click()
    assert not lesson.control("textbox", value).is_visible()


def check_fitted(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, _value: Any) -> None:
    lesson.until("!lesson.fields.isDirty")
    places = lesson.page.evaluate(
        """() => {
             const { view } = lesson.figure;
             const [x0, y0, x1, y1] = lesson.motion.bounds;
             return [view.px(x0, y1), view.px(x1, y0), [view.width, view.height]];
           }"""
    )
    (left, top), (right, bottom), (width, height) = places
    assert left >= 30.0
    assert top >= 90.0
    assert right <= width - 30.0
    assert bottom <= height - 45.0
    # As large as it can be: one side fits.
    assert min(left - 0.16 * width - 1.0, top - 150.0, height - 50.0 - bottom) < 1.0


def check_running(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    assert lesson.page.evaluate("lesson.isRunning") == value
    assert lesson.page.get_by_role("button", name="Run").is_disabled() == value


def check_turned(lesson: LessonPage, _at: Any, _effect: Any, before: Any, value: Any) -> None:
    assert lesson.phi1 - before["phi1"] == pytest.approx(value, abs=1e-6)
    if lesson.page.evaluate("lesson.isRunning"):
        # Drawn as it ran: a value for each half degree.
        traced = lesson.page.evaluate("lesson.diagrams.all.gamma.traced")
        assert traced == pytest.approx(2.0 * value, abs=2.0)


def check_card(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, _value: Any) -> None:
    page = lesson.page
    page.locator(".lesson-card dl div").first.wait_for()
    design, phi1 = lesson.design, lesson.phi1 * DEGREE
    l1, l2, l3, l4 = (float(design[name]) for name in LENGTHS)
    exact = assur.crank_rocker.solve(phi1, l1, l2, l3, l4, speed=design["speed"])
    rows = page.locator(".lesson-card dl div").all_inner_texts()
    figures = {
        re.sub(r"\s", "", row.split("\n")[0]): row.replace("−", "-").split("\n")[-1] for row in rows
    }
    assert page.locator(".lesson-card-angle").inner_text() == f"{lesson.phi1 % 360.0:.3g}°"
    assert float(figures["γ"].split()[0]) == pytest.approx(float(exact.gamma), abs=1e-4)
    assert float(figures["φ3"].rstrip("°")) == pytest.approx(np.degrees(exact.phi3), abs=0.006)
    assert float(figures["ω3"].split()[0]) == pytest.approx(float(exact.dphi3), rel=6e-3)
    assert float(figures["vC,aC"].split()[0]) == pytest.approx(float(exact.v_C), rel=6e-3)


def check_gone(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    assert not lesson.page.locator(value).is_visible()


def check_off(lesson: LessonPage, at: Any, _effect: Any, _before: Any, value: Any) -> None:
    assert lesson.page.locator(f"{value} >> visible=true").count() == 0
    at.click()
    assert lesson.page.locator(f"{value} >> visible=true").count() > 0


def check_on(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    assert lesson.page.locator(f"{value} >> visible=true").count() == 2


def check_values(lesson: LessonPage, at: Any, _effect: Any, _before: Any, value: Any) -> None:
    """The values beside the arrows are those of B and C."""
    figures = lesson.figures
    rates = figures["speeds" if value == "v" else "accelerations"]
    wanted = sorted(float(np.hypot(*rates[name])) for name in "BC")
    texts = lesson.page.locator(".lesson-names .label >> visible=true").all_text_contents()
    shown = sorted(float(text.split()[1]) for text in texts if text.startswith(f"{value} "))
    assert shown == pytest.approx(wanted, rel=6e-3)
    assert at.is_checked()


def check_paths(lesson: LessonPage, at: Any, _effect: Any, _before: Any, value: Any) -> None:
    # Each with its marker.
    assert lesson.page.locator(".lesson-markers .marker").count() == value
    assert at.get_attribute("aria-pressed") == str(value == 3).lower()


def check_phi1(lesson: LessonPage, _at: Any, effect: Any, _before: Any, value: Any) -> None:
    assert lesson.phi1 % 360.0 == pytest.approx(value, abs=effect.get("within", 1e-6))


def check_warning(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    assert lesson.page.locator(".lesson-warning h3").inner_text().split("\n")[-1] == value


def check_pulled(lesson: LessonPage, _at: Any, _effect: Any, before: Any, value: Any) -> None:
    wanted = before["l4"] - value / before["scale"]
    assert lesson.design["l4"] == pytest.approx(wanted, abs=1e-9)


def check_field(lesson: LessonPage, _at: Any, _effect: Any, _before: Any, value: Any) -> None:
    shown = lesson.control("textbox", value).input_value()
    assert float(shown) == pytest.approx(lesson.design["l4"], abs=6e-5)
    assert lesson.page.get_by_role("button", name="Apply").is_disabled()
    moved = lesson.page.evaluate("lesson.motion.lengths.l4")
    assert moved == lesson.design["l4"]


def check_px(lesson: LessonPage, _at: Any, _effect: Any, before: Any, value: Any) -> None:
    found = lesson.figures
    # Inward, so l4 falls; `compare` sees that this speed is in the velocities.
    assert found["groundSpeed"] == pytest.approx(-value / before["scale"], rel=1e-6)
    assert found["speeds"]["D"][0] == pytest.approx(value / before["scale"], rel=1e-6)
    lesson.compare()
    lesson.page.mouse.up()
    # After 50 ms it stands.
    lesson.wind(0.06)
    assert lesson.figures["groundSpeed"] == 0.0


def check_steps(lesson: LessonPage, _at: Any, _effect: Any, before: Any, value: Any) -> None:
    step = lesson.page.evaluate("lesson.figure.support.step")
    assert 0.4 < step * before["scale"] <= 1.0
    lesson.settle()
    assert lesson.design["l4"] == pytest.approx(before["l4"] + value * step)


def check_panned(lesson: LessonPage, _at: Any, _effect: Any, before: Any, value: Any) -> None:
    dx, dy = value
    view = lesson.page.evaluate("[lesson.figure.view.x, lesson.figure.view.y]")
    assert view == pytest.approx([before["view"][0] + dx, before["view"][1] + dy])
    # Wheel: about the pointer.
    lesson.page.mouse.wheel(0, -200)
    lesson.until(f"lesson.figure.view.scale > 1.2 * {before['scale']}")
    lesson.page.keyboard.press("0")
    assert lesson.page.evaluate("lesson.figure.view.scale") == pytest.approx(before["scale"])


def check_within(*_: Any) -> None:
    """Belongs to `phi1`."""


EFFECTS: dict[str, Any] = {
    "design": check_design, "jams": check_jams, "friction": check_friction,
    "visible": check_visible, "fitted": check_fitted, "running": check_running,
    "turned": check_turned, "card": check_card, "gone": check_gone, "off": check_off,
    "on": check_on, "values": check_values, "paths": check_paths, "phi1": check_phi1,
    "warning": check_warning, "pulled": check_pulled, "field": check_field,
    "px_per_second": check_px, "steps": check_steps, "within": check_within,
    "panned": check_panned,
}  # fmt: skip
