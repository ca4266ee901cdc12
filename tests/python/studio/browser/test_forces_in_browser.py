"""Forces, flywheels and runs in the studio's page: what it shows is what Python computes."""

from __future__ import annotations

import copy
import re
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.studio import document
from studio.asking import FOUR_BAR, PRESS
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Locator

SPEED = 10.0
UNITS = {"N·m": 1.0, "kN·m": 1e3, "mN·m": 1e-3, "N": 1.0, "kN": 1e3, "W": 1.0, "kW": 1e3}


@pytest.fixture(scope="module")
def opened(browser: Browser) -> Iterator[Window]:
    with window(browser) as one:
        yield one


@pytest.fixture
def press(opened: Window) -> Window:
    """Return a window that shows the press at its speed."""
    show(opened, PRESS)
    return opened


def show(one: Window, own: dict[str, Any]) -> None:
    one.page.evaluate("() => { window.assurStudio.model.shownRun.end(); }")
    one.open(own)
    one.page.evaluate(
        """(speed) => {
             window.assurStudio.pace(speed);
             window.assurStudio.model.forces.refresh();
           }""",
        SPEED,
    )
    one.settle()


def machine(own: dict[str, Any]) -> assur.Machine:
    return document.read_machine(own)


def quantity(text: str) -> float:
    """Read a number with its unit, as it is shown."""
    number, unit = text.replace("\u2212", "-").split()
    return float(number) * UNITS[unit]


def fact(one: Window, section: str, key: str) -> Locator:
    return one.page.locator(f"[data-section={section}] [data-fact={key}]")


def field(one: Window, key: str) -> Locator:
    return one.page.locator(f"[data-key='{key}']")


def typed(one: Window, key: str, text: str) -> None:
    own = field(one, key)
    own.fill(text)
    own.press("Enter")
    own.blur()
    one.settle()


def test_the_drive_is_pythons(press: Window) -> None:
    q = np.linspace(0.0, 2.0 * np.pi, 361)
    found = np.asarray(machine(PRESS).reactions(q, SPEED).driver)
    # The same by virtual work: loads, and the change of the reduced inertia at an even speed.
    own = machine(PRESS)
    slope = own.reduced_inertia(q).d1
    wanted = 0.5 * slope * SPEED**2 - own.reduced_moment(q, speed=SPEED)
    assert found == pytest.approx(wanted)
    press.seek(1.0)
    now = press.page.locator("[data-section=drive] output.big-number")
    at_one = float(machine(PRESS).reactions(1.0, SPEED).driver)
    assert quantity(now.inner_text()) == pytest.approx(at_one, rel=6e-3)
    most = float(found[np.argmax(np.abs(found))])
    assert quantity(fact(press, "drive", "driveGreatest").inner_text()) == pytest.approx(
        most, rel=6e-3
    )
    power = float(np.trapezoid(found, q)) / (2.0 * np.pi) * SPEED
    assert quantity(fact(press, "drive", "powerMean").inner_text()) == pytest.approx(
        power, rel=6e-3
    )
    # The diagrams can show it too.
    press.page.evaluate("window.assurStudio.playback.charts[0].choose('crank.drive')")
    press.seek(1.0)
    value = press.page.locator(".dock .chart .value").first.inner_text()
    assert quantity(value) == pytest.approx(at_one, rel=6e-3)


def arrow(one: Window, key: str) -> Any:
    """Return start and tip of an arrow, px."""
    line = one.page.locator(f"path.vector[data-force='{key}']")
    head = one.page.locator(f"path.vector[data-force='{key}'] + path.head")
    return first(line), first(head)


def first(path: Locator) -> Any:
    """Return the first point of a path."""
    numbers = re.findall(r"-?[\d.]+", path.get_attribute("d") or "")
    return np.array([float(text) for text in numbers[:2]])


def test_arrows_point_as_the_forces(press: Window) -> None:
    press.page.evaluate(
        "window.assurStudio.canvas.stage.choose([]), window.assurStudio.playback.show()"
    )
    found = machine(PRESS)
    lengths = {}
    for q in (0.7, 2.2, 4.0):
        press.seek(q)
        at = found.reactions(q, SPEED)
        for joint, on in (("O", "crank"), ("A", "crank"), ("B", "rod")):
            start, end = arrow(press, f"R {joint} {on}")
            force = at.joint(joint, on=on)
            along = (end - start) * (1.0, -1.0)
            cosine = float(along @ force) / float(np.hypot(*along) * np.hypot(*force))
            assert cosine == pytest.approx(1.0, abs=1e-3)
            lengths[joint, q] = np.hypot(*along) / np.hypot(*force)
            assert press.px(*press.place(joint)) == pytest.approx(shown(press, start), abs=0.1)
    # One scale for all, at all places.
    assert np.ptp(list(lengths.values())) < 2e-3 * np.mean(list(lengths.values()))
    # The load pushes onto the pin of the ram, 900 N.
    start, end = arrow(press, "F 0 ram 0")
    assert end[1] == pytest.approx(start[1], abs=0.05)
    assert (end[0] - start[0]) / -900.0 == pytest.approx(lengths["B", 4.0], rel=2e-3)
    box = press.page.locator("[data-switch=forces]")
    box.uncheck()
    assert not press.page.locator("path.vector[data-force='R A crank']").is_visible()
    box.check()
    assert press.page.locator("path.vector[data-force='R A crank']").is_visible()


def shown(one: Window, at: Any) -> tuple[float, float]:
    """Return where a place of the stage's layer is in the window."""
    x, y = one.page.evaluate(
        """([x, y]) => {
             const { stage } = window.assurStudio.canvas;
             const box = stage.element.getBoundingClientRect();
             return [box.left + stage.view.x + x, box.top + stage.view.y + y];
           }""",
        list(at),
    )
    return x, y


def test_a_mass_is_typed_and_undone(press: Window) -> None:
    before = float(machine(PRESS).reactions(1.0, SPEED).driver)
    typed(press, "body ram mass", "0.05 t")
    assert press.document["bodies"]["ram"] == {"mass": 50}
    press.seek(1.0)
    after = float(machine(press.document).reactions(1.0, SPEED).driver)
    now = press.page.locator("[data-section=drive] output.big-number")
    assert quantity(now.inner_text()) == pytest.approx(after, rel=6e-3)
    assert after != pytest.approx(before, rel=0.05)
    press.button("Undo").click()
    press.settle()
    assert press.document["bodies"]["ram"] == {"mass": 20}
    assert field(press, "body ram mass").input_value() == "20"
    # A place on the link for the centre of mass.
    field(press, "body crank at").select_option("")
    press.settle()
    assert press.document["bodies"]["crank"]["at"] == [0.05, 0]
    typed(press, "body crank at 0", "2 cm")
    assert press.document["bodies"]["crank"]["at"] == [0.02, 0]


def test_bad_values_are_said_at_the_place(press: Window) -> None:
    own = copy.deepcopy(press.document)
    for key, text, said in (
        ("body ram mass", "heavy", "“heavy” is not a number."),
        ("body crank inertia", "-1", "-1 is negative: it must not be."),
        ("motor stall", "0", "0 is not more than zero: it must be."),
        ("flywheel fluctuation", "5 kg", "“kg” does not fit here"),
    ):
        typed(press, key, text)
        one = field(press, key)
        assert one.get_attribute("aria-invalid") == "true"
        message = press.page.locator(f"id={one.get_attribute('aria-describedby')}")
        assert message.is_visible()
        assert said in message.inner_text()
        assert one.input_value() == text
        one.press("Escape")
        assert one.get_attribute("aria-invalid") == "false"
    assert press.document == own
    # What only the server knows is said at its load, and the rest goes on.
    show(
        press, {**PRESS, "loads": [*PRESS["loads"], {"type": "Force", "at": "X", "force": [1, 0]}]}
    )
    error = press.page.locator(".loads li").nth(2).locator(".field-error")
    assert 'there is no joint "X"' in error.inner_text()
    press.button("Remove: Force on X").click()
    press.settle()
    assert press.document["loads"] == PRESS["loads"]
    assert press.page.locator(".loads .field-error").count() == 0


def test_what_the_package_warns_of_stands_at_the_flywheel(press: Window) -> None:
    """A motor that gives less than the loads take."""
    show(press, {**PRESS, "motor": {"type": "ConstantTorque", "torque": 5.0}})
    typed(press, "flywheel mean_speed", "20")
    press.wait_until("!document.querySelector('[data-fact=warnings]').hidden")
    said = fact(press, "flywheel", "warnings").text_content() or ""
    assert "the motor gives the driver 5 N·m" in said
    show(press, PRESS)
    typed(press, "flywheel mean_speed", "")
    press.wait_until("document.querySelector('[data-fact=warnings]').hidden")


def test_the_flywheel_is_pythons(press: Window) -> None:
    typed(press, "flywheel fluctuation", "2 %")
    press.wait_until("document.querySelector('[data-fact=inertia]').textContent !== ''")
    press.settle()
    found = machine(PRESS).flywheel(0.02)
    assert fact(press, "flywheel", "inertia").inner_text() == f"{found.inertia:#.4g} kg·m²"
    assert quantity(fact(press, "flywheel", "motorMoment").inner_text()) == pytest.approx(
        found.motor_moment, rel=6e-3
    )
    greatest = fact(press, "flywheel", "greatestSpeed").inner_text()
    assert greatest == f"{found.max.value:.2f} rad/s"
    bare = machine(PRESS).steady_state()
    assert fact(press, "flywheel", "withoutIt").inner_text() == f"δ = {bare.delta:.3f}"
    press.button("Diagrams of the flywheel").click()
    plots = press.page.locator(".flywheel-charts .plot")
    assert plots.count() == 3
    assert all(plots.nth(i).is_visible() for i in range(3))
    press.seek(2.0)
    value = press.page.locator("[data-diagram=speed] .value").inner_text()
    assert float(value) == pytest.approx(float(found.speed(2.0)), rel=1e-3)
    # The cursor of the diagram drives.
    box = plots.nth(1).bounding_box()
    assert box
    press.drag((box["x"] + 60, box["y"] + 80), (box["x"] + box["width"] / 2, box["y"] + 80))
    assert press.q == pytest.approx(np.pi, abs=0.6)
    press.button("Back to the other diagrams").click()
    assert not plots.nth(0).is_visible()
    assert press.page.locator(".dock .charts").first.is_visible()


def test_a_run_by_the_motor(press: Window) -> None:
    press.seek(0.5)
    if not field(press, "run by").is_visible():
        press.page.locator("[data-section=run] summary").click()
    field(press, "run by").select_option("machine")
    typed(press, "run machine_speed", "3")
    typed(press, "run machine_end", "800 ms")
    press.button("Run").click()
    press.wait_until("window.assurStudio.model.run !== null")
    press.page.evaluate("window.assurStudio.playback.pause()")
    found = machine(PRESS).run(0.8, 0.5, 3.0, rtol=1e-8)
    end = found.at(0.8)
    press.wait_until("document.querySelector('[data-fact=runSpeed]') !== null")
    assert fact(press, "run", "runSpeed").inner_text() == f"{end.speed:.1f} rad/s"
    degrees = fact(press, "run", "runAt").inner_text()
    assert float(degrees[:-1]) == pytest.approx(np.degrees(end.q), rel=6e-3)
    press.seek(0.8)
    assert press.page.evaluate("window.assurStudio.model.q") == pytest.approx(
        float(end.q), rel=1e-6
    )
    place = machine(PRESS).mechanism.solve(end.q).joint("B").value  # type: ignore[union-attr]
    assert press.place("B") == pytest.approx(place, abs=1e-6)
    # Forces along the run: those of the motion, with its acceleration.
    torque = float(machine(PRESS).reactions(end.q, end.speed, end.acceleration).driver)
    now = press.page.locator("[data-section=drive] output.big-number")
    assert quantity(now.text_content() or "") == pytest.approx(torque, rel=6e-3)
    press.button("Back to the turn").click()
    assert press.q == pytest.approx(0.5)
    assert press.page.evaluate("window.assurStudio.playback.player.speed") == SPEED
    # Editing ends a run too.
    press.button("Run").click()
    press.wait_until("window.assurStudio.model.run !== null")
    typed(press, "body ram mass", "21")
    assert press.page.evaluate("window.assurStudio.model.run") is None
    assert press.page.evaluate("window.assurStudio.model.data.turn.unit") == "angle"


def test_a_run_by_a_law(press: Window) -> None:
    if not field(press, "run by").is_visible():
        press.page.locator("[data-section=run] summary").click()
    press.seek(0.0)
    field(press, "run by").select_option("law")
    press.page.wait_for_timeout(30)
    field(press, "run law").select_option("Polynomial345")
    for key, text in (("start", "10°"), ("end", "1/4 turn"), ("duration", "2")):
        typed(press, f"run {key}", text)
    press.button("Run").click()
    press.wait_until("window.assurStudio.model.run !== null")
    press.page.evaluate("window.assurStudio.playback.pause()")
    press.seek(0.7)
    law = assur.laws.Polynomial345(np.radians(10.0), np.pi / 2.0, 2.0)
    q = press.page.evaluate("window.assurStudio.model.q")
    assert q == pytest.approx(float(law.at(0.7)[0]), abs=1e-4)
    press.button("Back to the turn").click()


def test_a_force_from_nothing(opened: Window) -> None:
    show(opened, {key: own for key, own in FOUR_BAR.items() if key != "bodies"})
    assert not opened.page.locator("[data-section=drive]").is_visible()
    if not field(opened, "load new").is_visible():
        opened.page.locator("[data-section=machine] summary").click()
    field(opened, "load new").select_option("Force")
    opened.settle()
    field(opened, "load 0 at").select_option("C")
    opened.settle()
    typed(opened, "load 0 force 0", "0.25 kN")
    typed(opened, "load 0 force 1", "0")
    assert opened.document["loads"] == [{"type": "Force", "at": "C", "force": [250, 0]}]
    opened.seek(0.3)
    torque = float(machine(opened.document).reactions(0.3, SPEED).driver)
    # By virtual work: the force times the derivative of its point.
    assert torque == pytest.approx(-250.0 * opened.mechanism.solve(0.3, order=1).joint("C").d1[0])
    now = opened.page.locator("[data-section=drive] output.big-number")
    assert quantity(now.inner_text()) == pytest.approx(torque, rel=6e-3)
    # By a table over the crank.
    field(opened, "load 0 force 0 kind").click()
    opened.settle()
    rows = field(opened, "load 0 force 0 rows")
    rows.fill("0 0\n90° 1 kN\n360 0")
    rows.blur()
    opened.settle()
    table = opened.document["loads"][0]["force"][0]
    assert table["value"] == [0, 1000, 0]
    assert table["q"] == pytest.approx([0.0, np.pi / 2.0, 2.0 * np.pi])
    torque = float(machine(opened.document).reactions(0.3, SPEED).driver)
    opened.seek(0.3)
    assert quantity(now.inner_text()) == pytest.approx(torque, rel=6e-3)
    rows.fill("90 0\n0 1")
    rows.blur()
    opened.settle()
    assert opened.page.get_by_text("Line 2: its coordinate is less than the one").is_visible()
    assert opened.document["loads"][0]["force"][0] == table


@pytest.mark.parametrize("width", ["between", "narrow"])
def test_other_widths(browser: Browser, width: str) -> None:
    with window(browser, width=width, dark=True) as one:
        show(one, PRESS)
        one.page.get_by_role("tab", name="More").click()
        one.settle()
        one.wait_until("document.querySelector('[data-fact=inertia]').textContent !== ''")
        assert quantity(one.page.locator("[data-section=drive] output.big-number").inner_text())
        panel = one.page.locator(".panel")
        wide, own = panel.evaluate("(e) => [e.scrollWidth, e.clientWidth]")
        assert wide <= own
        one.button("Diagrams of the flywheel").click()
        assert one.page.locator(".flywheel-charts .plot").first.is_visible()
        one.page.get_by_role("tab", name="Diagrams").click()
        one.button("Back to the other diagrams").click()
        assert not one.page.locator(".flywheel-charts").is_visible()


def test_languages_keep_what_is_shown(press: Window) -> None:
    for code, word in (("de", "Kräfte"), ("ru", "Силы"), ("uk", "Сили"), ("en", "Forces")):
        press.page.evaluate("(code) => window.assurStudio.speak(code)", code)
        press.settle()
        assert word in press.page.locator(".switches").inner_text()
        press.seek(1.0)
        now = press.page.locator("[data-section=drive] output.big-number").inner_text()
        at_one = float(machine(PRESS).reactions(1.0, SPEED).driver)
        assert quantity(now) == pytest.approx(at_one, rel=6e-3)
