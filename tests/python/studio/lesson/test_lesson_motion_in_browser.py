"""The lesson in motion: its structure changes and back, by its own clock and the browser's."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from studio.lesson.lesson_page import LENGTHS

if TYPE_CHECKING:
    from studio.lesson.lesson_page import LessonPage


def test_it_becomes_a_slider_crank_and_a_crank_rocker_again(lesson: LessonPage) -> None:
    page = lesson.page
    run = assur.crank_rocker.run(1.0, 4.5, 1.5, 4.995, 0.2, speed=2.0, phi0=-np.pi / 3.0)
    jam, back = run.events
    page.get_by_role("button", name="Run").click()
    lesson.wind(jam.t - 0.01)
    assert lesson.side() is None
    assert not page.locator(".lesson-slides").count()
    lesson.wind(0.02)
    assert lesson.side() == "outer"
    lesson.compare()
    warning = page.locator(".lesson-warning")
    assert "Slider-crank: γ fell to γ" in warning.inner_text()
    angles = [float(one) for one in re.findall(r"= (\d+\.\d)°", warning.inner_text())]
    assert angles == pytest.approx(np.degrees([jam.phi1, back.phi1]) % 360.0, abs=0.06)
    assert f"{4.97753284:.3f}" in warning.inner_text()
    # C ×, the rod banded, D a slide with its loupe: it moves by less than 6 px.
    for part in (
        ".lesson-lock-cross",
        ".lesson-band-line",
        "[data-link=support]",
        ".lesson-loupe-rim",
    ):
        assert page.locator(f"{part} >> visible=true").count() == 1, part
    assert not page.locator("[data-link=pivot] >> visible=true").count()
    # At 360° it is farthest in.
    lesson.page.evaluate("lesson.seek(2 * Math.PI)")
    lesson.compare()
    least = float(run.l4.min())
    text = page.locator(".lesson-loupe-text").text_content() or ""
    assert float(text.split()[0]) == pytest.approx(4.995 - least, abs=6e-5)
    mark = (page.locator(".lesson-mark-text").text_content() or "").replace("−", "-")
    assert float(mark) == pytest.approx(least - 4.995, abs=6e-5)
    page.get_by_role("button", name="Stop").click()
    page.locator(".lesson-card dl div").first.wait_for()
    rows = page.locator(".lesson-card dl div").all_inner_texts()
    assert any(row.startswith("BD") and "5.9775" in row for row in rows)
    page.get_by_role("button", name="Run").click()
    lesson.wind(back.phi1 / 2.0 + 0.01)
    assert lesson.side() is None
    assert not page.locator(".lesson-slides").count()
    lesson.compare()


@pytest.mark.parametrize(
    ("values", "failed"),
    [
        ({"l4, ground": "5.2"}, ["l1 + l4 (6.200) must be less than l2 + l3 (6.000)."]),
        ({"l4, ground": "3.9"}, ["l1 + l2 (5.500) must be less than l3 + l4 (5.400)."]),
        (
            {"l2, coupler": "1.5", "l3, rocker": "4", "l4, ground": "3.2"},
            ["l1 + l3 (5.000) must be less than l2 + l4 (4.700)."],
        ),
    ],
)
def test_the_warning_says_which_condition_fails(
    lesson: LessonPage, values: dict[str, str], failed: list[str]
) -> None:
    page = lesson.page
    for name, text in values.items():
        lesson.control("textbox", name).fill(text)
    page.get_by_role("button", name="Apply").click()
    lesson.until("!lesson.fields.isDirty")
    design = lesson.design
    assert not assur.crank_rocker.crank_turns(*(design[name] for name in LENGTHS))[0]
    said = page.locator(".lesson-warning").inner_text().replace("\n", "")
    for sentence in failed:
        assert sentence in said.replace("\xa0", " ")
    # With the support giving way it goes around all the same.
    lesson.compare()
    start = lesson.phi1
    page.get_by_role("button", name="Run").click()
    for _ in range(8):
        lesson.wind(0.4)
        lesson.compare()
    assert lesson.phi1 > start + 360.0


def test_the_support_is_dragged_beyond_and_back_while_it_runs(lesson: LessonPage) -> None:
    """The structure changes under the pointer, and back; the diagrams keep what was run."""
    page = lesson.page
    lesson.apply("l4, ground", "4.9")
    assert not page.locator(".lesson-warning").is_visible()
    page.get_by_role("button", name="Run").click()
    lesson.wind(0.45)
    pill = lesson.control("slider", "Support D, l4")
    scale = page.evaluate("lesson.figure.view.scale")
    lesson.drag(pill, -0.15 * scale, 0.0, 6, 0.01)
    assert lesson.design["l4"] == pytest.approx(5.05)
    assert lesson.side() == "outer"
    lesson.compare()
    assert page.locator(".lesson-warning").is_visible()
    page.mouse.up()
    lesson.drag(pill, 0.25 * scale, 0.0, 6, 0.01)
    page.mouse.up()
    assert lesson.side() is None
    lesson.compare()
    assert not page.locator(".lesson-warning").is_visible()
    trace = page.evaluate("[...lesson.diagrams.all.l4.trace].filter(Number.isFinite)")
    assert max(trace) - min(trace) > 0.05
    # Escape: as if the gesture had not begun.
    before = lesson.design["l4"]
    lesson.drag(pill, -30.0, 0.0, 3, 0.01)
    assert lesson.design["l4"] != before
    page.keyboard.press("Escape")
    page.mouse.up()
    lesson.settle()
    assert lesson.design["l4"] == pytest.approx(before)


def test_where_the_support_is_held_it_stops_and_can_turn_back(lesson: LessonPage) -> None:
    page = lesson.page
    lesson.control("switch", "Support gives way below γmin").click()
    page.keyboard.press("Tab")
    page.get_by_role("button", name="Run").click()
    lesson.wind(2.0)
    low, _ = np.degrees(assur.crank_rocker.blocked(1.0, 4.5, 1.5, 4.995, 0.2)[0])
    assert lesson.phi1 % 360.0 == pytest.approx(low % 360.0)
    assert not page.evaluate("lesson.isRunning")
    # Nothing of a slider-crank is drawn.
    assert not page.locator(".lesson-slides").count()
    assert page.locator(".lesson-lock-cross >> visible=true").count() == 1
    page.locator(".lesson-picture").focus()
    page.keyboard.press("ArrowRight")
    assert lesson.phi1 % 360.0 == pytest.approx(low % 360.0)
    page.keyboard.press("ArrowLeft")
    assert lesson.phi1 % 360.0 == pytest.approx(low % 360.0 - 1.0)
    lesson.compare()
    # Backwards it comes to the other end.
    page.evaluate("lesson.seek(30 * Math.PI / 180)")
    assert lesson.phi1 % 360.0 == pytest.approx(low % 360.0)
    # Put where it is jammed, it shows the crank-rocker there: the support is held.
    lesson.apply("φ1 at start", "0")
    held = lesson.figures
    exact = assur.crank_rocker.solve(0.0, 1.0, 4.5, 1.5, 4.995)
    assert held["gamma"] == pytest.approx(float(exact.gamma))
    assert held["l4"] == pytest.approx(4.995)


def test_the_real_clock(lesson: LessonPage) -> None:
    """By the browser's own frames: 2 rad a second; closed it does nothing more."""
    lesson.renew(is_wound=False)
    page = lesson.page
    page.keyboard.press(" ")
    start = page.evaluate("[performance.now(), lesson.phi1]")
    page.wait_for_timeout(700)
    now = page.evaluate("[performance.now(), lesson.phi1]")
    rate = (now[1] - start[1]) / (now[0] - start[0]) * 1e3
    assert 1.0 < rate < 2.1
    page.keyboard.press(" ")
    assert not page.evaluate("lesson.isRunning")
    page.evaluate("window.last = lesson; lesson.start(); lesson.close()")
    assert page.locator(".lesson").inner_html() == ""
    at = page.evaluate("last.phi1")
    page.keyboard.press(" ")
    page.keyboard.press("ArrowRight")
    page.wait_for_timeout(60)
    assert page.evaluate("last.phi1") == at
    assert not page.evaluate("last.isRunning")
