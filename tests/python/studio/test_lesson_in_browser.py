"""The program of Manzhosov and Petrova in a real browser, by the table of its controls."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import tomllib

import assur
from browsing import Server
from lesson_page import DEGREE, LessonPage

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Locator

TABLE = Path(__file__).with_name("lesson_controls.toml")
CONTROLS: list[dict[str, Any]] = tomllib.loads(TABLE.read_text(encoding="utf-8"))["control"]
LENGTHS = ("l1", "l2", "l3", "l4")
SIZES = {"wide": (1440, 900), "between": (900, 800), "narrow": (390, 844)}
SCREEN = "button, input, select, [role=slider]"


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    server = Server()
    yield server.address
    server.stop()


@pytest.fixture(scope="module")
def opened(browser: Browser, address: str) -> Iterator[LessonPage]:
    page = LessonPage(browser, address)
    yield page
    page.close()


@pytest.fixture
def lesson(opened: LessonPage) -> LessonPage:
    opened.page.set_viewport_size({"width": 1440, "height": 900})
    opened.renew()
    return opened


def is_hidden(control: dict[str, Any]) -> bool:
    return "hidden" in control


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
        [end * l1 for end in assur.crank_rocker.ground_range(l2 / l1, l3 / l1, 0.0, angle)]
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
    exact = assur.crank_rocker.solve(phi1, l1, l2, l3, l4, design["speed"])
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


def typed(lesson: LessonPage, name: str, text: str) -> None:
    """Type a value and apply it."""
    lesson.control("textbox", name).fill(text)
    lesson.control("textbox", name).press("Enter")
    lesson.until("!lesson.fields.isDirty")


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
    typed(lesson, "l4, ground", "4.9")
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
    typed(lesson, "φ1 at start", "0")
    held = lesson.figures
    exact = assur.crank_rocker.solve(0.0, 1.0, 4.5, 1.5, 4.995)
    assert held["gamma"] == pytest.approx(float(exact.gamma))
    assert held["l4"] == pytest.approx(4.995)


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
def test_other_languages(opened: LessonPage, language: str) -> None:
    """All is said in the language, and finds its room."""
    page = opened.page
    page.set_viewport_size({"width": 1440, "height": 900})
    opened.renew(language=language)
    page.evaluate("lesson.seek(0); lesson.stop()")
    page.locator(".lesson-card dl div").first.wait_for()
    assert page.locator(".lesson-run").inner_text() not in ("", "Run")
    panel = (
        ".lesson-section, .lesson-buttons, .lesson-buttons .button, .lesson-warning, .lesson-card"
    )
    assert overflowing(opened, panel) == []


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
