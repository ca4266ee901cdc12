"""Where a driver stops, as the page says it: joint, kind and place, in the unit of the driver."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur.studio.document import document_of
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser


@pytest.fixture(scope="module")
def opened(browser: Browser) -> Iterator[Window]:
    with window(browser, example="crank_rocker") as one:
        one.settle()
        yield one


def caution(one: Window) -> str:
    return one.page.locator(".caution").inner_text()


def test_a_crank_that_is_too_long(opened: Window) -> None:
    opened.example("crank_rocker")
    field = opened.page.locator('[data-dimension="crank.length"] input')
    field.fill("120")
    field.press("Enter")
    opened.settle()
    text = caution(opened)
    assert "18.2°: coupler and rocker lie over each other at C" in text
    assert "130.5°: coupler and rocker are in line at C" in text


def test_a_piston_that_drives_stops_at_a_length(opened: Window) -> None:
    opened.example("engine")
    opened.seek(1.0)
    opened.page.keyboard.press("d")
    slides = opened.mechanism.slides
    name, slide = next(iter(slides.items()))
    x, y = opened.joint_px(opened.mechanism.links[slide.link][0])
    # On the block, beside its joint.
    opened.page.mouse.click(x + 11.0, y)
    opened.wait_until(f"window.assurStudio.model.document.driver === {name!r}")
    opened.settle()
    opened.page.keyboard.press("v")
    # The way to the other side is not within its reach.
    dead = [point.q for point in opened.mechanism.limits().dead_points if point.q > 0.0]
    text = caution(opened)
    assert "°" not in text
    places = [float(own) for own in re.findall(r"(\d+(?:\.\d+)?) mm", text)]
    assert sorted(places) == pytest.approx(sorted(1e3 * q for q in dead), abs=0.51)
    # The buttons in it go there.
    buttons = opened.page.locator(".caution").get_by_role("button")
    buttons.first.click()
    assert min(abs(opened.q - q) for q in dead) < 1e-6


def test_a_cylinder_stops_at_a_length(opened: Window) -> None:
    boom = {
        "driver": "boom",
        "joints": {"A": [0, 0], "B": [0.3, 0], "C": [0.6, 0.4]},
        "links": {"ground": ["A", "B"], "boom": ["A", "C"]},
        "slides": {"lift": {"base": "B", "end": "C"}},
    }
    opened.open(boom)
    opened.seek(0.3)
    opened.open({**boom, "driver": "lift"})
    # The way to the other side is not within its reach.
    dead = [point.q for point in opened.mechanism.limits().dead_points if point.q > 0.0]
    text = caution(opened)
    assert text.startswith("lift stops at ")
    assert "boom, lift_barrel and lift_rod lie over each other at C" in text
    places = [float(own) for own in re.findall(r"(\d+(?:\.\d+)?) m", text)]
    unit = 1.0 if " mm" not in text else 1e3
    assert sorted(places) == pytest.approx(sorted(unit * q for q in dead), rel=1e-2)


def test_what_does_not_close_says_where_in_the_unit_of_its_driver(opened: Window) -> None:
    opened.example("engine")
    own = opened.document
    # Without what the example keeps beside its drawing, and far off the guide's line.
    dimensions = {**own["dimensions"], "bore.offset": 1.0}
    opened.open({**own, "driver": "bore", "assembly": {"A": 1}, "dimensions": dimensions})
    opened.wait_until("window.assurStudio.model.problem !== null")
    told = opened.page.locator(".warning").inner_text()
    assert told.startswith("It does not close at ")
    assert "°" not in told


def test_reaches_of_assemblies_while_a_run_is_shown(opened: Window) -> None:
    """A run goes along time; the reach of an assembly stays one of the driver."""
    long = assur.examples.crank_rocker().with_dimensions({"crank.length": 0.12})
    opened.open(document_of(long))
    low, high = np.degrees(long.limits().intervals[0])
    cards = opened.page.locator("button.assembly")
    before = cards.first.inner_text()
    found = [float(own.replace("−", "-")) for own in re.findall(r"([−\d]+)°", before)]
    assert found == pytest.approx([low, high], abs=0.51)
    opened.page.evaluate(
        """async () => {
             const { model } = window.assurStudio;
             model.shownRun.show(await model.ask("run", { by: "speed", speed: 0.1, t_end: 0.5 }));
           }"""
    )
    opened.settle()
    opened.page.wait_for_timeout(400)
    after = cards.first.inner_text()
    opened.page.evaluate("window.assurStudio.model.shownRun.end()")
    assert "°" in after
    assert "m" not in after
