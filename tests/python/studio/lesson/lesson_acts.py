"""What is done to a control of the lesson, as the table of its controls says."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from studio.lesson.lesson_page import DEGREE

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from studio.lesson.lesson_page import LessonPage


def is_hidden(control: dict[str, Any]) -> bool:
    return "hidden" in control


def do(
    lesson: LessonPage, control: dict[str, Any], at: Locator | None, act: dict[str, Any]
) -> None:
    """Act as the table says."""
    page = lesson.page
    if "choose" in act and at is not None:
        at.select_option(act["choose"])
        lesson.until("lesson.fields.fields.l1.unit.textContent === 'm'")
    if "type" in act:
        type_in(lesson, control, act["type"])
    if act.get("then") == "apply" or control["name"] == "Fit":
        page.get_by_role("button", name="Apply").click()
        lesson.until("!lesson.fields.isDirty")
    if control["name"] == "Fit":
        page.evaluate("lesson.figure.zoom(300, 200, 2.5)")
    # A switch first, then the run; to stop a run, the other way around.
    if control["role"] == "switch":
        click(at, act)
    run_for(lesson, act)
    if control["role"] != "switch":
        click(at, act)
    move(lesson, at, act)
    if "seconds" in act:
        lesson.wind(act["seconds"])


def type_in(lesson: LessonPage, control: dict[str, Any], what: Any) -> None:
    typed = what if isinstance(what, dict) else {control["name"]: what}
    apply = lesson.page.get_by_role("button", name="Apply")
    for name, text in typed.items():
        # Off until something differs.
        assert apply.is_disabled() or len(typed) > 1 or is_hidden(control)
        lesson.control("textbox", name).fill(text)
    assert apply.is_enabled()


def run_for(lesson: LessonPage, act: dict[str, Any]) -> None:
    if "run" in act:
        lesson.page.get_by_role("button", name="Run").click()
        lesson.wind(act["run"])


def click(at: Locator | None, act: dict[str, Any]) -> None:
    if act.get("click") and at is not None:
        at.click()


def move(lesson: LessonPage, at: Locator | None, act: dict[str, Any]) -> None:
    """Drag, press a key, or point at a place."""
    if "key" in act:
        if at is not None:
            at.focus()
        lesson.page.keyboard.press(act["key"])
    if at is None:
        return
    if "drag" in act:
        dx, dy = act["drag"]
        lesson.drag(at, dx, dy, act.get("steps", 4), act.get("step_seconds", 0.0))
    box = at.bounding_box() if {"point", "part", "turn"} & set(act) else None
    if box is not None and "point" in act:
        # On the ring of the dial, 52 of 156 from its middle.
        radius = box["width"] * 52.0 / 156.0
        angle = act["point"] * DEGREE
        x = box["x"] + box["width"] / 2.0 + radius * np.cos(angle)
        lesson.page.mouse.click(x, box["y"] + box["height"] / 2.0 - radius * np.sin(angle))
    if box is not None and "turn" in act:
        turn_by_hand(lesson, act["turn"] * DEGREE)
    if box is not None and "part" in act:
        # The axis begins and ends a little within.
        left, right = box["x"] + 44.0, box["x"] + box["width"] - 16.0
        lesson.page.mouse.click(left + act["part"] * (right - left), box["y"] + 60.0)


def turn_by_hand(lesson: LessonPage, angle: float) -> None:
    """Drag the middle of the crank to another angle, and the canvas beside it."""
    page = lesson.page
    places = page.evaluate(
        """(angle) => {
             const { left, top } = lesson.figure.element.getBoundingClientRect();
             const at = (radius, phi) => {
               const [x, y] = lesson.figure.view.px(radius * Math.cos(phi), radius * Math.sin(phi));
               return [left + x, top + y];
             };
             return [at(0.5, lesson.phi1), at(0.8, angle)];
           }""",
        angle,
    )
    page.mouse.move(*places[0])
    page.mouse.down()
    page.mouse.move(*places[1], steps=5)
    page.mouse.up()
