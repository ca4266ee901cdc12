"""Values of the lesson that are wrong, refused, late or lost: the picture keeps the good ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from studio.lesson.lesson_page import LessonPage


BAD_VALUES = (
    ("l4, ground", "abc", "“abc” is not a number. The picture keeps 4.995."),
    ("l2, coupler", "", "A number is needed. The picture keeps 4.500."),
    ("l3, rocker", "-1.5", "A length must be above 0. The picture keeps 1.500."),
    ("l1, crank", "NaN", "“NaN” is not a number. The picture keeps 1.000."),
    ("l1, crank", "1/0", "“1/0” divides by zero. The picture keeps 1.000."),
    ("φ1 at start", "12 m", "“m” does not fit here: rad, °, turn do. The picture keeps −60.0°."),
    ("speed ω", "0", "At ω = 0 the crank stands still: give a speed that is not 0."),
    ("γmin", "2", "γmin must be above 0 and below π/2 = 1.571 rad (90°)."),
)


def test_bad_values_keep_the_picture(lesson: LessonPage) -> None:
    page = lesson.page
    before = lesson.figures
    for name, text, said in BAD_VALUES:
        field = lesson.control("textbox", name)
        good = field.input_value()
        field.fill(text)
        field.press("Enter")
        assert page.get_by_role("button", name="Apply").is_disabled()
        assert field.get_attribute("aria-invalid") == "true"
        described = field.get_attribute("aria-describedby")
        assert page.locator(f"#{described}").text_content() == said
        assert lesson.figures == before
        field.fill(good)
        assert field.get_attribute("aria-invalid") == "false"
    # It runs on with the last good values while something is wrong.
    lesson.control("textbox", "l1, crank").fill("?")
    page.get_by_role("button", name="Run").click()
    lesson.wind(0.2)
    lesson.compare()


def test_what_the_server_refuses_is_said_at_its_place(lesson: LessonPage) -> None:
    page = lesson.page
    page.get_by_role("button", name="from friction").click()
    before = lesson.design
    lesson.control("textbox", "Coefficient of friction at C").fill("3")
    page.get_by_role("button", name="Apply").click()
    said = page.locator(".lesson-fields .lesson-error >> visible=true")
    said.wait_for()
    assert "With this friction the rocker moves at no angle" in (said.text_content() or "")
    assert lesson.design == before
    lesson.compare()


@pytest.mark.parametrize("is_applied", [False, True])
def test_a_late_answer_takes_nothing_back(lesson: LessonPage, is_applied: bool) -> None:
    """What is typed while an answer is on its way stays, and what was asked later is shown."""
    page = lesson.page
    page.evaluate("() => { window.held = new Promise((end) => (window.release = end)); }")
    lesson.control("combobox", "Unit of the lengths").select_option("metres")
    lesson.control("textbox", "l4, ground").fill("0.999")
    if is_applied:
        page.get_by_role("button", name="Apply").click()
        lesson.until("Math.abs(lesson.design.l4 - 0.999) < 1e-9 && !lesson.fields.isDirty")
    page.evaluate("async () => { window.release(); await new Promise((end) => setTimeout(end)); }")
    assert lesson.control("textbox", "l4, ground").input_value() == "0.999"
    page.get_by_role("button", name="Apply").click(force=is_applied)
    lesson.until("Math.abs(lesson.design.l4 - 0.999) < 1e-9 && !lesson.fields.isDirty")
    lesson.compare()


def test_without_a_connection_it_plays_on(lesson: LessonPage) -> None:
    page = lesson.page
    page.get_by_role("button", name="Run").click()
    page.evaluate("window.isLost = true")
    lesson.wind(0.3)
    lesson.control("textbox", "l4, ground").fill("4.8")
    page.get_by_role("button", name="Apply").click()
    said = page.locator(".lesson-fields .lesson-error >> visible=true")
    said.wait_for()
    assert said.text_content() == "The connection is lost. It plays on; changes wait."
    before = lesson.phi1
    lesson.wind(0.3)
    assert lesson.phi1 > before
    # What was typed is still there, and goes when the connection is back.
    page.evaluate("window.isLost = false")
    page.get_by_role("button", name="Apply").click()
    lesson.until("!lesson.fields.isDirty")
    assert lesson.design["l4"] == 4.8
    lesson.compare()
    # Lost from the beginning: it says so, and Run tries again.
    page.evaluate("window.isLost = true")
    lesson.renew()
    assert said.text_content() == "The connection is lost. It plays on; changes wait."
    page.evaluate("window.isLost = false")
    page.get_by_role("button", name="Run").click()
    lesson.until("!!lesson.parts")
    assert not said.count()
    lesson.compare()
