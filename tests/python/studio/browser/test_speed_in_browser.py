"""The speed of the driver: typed in any unit, kept with the document, saved and opened again."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING

import pytest

import assur
from assur.studio import document
from studio.asking import FOUR_BAR, PRESS
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, Locator, Page


@pytest.fixture(scope="module")
def opened(browser: Browser) -> Iterator[Window]:
    with window(browser, example="crank_rocker") as one:
        one.settle()
        yield one


def field(page: Page) -> Locator:
    return page.get_by_role("textbox", name="Speed of the driver")


def speed(one: Window, page: Page | None = None) -> float:
    return float((page or one.page).evaluate("window.assurStudio.playback.player.speed"))


def write(one: Window, text: str) -> None:
    field(one.page).fill(text)
    field(one.page).press("Enter")
    one.settle()


def error(one: Window) -> str:
    own = one.page.locator(".drive .field-error")
    return own.inner_text() if own.is_visible() else ""


def is_red(one: Window) -> bool:
    return field(one.page).get_attribute("aria-invalid") == "true"


@pytest.mark.parametrize(
    ("text", "value", "shown"),
    [
        ("30 rpm", math.pi, "3.142"),
        ("60 1/min", math.tau, "6.283"),
        ("60/min", math.tau, "6.283"),
        ("2 rad/s", 2.0, "2"),
        ("90°/s", math.pi / 2.0, "1.571"),
        ("2 Hz", 2.0 * math.tau, "12.57"),
        ("−3,5", -3.5, "−3.5"),
        ("pi", math.pi, "3.142"),
    ],
)
def test_units(opened: Window, text: str, value: float, shown: str) -> None:
    opened.example("crank_rocker")
    write(opened, text)
    assert speed(opened) == pytest.approx(value, rel=1e-15)
    assert opened.document["input_speed"] == speed(opened)
    assert field(opened.page).input_value() == shown
    assert not is_red(opened)
    assert error(opened) == ""
    # Leaving the field takes what is written in it for no other speed.
    before = speed(opened)
    field(opened.page).focus()
    field(opened.page).blur()
    opened.settle()
    assert speed(opened) == before


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("30 foo", "“foo” does not fit here: rad/s, rpm, 1/min, °/s, rev/s do."),
        ("30 m/s", "“m/s” does not fit here"),
        ("fast", "“fast” is not a speed."),
        ("", "A number is needed."),
        ("1e12", "“1e12” is too large."),
    ],
)
def test_a_bad_speed_says_why_and_the_old_one_stays(opened: Window, text: str, said: str) -> None:
    opened.example("crank_rocker")
    write(opened, "2")
    write(opened, text)
    assert error(opened).startswith(said)
    assert error(opened).endswith("It stays 2 rad/s.")
    assert is_red(opened)
    assert speed(opened) == 2.0
    assert opened.document["input_speed"] == 2
    # Another document has a field of its own.
    opened.example("watt_1")
    assert not is_red(opened)
    assert error(opened) == ""
    assert field(opened.page).input_value() == "1.57"


def test_escape_brings_the_old_speed_back(opened: Window) -> None:
    opened.example("crank_rocker")
    write(opened, "2")
    field(opened.page).fill("30 fo")
    field(opened.page).press("Escape")
    assert field(opened.page).input_value() == "2"
    assert not is_red(opened)
    assert speed(opened) == 2.0


def test_a_speed_is_a_step(opened: Window) -> None:
    opened.example("crank_rocker")
    write(opened, "2")
    write(opened, "3")
    opened.button("Undo").click()
    opened.settle()
    assert (speed(opened), field(opened.page).input_value()) == (2.0, "2")
    opened.button("Undo").click()
    opened.settle()
    assert speed(opened) == 1.57
    assert "input_speed" not in opened.document
    opened.button("Redo").click()
    opened.settle()
    assert speed(opened) == 2.0


def test_a_run_has_a_pace_of_its_own(opened: Window) -> None:
    opened.example("crank_rocker")
    write(opened, "3")
    opened.page.evaluate(
        """async () => {
             const { model } = window.assurStudio;
             model.shownRun.show(await model.ask("run", { by: "speed", speed: 2, t_end: 0.5 }));
           }"""
    )
    assert speed(opened) == 1.0
    assert opened.document["input_speed"] == 3
    opened.page.evaluate("window.assurStudio.model.shownRun.end()")
    assert (speed(opened), field(opened.page).input_value()) == (3.0, "3")


def test_another_driver_has_another_speed(opened: Window) -> None:
    opened.example("crank_rocker")
    write(opened, "3")
    opened.page.keyboard.press("Escape")
    opened.page.locator(".picture").focus()
    opened.page.keyboard.press("d")
    (x, y), (x2, y2) = opened.joint_px("D"), opened.joint_px("C")
    opened.page.mouse.click((x + x2) / 2.0, (y + y2) / 2.0)
    opened.wait_until("window.assurStudio.model.document.driver === 'rocker'")
    opened.settle()
    opened.page.keyboard.press("v")
    assert "input_speed" not in opened.document
    assert speed(opened) == 1.57


def test_each_of_several_drivers(opened: Window) -> None:
    opened.example("five_bar")
    write(opened, "2")
    assert opened.document["input_speed"] == [2, 1.57]
    opened.page.evaluate("window.assurStudio.model.setAxis(1)")
    opened.wait_until("window.assurStudio.playback.player.speed === 1.57")
    write(opened, "3")
    assert opened.document["input_speed"] == [2, 3]
    opened.page.evaluate("window.assurStudio.model.setAxis(0)")
    opened.wait_until("window.assurStudio.playback.player.speed === 2")


def test_a_reload_and_a_new_window_keep_it(browser: Browser) -> None:
    with window(browser) as one:
        one.open(FOUR_BAR)
        write(one, "3 rpm")
        typed = speed(one)
        one.wait_until_kept()
        one.page.reload()
        one.ready()
        one.settle()
        assert speed(one) == typed == math.pi / 10.0
        other = one.another()
        one.wait_until(f"window.assurStudio.playback.player.speed === {typed!r}", other)


def test_saved_and_opened_again(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "press.toml"
    path.write_text(document.toml_of(PRESS), encoding="utf-8")
    power = """async () => {
      const { model, playback } = window.assurStudio;
      const { arrays } = await model.ask("reactions", { speed: playback.player.speed, rows: 61 });
      return arrays.drive.reduce((sum, own) => sum + own, 0) * playback.player.speed;
    }"""
    with window(browser, path) as one:
        write(one, "1 rpm")
        before = one.page.evaluate(power)
        one.page.keyboard.press("Control+s")
        one.wait_until(
            "window.assurStudio.model.savedDocument === window.assurStudio.model.document"
        )
        typed = speed(one)
    held = assur.files.read(path)
    assert held.input_speed == typed == math.pi / 30.0
    with window(browser, path) as one:
        one.settle()
        assert speed(one) == typed
        assert one.page.evaluate(power) == before


def test_the_speed_of_another_programs_file(browser: Browser, tmp_path: Path) -> None:
    joints = [
        {"X": 0, "Y": 0, "TypeOfJoint": "R", "Links": ["ground", "crank"]},
        {"X": 0, "Y": 1, "TypeOfJoint": "R", "Links": ["crank", "rod"]},
        {"X": 3, "Y": 0, "TypeOfJoint": "RP", "Angle": 0.0, "Links": ["ground", "rod"]},
    ]
    path = tmp_path / "crank.pmks"
    path.write_text(json.dumps({"DrivingIndex": 0, "InputSpeed": 2.5, "Joints": joints}), "utf-8")
    with window(browser, path) as one:
        one.settle()
        assert speed(one) == 2.5
        assert one.document["input_speed"] == 2.5


def test_a_length_each_second(opened: Window) -> None:
    boom = {
        "driver": "lift",
        "joints": {"A": [0, 0], "B": [0.3, 0], "C": [0.6, 0.4]},
        "links": {"ground": ["A", "B"], "boom": ["A", "C"]},
        "slides": {"lift": {"base": "B", "end": "C"}},
    }
    opened.open(boom)
    write(opened, "30 mm/s")
    assert speed(opened) == 0.03
    write(opened, "30 rpm")
    assert "does not fit here: m/s, mm/s, cm/s, m/min" in error(opened)
    assert speed(opened) == 0.03
