"""Designing while looking, the projector view and the help, in a real browser."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

COUPLER, ROCKER = "coupler.length", "rocker.length"
STUDIO = "window.assurStudio"


@pytest.fixture(scope="module")
def opened(browser: Browser) -> Iterator[Window]:
    with window(browser) as one:
        yield one


@pytest.fixture
def studio(opened: Window) -> Window:
    """Return the window with the crank-rocker as if it were new."""
    opened.page.evaluate(
        """async () => {
             const { model, projecting, designing } = window.assurStudio;
             if (projecting.isOn) projecting.toggle();
             const none = { sliders: null, across: "", up: "", metric: "", point: "", number: "" };
             Object.assign(designing.choices, none);
             await model.open({ example: "crank_rocker" });
             model.history.clear();
             model.emit("file");
             document.activeElement.blur();
           }"""
    )
    opened.settle()
    return opened


def dimensions(studio: Window) -> dict[str, float]:
    found: dict[str, float] = studio.document["dimensions"]
    return found


def map_of(studio: Window) -> dict[str, Any]:
    """Return the numbers that the picture of the map shows, once it is of rest."""
    grid = f"{STUDIO}.map.grid"
    studio.wait_until(f"{grid}?.x.length === 41")
    found: dict[str, Any] = studio.page.evaluate(
        f"""() => {{
              const {{ x, y, value, reason, reasons }} = {grid};
              const plain = (one) => [...one].map((v) => (Number.isFinite(v) ? v : null));
              return {{ x: [...x], y: [...y], value: plain(value), reason: [...reason], reasons }};
            }}"""
    )
    return found


def test_a_slider_ends_where_python_does(studio: Window) -> None:
    page, before = studio.page, studio.mechanism
    slider = page.get_by_role("slider", name="coupler", exact=True)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    start = (box["x"] + box["width"] / 3, y)
    page.mouse.move(*start)
    page.mouse.down()
    shown = set()
    for step in range(12):
        page.mouse.move(start[0] + 4 * step, y)
        page.wait_for_timeout(25)
        shown.add(studio.place("C"))
    page.mouse.up()
    studio.settle()
    # The picture followed while it slid.
    assert len(shown) > 4
    length = dimensions(studio)[COUPLER]
    assert length != pytest.approx(0.12, abs=1e-4)
    # Round in mm, as the slider steps.
    assert length * 2000 == pytest.approx(round(length * 2000), abs=1e-9)
    wanted = before.with_dimensions({COUPLER: length}).solve(studio.q)
    for joint in "BCP":
        place = tuple(map(float, wanted.joint(joint).value))
        assert studio.place(joint) == pytest.approx(place, abs=1e-8), joint
    # One step of undo.
    studio.button("Undo").click()
    studio.settle()
    assert COUPLER not in studio.document.get("dimensions", {})
    assert studio.button("Undo").is_disabled()


def test_what_cannot_be_assembled_keeps_the_last_good_picture(studio: Window) -> None:
    page, before = studio.page, studio.place("C")
    field = page.locator(f"[data-slides='{COUPLER}']")
    for text, words in (("900", "miss each other"), ("-3", "more than zero"), ("abc", "not a len")):
        field.fill(text)
        field.press("Enter")
        studio.settle()
        note = page.locator(".slider .field-error").first
        assert words in note.inner_text()
        assert studio.place("C") == pytest.approx(before, abs=1e-15)
        assert "dimensions" not in studio.document
    assert studio.button("Undo").is_disabled()
    field.fill("12,5 cm")
    field.press("Enter")
    studio.settle()
    assert dimensions(studio)[COUPLER] == pytest.approx(0.125, abs=1e-15)
    assert page.locator(".slider .field-error:visible").count() == 0


def test_a_slider_is_added_and_taken_away(studio: Window) -> None:
    page = studio.page
    page.get_by_label("Dimension", exact=True).select_option("ground.D.x")
    studio.button("Add slider").click()
    slider = page.get_by_role("slider", name="ground D.x")
    assert slider.evaluate("(one) => one === document.activeElement")
    # By keys, each a step of its own, and they do not turn the crank.
    q = studio.q
    slider.press("ArrowRight")
    studio.settle()
    # From 50 to 200 mm a step is 0.5 mm.
    assert dimensions(studio)["ground.D.x"] == pytest.approx(0.1005, abs=1e-12)
    assert studio.q == q
    studio.button("Remove the slider of ground D.x").click()
    assert slider.count() == 0


def test_the_map_has_the_values_of_a_sweep(studio: Window) -> None:
    studio.page.locator(".map-told").scroll_into_view_if_needed()
    shown = map_of(studio)
    x, y = np.array(shown["x"]), np.array(shown["y"])
    assert (x[0], x[-1]) == pytest.approx((0.06, 0.18), rel=1e-9)
    value = np.array(shown["value"], dtype=float).reshape(41, 41)
    q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    wanted = assur.sweep(
        studio.mechanism,
        {COUPLER: x[None, :], ROCKER: y[:, None]},
        q,
        metrics={"least": assur.metric.min_transmission_angle("C")},
    )["least"]
    np.testing.assert_array_equal(np.isnan(value), np.isnan(wanted))
    assert 100 < np.isnan(wanted).sum() < 1500
    np.testing.assert_allclose(value, wanted, atol=1e-12)
    # By a motion of one cell, without the engine of sweeps.
    at = (33, 12)
    own = studio.mechanism.with_dimensions({COUPLER: x[at[1]], ROCKER: y[at[0]]}).solve(q)
    assert value[at] == pytest.approx(own.transmission_angle("C").min(), abs=1e-12)
    # What is hatched has the area of the cells without a value.
    area = studio.page.evaluate(
        """() => {
             let sum = 0;
             for (const one of document.querySelectorAll(".map-without")) {
               const cells = one.getAttribute("d").matchAll(/h([\\d.]+)v([\\d.]+)/g);
               for (const [, w, h] of cells) sum += w * h;
             }
             const { width, height } = window.assurStudio.map.picture;
             return sum / (width * height);
           }"""
    )
    assert area == pytest.approx(np.isnan(wanted).mean(), rel=0.01)
    assert "crank stops" in shown["reasons"]
    assert studio.page.locator(".map-reason", has_text="crank stops").is_visible()
    name = studio.page.locator("svg.map").get_attribute("aria-label")
    assert name is not None
    assert "least γ at C: least 0° at" in name
    assert np.nanmin(wanted) < 1e-12
    assert f"greatest {np.degrees(np.nanmax(wanted)):.3g}°" in name
    assert f"{100 * np.isnan(wanted).mean():.0f} % of the designs have no value" in name


def test_the_ring_sets_both_dimensions(studio: Window) -> None:
    page = studio.page
    page.locator(".map-told").scroll_into_view_if_needed()
    map_of(studio)
    ring = page.get_by_role("slider", name="This design")
    box = ring.bounding_box()
    assert box is not None
    start = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] - 60, start[1] - 20, steps=10)
    page.wait_for_timeout(60)
    told = page.locator(".map-told").inner_text()
    page.mouse.up()
    studio.settle()
    found = dimensions(studio)
    # The plot is 41 cells of 3 mm and 2 mm.
    width, height = page.evaluate(f"[{STUDIO}.map.picture.width, {STUDIO}.map.picture.height]")
    assert found[COUPLER] == pytest.approx(0.12 - 60 * 0.123 / width, abs=1e-3)
    assert found[ROCKER] == pytest.approx(0.08 + 20 * 0.082 / height, abs=1e-3)
    place, value = told.split(": ")
    assert place == f"coupler {1000 * found[COUPLER]:g} mm, rocker {1000 * found[ROCKER]:g} mm"
    # The value is that of the cell there, whose sides are 3 and 2 mm.
    q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    cell = {
        name: side * round(found[name] / side) for name, side in ((COUPLER, 3e-3), (ROCKER, 2e-3))
    }
    least = studio.mechanism.with_dimensions(cell).solve(q).transmission_angle("C").min()
    assert value == f"{np.degrees(least):#.3g}°"
    # Into what cannot be assembled: the last good design stays.
    box = page.locator("svg.map").bounding_box()
    assert box is not None
    studio.drag(ring_place(studio), (box["x"] + box["width"] - 20, box["y"] + 170), 12)
    studio.settle()
    assert studio.state == "moves"
    assert page.evaluate(f"{STUDIO}.model.problem") is None
    # By a key, one dimension alone.
    before = dimensions(studio)
    ring.press("ArrowUp")
    studio.settle()
    after = dimensions(studio)
    assert after[ROCKER] > before[ROCKER]
    assert after[COUPLER] == before[COUPLER]


def ring_place(studio: Window) -> tuple[float, float]:
    box = studio.page.locator(".map-ring").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_another_metric_and_other_dimensions(studio: Window) -> None:
    page = studio.page
    page.get_by_label("What the map shows").select_option("span rocker")
    page.get_by_label("Dimension upwards").select_option("ground.D.x")
    studio.wait_until(f"{STUDIO}.map.grid?.names.join() === 'coupler.length,ground.D.x'")
    studio.settle()
    shown = map_of(studio)
    value = np.array(shown["value"], dtype=float).reshape(41, 41)
    i, j = 20, 18
    own = studio.mechanism.with_dimensions({COUPLER: shown["x"][j], "ground.D.x": shown["y"][i]})
    angles = own.solve(np.linspace(0, 2 * np.pi, 72, endpoint=False)).link("rocker").value
    assert value[i, j] == pytest.approx(np.ptp(angles), abs=1e-12)
    # The same dimension on both sides: they change places.
    page.get_by_label("Dimension to the right").select_option("ground.D.x")
    assert page.get_by_label("Dimension upwards").input_value() == COUPLER


def test_a_target_path_drawn_over_the_path_has_nearly_no_deviation(studio: Window) -> None:
    page = studio.page
    studio.button("Draw a target path").click()
    q = np.linspace(0, 2 * np.pi, 90)
    path = studio.mechanism.solve(q).joint("P").value
    places = [studio.px(*map(float, place)) for place in path]
    page.mouse.move(*places[0])
    page.mouse.down()
    for place in places[1:]:
        page.mouse.move(*place)
    page.mouse.up()
    deviation = f"{STUDIO}.target.deviation"
    studio.wait_until(f"!!{deviation}")
    px = float(page.evaluate(f"1 / {STUDIO}.canvas.stage.view.scale"))
    drawn = page.evaluate(f"[{deviation}.greatest, {deviation}.rms]")
    assert 0 < drawn[1] <= drawn[0] < 1.5 * px
    assert page.evaluate(f"{STUDIO}.model.target.closed")
    # While a dimension changes the number follows, and is no part of the document.
    field = page.locator(f"[data-slides='{ROCKER}']")
    field.fill("90")
    field.press("Enter")
    studio.settle()
    target = np.array(page.evaluate(f"{STUDIO}.model.target.points"))
    moved = studio.mechanism.solve(np.linspace(0, 2 * np.pi, 4001)).joint("P").value
    gaps = np.linalg.norm(target[:, None] - moved[None], axis=-1).min(axis=1)
    assert page.evaluate(f"{deviation}.greatest") == pytest.approx(gaps.max(), rel=0.02)
    assert gaps.max() > 10 * px
    assert "target" not in studio.document
    shown = page.get_by_label("Target path").locator("dd").first.inner_text()
    assert float(shown.split()[0]) == pytest.approx(1000 * gaps.max(), rel=0.02)
    # It is kept over another language and over loading again.
    studio.button("Clear").click()
    assert page.evaluate(f"{STUDIO}.model.target") is None
    studio.button("Take this path").click()
    assert page.evaluate(f"{deviation}.greatest") < 1e-3 * px
    studio.wait_until_kept()
    page.reload()
    studio.ready()
    studio.settle()
    assert page.evaluate(f"{STUDIO}.model.target.points.length") > 50


def test_drawing_a_target_ends_by_escape(studio: Window) -> None:
    page = studio.page
    studio.button("Draw a target path").click()
    assert page.locator(".target-sheet").is_visible()
    page.keyboard.press("Escape")
    assert not page.locator(".target-sheet").is_visible()
    assert page.evaluate(f"{STUDIO}.model.target") is None


def test_the_projector_view_is_large(studio: Window) -> None:
    page = studio.page
    small = page.evaluate(f"{STUDIO}.canvas.stage.size")
    page.get_by_label("Groups").check()
    page.keyboard.press("f")
    studio.wait_until(f"{STUDIO}.projecting.isOn")
    sizes = page.evaluate(
        """() => [...document.querySelectorAll(".shell *")]
             .filter((one) => one.getClientRects().length && !one.closest("option, optgroup"))
             .filter((one) => [...one.childNodes].some((own) => own.data?.trim()))
             .map((one) => {
               const { a, b } = one.getCTM?.() ?? { a: 1, b: 0 };
               const size = parseFloat(getComputedStyle(one).fontSize);
               return [one.textContent, size * Math.hypot(a, b)];
             })"""
    )
    # Of visually hidden text the size does not count.
    told = page.evaluate("document.querySelector('.canvas .status').textContent")
    large = {text: size for text, size in sizes if text != told}
    assert {"I", "II", "P", "20 mm"} <= large.keys()
    assert min(large.values()) >= 20, large
    assert large["crank_rocker"] == 28
    q = studio.q
    rocker = np.degrees(studio.mechanism.solve(q).link("rocker").value)
    assert large[f"{rocker:.1f}°"] == 44
    assert page.evaluate(f"{STUDIO}.canvas.stage.size") == pytest.approx(1.6 * small)
    assert page.locator(".panel").is_hidden()
    # Another number is chosen, and the crank slides.
    page.get_by_label("Number shown").select_option("P.place")
    slider = page.get_by_role("slider", name="crank")
    box = slider.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + box["height"] / 2)
    # The knob, 28 px wide, ends at the ends.
    part = (0.75 * box["width"] - 14) / (box["width"] - 28)
    assert studio.q == pytest.approx(2 * np.pi * part, abs=0.02)
    x, y = 1000 * studio.mechanism.solve(studio.q).joint("P").value
    number = page.locator(".projector-number").inner_text()
    assert number == f"{x:#.3g}, {y:#.3g} mm".replace("-", "−")
    page.keyboard.press("Escape")
    studio.wait_until(f"!{STUDIO}.projecting.isOn")
    assert page.locator(".panel").is_visible()
    assert page.evaluate(f"{STUDIO}.canvas.stage.size") == pytest.approx(small)
    page.get_by_label("Groups").uncheck()


def test_several_drivers_slide_each(browser: Browser) -> None:
    with window(browser, example="five_bar") as studio:
        studio.settle()
        page = studio.page
        page.keyboard.press("f")
        sliders = page.locator(".projector-slider input")
        studio.wait_until("!document.querySelector('.projector-slider input:disabled')")
        assert sliders.count() == 2
        held = page.evaluate(f"{STUDIO}.model.held")
        second = sliders.nth(1)
        low, high = (float(second.get_attribute(end) or 0) for end in ("min", "max"))
        step = 0.1 * (high - low) * (1 if held[1] < (low + high) / 2 else -1)
        second.evaluate(
            "(one, q) => { one.value = q; one.dispatchEvent(new Event('input')); }",
            held[1] + step,
        )
        studio.wait_until(f"{STUDIO}.model.axis === 1")
        studio.settle()
        after = page.evaluate(f"{STUDIO}.model.held")
        assert after[0] == pytest.approx(held[0], abs=1e-9)
        assert after[1] - held[1] == pytest.approx(step, rel=0.05)
        solved = studio.mechanism.solve(np.array(after))
        joint = page.evaluate(f"{STUDIO}.model.data.paths[0]")
        assert studio.place(joint) == pytest.approx(solved.joint(joint).value, abs=1e-7)


def test_the_help_opens_keeps_the_focus_and_closes(studio: Window) -> None:
    page = studio.page
    opener = page.locator(".menus").get_by_role("button", name="Help", exact=True)
    opener.click()
    dialog = page.get_by_role("dialog", name="Help")
    assert dialog.is_visible()
    inside = "document.activeElement.matches('body, dialog, dialog *')"
    for key in ("Tab",) * 8 + ("Shift+Tab",) * 8:
        page.keyboard.press(key)
        # Beyond its last control the focus is the browser's, never behind it.
        assert page.evaluate(inside)
    search = dialog.get_by_label("Search the help")
    search.fill("dead point")
    rows = dialog.locator(".help-row:visible")
    assert 1 <= rows.count() < 8
    assert "dφ/dq → ∞" in dialog.inner_text()
    search.fill("zzz")
    assert rows.count() == 0
    assert "Nothing is found" in dialog.inner_text()
    # Space writes, and does not play behind it.
    search.fill("")
    search.press(" ")
    assert not page.evaluate(f"{STUDIO}.playback.player.isPlaying")
    search.fill("")
    page.keyboard.press("Escape")
    assert dialog.count() == 0
    assert opener.evaluate("(one) => one === document.activeElement")
    page.evaluate(f"{STUDIO}.help('sensitivity')")
    assert page.evaluate("document.activeElement.dataset.term") == "sensitivity"
    page.locator("dialog").get_by_role("button", name="Close").click()
    assert dialog.count() == 0
