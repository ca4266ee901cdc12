"""The panel in a real browser: dimensions, their effects, assemblies, drivers, names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.description.words import Status
from assur.errors import AssurError
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser, Locator

DEGREE = np.pi / 180.0


@pytest.fixture(scope="module")
def crank_window(browser: Browser) -> Iterator[Window]:
    with window(browser, example="crank_rocker") as one:
        one.settle()
        yield one


@pytest.fixture
def crank(crank_window: Window) -> Window:
    """The example as it is opened, with nothing to undo."""
    crank_window.page.evaluate(
        """async () => {
             const { model, playback } = window.assurStudio;
             document.activeElement.blur();
             await model.open({ example: "crank_rocker" });
             model.history.clear();
             model.output = undefined;
             model.emit("file");
             playback.seek(model.q);
           }"""
    )
    crank_window.settle()
    return crank_window


def row(one: Window, dimension: str) -> Locator:
    return one.page.locator(f'[data-dimension="{dimension}"]')


def write(one: Window, dimension: str, text: str) -> None:
    """Type into the field of a dimension, and Enter."""
    field = row(one, dimension).locator("input")
    field.click()
    field.fill(text)
    field.press("Enter")
    one.settle()


def error_of(place: Locator) -> str:
    own = place.locator(".field-error")
    return own.text_content() or "" if own.is_visible() else ""


def number(text: str | None) -> float:
    """Read a number as the page writes it."""
    return float((text or "").replace("−", "-").replace("+", ""))


def assert_as_solved(one: Window, mechanism: Any, q: Any) -> None:
    """Every joint is drawn where Python says that it is."""
    motion = mechanism.solve(q)
    for name in mechanism.joints:
        own = motion.joint(name).value
        assert one.place(name) == pytest.approx(tuple(own), abs=1e-6), name


def test_a_dimension_is_typed(crank: Window) -> None:
    own = assur.examples.crank_rocker()
    one = crank
    before = one.document
    write(one, "coupler.length", "13 cm")
    assert one.document["dimensions"] == {"coupler.length": 0.13}
    longer = own.with_dimensions({"coupler.length": 0.13})
    assert_as_solved(one, longer, one.q)
    assert row(one, "coupler.length").locator("input").input_value() == "130"
    # Quotients are in the unit shown; leaving the field applies too.
    field = row(one, "rocker.length").locator("input")
    field.fill("250/3")
    field.press("Tab")
    one.settle()
    both = longer.with_dimensions({"rocker.length": 0.25 / 3.0, "coupler.length": 0.13})
    assert_as_solved(one, both, one.q)
    assert field.input_value() == "83.33"
    # Each is one step.
    for _ in range(2):
        one.button("Undo").click()
        one.settle()
    assert one.document == before
    assert_as_solved(one, own, one.q)
    assert one.button("Undo").is_disabled()


def test_a_bad_value_keeps_the_picture_and_says_why(crank: Window) -> None:
    own = assur.examples.crank_rocker()
    one = crank
    before = one.document
    coupler = row(one, "coupler.length")
    field = coupler.locator("input")
    for text, reason in (
        ("abc", "“abc” is not a length. The picture keeps 120 mm."),
        ("3 kg", "“kg” does not fit here"),
        ("", "A number is needed."),
        ("-3", "a length must be positive"),
    ):
        write(one, "coupler.length", text)
        assert reason in error_of(coupler), text
        assert field.get_attribute("aria-invalid") == "true"
        assert one.document == before
        assert_as_solved(one, own, one.q)
    # It stays to be mended, until Escape.
    row(one, "crank.length").locator("input").focus()
    assert field.input_value() == "-3"
    field.focus()
    field.press("Escape")
    assert error_of(coupler) == ""
    assert field.input_value() == "120"
    # What does not close is said there too, and can be undone.
    write(one, "coupler.length", "300")
    assert one.document["dimensions"] == {"coupler.length": 0.3}
    with pytest.raises(AssurError) as caught:
        own.with_dimensions({"coupler.length": 0.3}).solve(one.q)
    miss = f"{1e3 * float(caught.value.value or 0.0):.3g} mm"
    assert f"miss each other by {miss}" in error_of(coupler)
    assert miss in (one.page.locator(".warning").text_content() or "")
    assert_as_solved(one, own, one.q)
    one.button("Undo").click()
    one.settle()
    assert error_of(coupler) == ""
    assert field.input_value() == "120"
    assert one.document == before
    assert_as_solved(one, own, one.q)


def test_steps_by_arrows_and_back_to_the_drawing(crank: Window) -> None:
    own = assur.examples.crank_rocker()
    one = crank
    before = one.document
    field = row(one, "coupler.length").locator("input")
    field.focus()
    for _ in range(3):
        field.press("ArrowUp")
    field.press("Shift+ArrowUp")
    one.settle()
    one.wait_until("window.assurStudio.model.history.canUndo")
    one.settle()
    assert one.document["dimensions"]["coupler.length"] == pytest.approx(0.146)
    assert_as_solved(one, own.with_dimensions({"coupler.length": 0.146}), one.q)
    # All of them are one step.
    one.button("Undo").click()
    one.settle()
    assert one.document == before
    write(one, "rocker.length", "90")
    row(one, "rocker.length").get_by_role("button").click()
    one.settle()
    assert one.document == before
    assert_as_solved(one, own, one.q)


def test_a_drag_lights_up_what_it_changes(crank: Window) -> None:
    one = crank
    x, y = one.joint_px("C")
    one.page.mouse.move(x, y)
    one.page.mouse.down()
    one.page.mouse.move(x + 25.0, y - 10.0, steps=4)
    one.wait_until("document.querySelectorAll('.dimension.changed').length > 0")
    lit = one.page.locator(".dimension.changed").evaluate_all(
        "(all) => all.map((own) => own.dataset.dimension)"
    )
    assert {"coupler.length", "rocker.length"} <= set(lit)
    assert "crank.length" not in lit
    one.page.mouse.up()
    one.settle()
    one.wait_until("document.querySelectorAll('.dimension.changed').length === 0")
    # The link is highlighted while its row is pointed at.
    row(one, "coupler.length").hover()
    assert one.page.locator(".halo path").count() > 0
    one.page.mouse.move(x, y + 100.0)
    assert one.page.locator(".halo path").count() == 0


@pytest.mark.parametrize("of", ["rocker", "P.y"])
def test_effects_are_the_derivatives(crank: Window, of: str) -> None:
    own = assur.examples.crank_rocker()
    one = crank
    one.seek(0.7)
    one.page.get_by_label("Output whose change is shown").select_option(of)
    one.settle()
    name, _, axis = of.partition(".")

    def output(dimension: str, value: float) -> float:
        motion = own.with_dimensions({dimension: value}).solve(0.7)
        part = motion.link(name) if not axis else motion.joint(name)
        return float(part.value) if not axis else float(part.value["xy".index(axis)])

    for dimension, value in own.dimensions.items():
        step = 1e-6
        slope = (output(dimension, value + step) - output(dimension, value - step)) / (2 * step)
        # ° per mm, mm per mm.
        wanted = slope / DEGREE / 1e3 if not axis else slope
        shown = number(row(one, dimension).locator(".effect").text_content())
        assert shown == pytest.approx(wanted, rel=6e-3, abs=1e-8), dimension
    head = one.page.locator(".effect-head").text_content() or ""
    assert head.endswith("° per mm" if not axis else "mm per mm")


def test_why_there_are_no_effects(crank: Window) -> None:
    # Dimensions of a redundant link change only together.
    crank.page.evaluate("window.assurStudio.model.open({ example: 'locomotive' })")
    crank.settle()
    remark = crank.page.get_by_role("region", name="Dimensions").locator(".remark")
    crank.wait_until("document.querySelector('.section:not([hidden]) .remark').textContent !== ''")
    assert "redundant link" in (remark.text_content() or "")


FACT = """(name) => [...document.querySelectorAll('.position-facts div')]
  .map((own) => own.textContent).find((text) => text.startsWith(name))"""


def fact(one: Window, name: str) -> str:
    """Return the row of the position that begins with a name."""
    return str(one.page.evaluate(FACT, name))


def test_the_position_and_its_transmission_angle(crank: Window) -> None:
    own = assur.examples.crank_rocker()
    one = crank
    one.page.get_by_label("Speed of the driver").fill("10")
    one.seek(64.0 * DEGREE)
    one.settle()
    motion = own.solve(64.0 * DEGREE)
    facts = one.page.locator(".position-facts")
    one.wait_until("document.querySelector('.position-facts').textContent.includes('48.')")
    text = facts.text_content() or ""
    gamma = np.linspace(0.0, 2.0 * np.pi, 361)
    least = float(own.solve(gamma).transmission_angle("C").min())
    for wanted in (
        f"{float(motion.link('rocker').value) / DEGREE:.1f}°",
        f"{float(motion.link('rocker').velocity(10.0)):.3g} rad/s",
        f"{1e3 * float(np.hypot(*motion.joint('P').velocity(10.0))):.3g} mm/s",
        f"{float(motion.transmission_angle('C')) / DEGREE:.1f}°",
        f"least {least / DEGREE:.1f}°",
    ):
        assert wanted in text
    caution = one.page.locator(".caution").text_content() or ""
    assert caution == f"γ falls to {least / DEGREE:.1f}° at φ = 0°, below the usual 40°."
    # While it plays the numbers follow, those of the server too.
    one.page.evaluate("window.assurStudio.playback.toggle()")
    for row_of in ("crank", "transmission"):
        before = fact(one, row_of)
        one.wait_until(f"({FACT})({row_of!r}) !== {before!r}")
    one.page.evaluate("window.assurStudio.playback.toggle()")
    # A longer ground raises it; then nothing is said.
    write(one, "ground.D.x", "131")
    better = own.with_dimensions({"ground.D.x": 0.131}).solve(gamma).transmission_angle("C")
    assert (float(better.min()) < 40.0 * DEGREE) == one.page.locator(".caution").is_visible()


def test_the_structure_is_told_and_an_assembly_chosen(browser: Browser) -> None:
    own = assur.examples.loom()
    with window(browser, example="loom", dark=True) as one:
        one.seek(50.0 * DEGREE)
        one.settle()
        one.wait_until("document.querySelectorAll('.assembly').length > 0")
        one.settle()
        before = one.document
        assert_structure_is_told(one)
        found = own.assemblies(one.q)
        cards = one.page.locator(".assembly")
        assert cards.count() == len(found)
        head = one.page.get_by_role("region", name="Assembly").locator(".note").first
        assert head.text_content() == f"{len(found)} at this position"
        other = next(
            i for i in range(len(found)) if cards.nth(i).get_attribute("aria-pressed") == "false"
        )
        cards.nth(other).hover()
        assert one.page.locator(".ghost path").count() == len(own.links) - 1
        cards.nth(other).click()
        one.settle()
        for name, place in (found[other].joints or {}).items():
            assert one.place(name) == pytest.approx(tuple(place), abs=1e-6)
        assert one.page.locator(".assembly[aria-pressed=true]").get_attribute(
            "data-assembly"
        ) == str(other)
        one.button("Undo").click()
        one.settle()
        assert one.document == before
        assert_as_solved(one, own, one.q)


def test_drivers_by_sliders_and_fields(browser: Browser) -> None:
    own = assur.examples.excavator()
    with window(browser, example="excavator") as one:
        one.settle()
        q = np.array(own.q0, float)
        for i, value in ((2, 2.3), (0, 2.9), (1, 2.4)):
            field = one.page.locator(f'[data-driver-field="{i}"]')
            field.fill(str(value))
            field.press("Enter")
            one.wait_until(f"window.assurStudio.model.axis === {i}")
            one.wait_until(f"Math.abs(window.assurStudio.playback.q - {value}) < 1e-9")
            q[i] = value
            tip = own.solve(q).joint("tip").value
            one.settle()
            assert one.place("tip") == pytest.approx(tuple(tip), abs=1e-6)
        # By its slider, as far as it can go while the others are held.
        slider = one.page.locator('[data-driver="0"]')
        slider.focus()
        slider.press("Shift+ArrowRight")
        one.wait_until(
            "window.assurStudio.model.axis === 0 && window.assurStudio.playback.q > 2.91"
        )
        one.settle()
        place = one.page.evaluate("window.assurStudio.model.held")
        assert place[1:] == pytest.approx(q[1:])
        assert one.place("tip") == pytest.approx(
            tuple(own.solve(place).joint("tip").value), abs=1e-6
        )
        high = float(slider.get_attribute("max") or "nan")
        for beyond, works in ((-1e-2, True), (5e-2, False)):
            status = own.solve([high + beyond, *place[1:]], on_error="nan").status
            assert bool(status < Status.SINGULAR) is works
        field = one.page.locator('[data-driver-field="0"]')
        field.fill("9")
        field.press("Enter")
        assert "boom_cylinder goes from" in error_of(one.page.locator(".driver").nth(0))
        assert one.page.evaluate("window.assurStudio.model.held") == pytest.approx(place)


def assert_structure_is_told(one: Window) -> None:
    text = one.page.get_by_role("region", name="Structure").text_content() or ""
    assert "class IV" in text
    assert "3·7 − 2·10 = 1" in text
    assert "l234, l365, l48, l876, l95, l107" in text
    one.page.locator(".groups li").nth(1).focus()
    assert one.page.locator(".halo path").count() >= 6


def test_joints_and_links_are_renamed(browser: Browser) -> None:
    with window(browser, example="crank_rocker", width="narrow") as one:
        one.settle()
        one.page.get_by_role("tab", name="More").click()
        one.page.get_by_text("Rename").click()
        before = one.document

        def rename(own: str, to: str) -> None:
            field = one.page.locator(f'[data-named="{own}"]')
            field.fill(to)
            field.press("Enter")
            one.settle()

        rename("C", "B")
        assert "“B” is taken" in (
            one.page.locator(".named .field-error:visible").text_content() or ""
        ).replace("The name ", "")
        assert one.document == before
        rename("C", "pin")
        rename("coupler", "rod")
        own = one.document
        assert set(own["joints"]) == {"A", "B", "pin", "D", "P"}
        assert own["links"]["rod"] == ["B", "pin", "P"]
        assert_as_solved(one, one.mechanism, one.q)
        for _ in range(2):
            one.page.evaluate("window.assurStudio.model.undo()")
            one.settle()
        assert one.document == before


def test_other_languages_and_narrow_windows(browser: Browser) -> None:
    with window(browser, example="excavator", width="narrow", dark=True) as one:
        titles: set[str] = set()
        for code in ("en", "de", "ru", "uk"):
            one.page.evaluate("(code) => window.assurStudio.speak(code)", code)
            one.settle()
            for tab in ("dimensions", "assembly", "more"):
                one.page.locator(f".tab[data-tab={tab}]").click()
                shown = one.page.locator(".section:visible h2").all_text_contents()
                assert shown
                titles |= set(shown)
                panel = one.page.locator(".panel")
                assert panel.evaluate("(own) => own.scrollWidth <= own.clientWidth")
                assert too_small(one) == []
        # Nine sections, each with its own title in each language.
        assert len(titles) == 36


def too_small(one: Window) -> list[str]:
    """Return the controls of the panel that a finger would miss."""
    found: list[str] = one.page.locator(
        ".panel :is(input, button, select, summary):visible"
    ).evaluate_all(
        """(all) => all.filter((own) => {
             const box = (own.closest('.quantity') ?? own).getBoundingClientRect();
             return box.height < 44;
           }).map((own) => own.outerHTML)"""
    )
    return found
