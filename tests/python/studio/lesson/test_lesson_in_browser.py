"""The program of Manzhosov and Petrova in a real browser, by the table of its controls."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
import tomllib

from studio.lesson.lesson_acts import do, is_hidden
from studio.lesson.lesson_effects import check

if TYPE_CHECKING:
    from studio.lesson.lesson_page import LessonPage

TABLE = Path(__file__).with_name("lesson_controls.toml")
CONTROLS: list[dict[str, Any]] = tomllib.loads(TABLE.read_text(encoding="utf-8"))["control"]
SCREEN = "button, input, select, [role=slider]"


def title(control: dict[str, Any]) -> str:
    return f"{control['name']}: {control['does']}"


def test_the_table_is_the_screen(lesson: LessonPage) -> None:
    """What can be used on the screen is in the table, and the other way around."""
    page = lesson.page
    page.get_by_role("button", name="from friction").click()
    page.get_by_role("button", name="Stop").click()
    page.locator(".lesson-card dl div").first.wait_for()
    found = set(
        page.evaluate(
            """(selector) => [...document.querySelectorAll(selector)].map((one) => {
                 const name = one.getAttribute("aria-label") ?? one.textContent;
                 const roles = { INPUT: "textbox", SELECT: "combobox" };
                 const role = one.getAttribute("role") ?? roles[one.tagName];
                 return `${role ?? "button"} ${name}`;
               })""",
            SCREEN,
        )
    )
    # The same button says another thing by now.
    found.remove("button give γmin itself")
    found.add("button from friction and pin radii …")
    diagrams = page.locator(".lesson-diagram h3").all_text_contents()
    found |= {f"diagram {name}" for name in diagrams}
    apart = ("key", "picture")
    listed = {f"{one['role']} {one['name']}" for one in CONTROLS if one["role"] not in apart}
    assert found == listed


@pytest.mark.parametrize("control", CONTROLS, ids=title)
def test_control(lesson: LessonPage, control: dict[str, Any]) -> None:
    act, effect = control["act"], control["effect"]
    page = lesson.page
    if is_hidden(control):
        page.get_by_role("button", name=control["hidden"]).click()
        if control["hidden"] == "Stop":
            page.locator(".lesson-card dl div").first.wait_for()
    at = None if control["role"] == "key" else lesson.control(control["role"], control["name"])
    before = {
        "phi1": lesson.phi1,
        "scale": page.evaluate("lesson.figure.view.scale"),
        "l4": lesson.design["l4"],
        "view": page.evaluate("[lesson.figure.view.x, lesson.figure.view.y]"),
        "paths": page.locator(".lesson-paths .path").count(),
    }
    if "off" in effect:
        assert page.locator(f"{effect['off']} >> visible=true").count() > 0
    if "on" in effect:
        assert page.locator(f"{effect['on']} >> visible=true").count() == 0
    do(lesson, control, at, act)
    check(lesson, at, effect, before)
    # Whatever was done, the figures are the package's.
    lesson.compare()
