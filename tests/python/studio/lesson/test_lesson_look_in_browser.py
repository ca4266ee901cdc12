"""The lesson in every size, scheme and language."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from studio.lesson.lesson_page import LessonPage

SIZES = {"wide": (1440, 900), "between": (900, 800), "narrow": (390, 844)}


def overflowing(lesson: LessonPage, selector: str) -> list[str]:
    """Return the classes of elements whose contents are wider than they are."""
    found: list[str] = lesson.page.evaluate(
        """(selector) => [...document.querySelectorAll(selector)]
             .filter((one) => one.scrollWidth > one.clientWidth + 1)
             .map((one) => one.className)""",
        selector,
    )
    return found


def test_every_size_and_scheme(lesson: LessonPage) -> None:
    page = lesson.page
    for size, (width, height) in SIZES.items():
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(60)
        page.get_by_role("button", name="Stop").click()
        page.locator(".lesson-card dl div").first.wait_for()
        assert page.evaluate("document.documentElement.scrollWidth") == width
        targets = "button, select, .lesson-box, .lesson-switch, .lesson-target"
        heights = page.evaluate(
            """(targets) => [...document.querySelectorAll(targets)]
                 .map((one) => [one.getBoundingClientRect().height, one.getAttribute("class")])
                 .filter(([height]) => height > 0)""",
            targets,
        )
        least = 43.5 if size == "narrow" else 17.0
        assert [one for one in heights if one[0] < least] == [], size
        boxes = page.evaluate(
            """() => [...document.querySelectorAll(".lesson-names .name")].map((one) => {
                 const { left, right, top, bottom } = one.getBoundingClientRect();
                 return [left, right, top + 3, bottom - 3];
               })"""
        )
        assert len(boxes) == 4
        for i, (left, right, top, bottom) in enumerate(boxes):
            for left2, right2, top2, bottom2 in boxes[:i]:
                assert left >= right2 or right <= left2 or top >= bottom2 or bottom <= top2
        # Texts of the panel are within it.
        panel = ".lesson-section, .lesson-buttons, .lesson-warning, .lesson-card"
        assert overflowing(lesson, panel) == [], size
    colour = "getComputedStyle(document.querySelector('.assur')).getPropertyValue('--canvas')"
    page.emulate_media(color_scheme="dark")
    assert page.evaluate(colour) == "#0F1419"
    page.emulate_media(color_scheme="light")
    assert page.evaluate(colour) == "#FBFCFD"


@pytest.mark.parametrize("language", ["de", "ru", "uk"])
def test_other_languages(lesson_page: LessonPage, language: str) -> None:
    """All is said in the language, and finds its room."""
    page = lesson_page.page
    page.set_viewport_size({"width": 1440, "height": 900})
    lesson_page.renew(language=language)
    page.evaluate("lesson.seek(0); lesson.stop()")
    page.locator(".lesson-card dl div").first.wait_for()
    assert page.locator(".lesson-run").inner_text() not in ("", "Run")
    panel = (
        ".lesson-section, .lesson-buttons, .lesson-buttons .button, .lesson-warning, .lesson-card"
    )
    assert overflowing(lesson_page, panel) == []
