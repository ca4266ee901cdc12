"""The page in a real browser: it plays, is dragged, and asks for nothing."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from studio_page import chain
from support.browsers import wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, Page

WIDTHS = {"wide": (1440, 900), "between": (800, 900), "narrow": (390, 844)}


class Opened:
    """A page with everything it complained about, and everything it asked for."""

    def __init__(self, browser: Browser, path: Path) -> None:
        width, height = WIDTHS["wide"]
        self._context = browser.new_context(viewport={"width": width, "height": height})
        self.page: Page = self._context.new_page()
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(path.as_uri())
        self.page.wait_for_selector(".assur .frame")

    def close(self) -> None:
        """Close it; it has neither complained nor asked for anything."""
        self._context.close()
        assert self.complaints == []
        # The file itself, and nothing else.
        assert len(self.requests) == 1
        assert self.requests[0].startswith("file:")

    @property
    def q(self) -> float:
        return float(self.page.evaluate("assurPage.player.q"))

    def px(self, joint: str) -> tuple[float, float]:
        """Return where a joint is seen."""
        x, y = self.page.evaluate(
            """(name) => {
                 const { stage, pointAt } = assurPage;
                 const { x, y } = pointAt(stage.data.joints.find((one) => one.name === name));
                 const box = stage.element.getBoundingClientRect();
                 const [px, py] = stage.view.px(x, y);
                 return [box.left + px, box.top + py];
               }""",
            joint,
        )
        return x, y

    def wait_until(self, condition: str) -> None:
        """Wait for a condition."""
        wait_until(self.page, condition, self.complaints)

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(*end, steps=8)
        self.page.mouse.up()


@contextmanager
def opening(browser: Browser, path: Path) -> Iterator[Opened]:
    """Open a page, and see at the end that it was quiet."""
    opened = Opened(browser, path)
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def crank_rocker(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("pages") / "crank_rocker.html"
    assur.examples.crank_rocker().to_html(path, speed=3.0, q=1.0)
    return path


def test_it_opens_and_plays(browser: Browser, crank_rocker: Path) -> None:
    with opening(browser, crank_rocker) as opened:
        page = opened.page
        assert page.title() == "crank_rocker"
        assert opened.q == 1.0
        assert page.locator(".assur-static").count() == 0
        page.keyboard.press(" ")
        opened.wait_until("assurPage.player.q > 1.2")
        assert page.locator(".status").text_content() == "Playing"
        page.get_by_role("button", name="Pause").click()
        assert not page.evaluate("assurPage.player.isPlaying")
        assert "Paused at" in (page.locator(".status").text_content() or "")


def test_what_is_drawn_is_where_the_mechanism_is(browser: Browser, crank_rocker: Path) -> None:
    m = assur.examples.crank_rocker()
    with opening(browser, crank_rocker) as opened:
        opened.page.evaluate("assurPage.seek(2.5)")
        drawn = np.array(
            opened.page.evaluate(
                """() => [...document.querySelectorAll("circle.joint")].map((one) => {
                     const box = one.getBoundingClientRect();
                     return [box.x + box.width / 2, box.y + box.height / 2];
                   })"""
            )
        )
        exact = np.array(m.solve(2.5).joint(list(m.joints)).value)
        scale = opened.page.evaluate("assurPage.stage.view.scale")
        # Every joint is drawn at its place, to half a px.
        places = np.array([opened.px(name) for name in m.joints])
        assert np.abs(places[:, None] - drawn).sum(axis=-1).min(axis=1).max() < 0.5
        own = (places - places[0]) / scale * [1.0, -1.0]
        assert own == pytest.approx(exact - exact[0], abs=1e-6)


def test_the_crank_is_dragged(browser: Browser, crank_rocker: Path) -> None:
    with opening(browser, crank_rocker) as opened:
        (ax, ay), (bx, by) = opened.px("A"), opened.px("B")
        radius = float(np.hypot(bx - ax, by - ay))
        opened.drag(((ax + bx) / 2.0, (ay + by) / 2.0), (ax - radius, ay - 1.0))
        assert opened.q == pytest.approx(np.pi - 1.0 / radius, abs=0.02)
        # The rocker drives too: C comes to where its circle about D is nearest to the pointer.
        (cx, cy), pivot = opened.px("C"), np.array(opened.px("D"))
        target = np.array([cx - 30.0, cy])
        opened.drag((cx, cy), (target[0], target[1]))
        arm = np.hypot(*(pivot - (cx, cy)))
        nearest = pivot + arm * (target - pivot) / np.hypot(*(target - pivot))
        assert opened.px("C") == pytest.approx(tuple(nearest), abs=0.5)


def test_the_canvas_pans_and_zooms(browser: Browser, crank_rocker: Path) -> None:
    with opening(browser, crank_rocker) as opened:
        before, q = opened.px("D"), opened.q
        opened.drag((1300.0, 400.0), (1240.0, 430.0))
        after = opened.px("D")
        assert (after[0] - before[0], after[1] - before[1]) == pytest.approx((-60.0, 30.0))
        assert opened.q == q
        opened.page.mouse.move(*after)
        opened.page.mouse.wheel(0, -200)
        opened.wait_until("assurPage.stage.view.scale > 1.3 * assurPage.stage.view.fitted")
        assert opened.px("D") == pytest.approx(after, abs=0.6)
        opened.page.get_by_role("button", name="Fit").click()
        assert opened.px("D") == pytest.approx(before, abs=0.6)


def test_keys(browser: Browser, crank_rocker: Path) -> None:
    with opening(browser, crank_rocker) as opened:
        opened.page.locator(".picture").focus()
        press = opened.page.keyboard.press
        press("ArrowRight")
        assert opened.q == pytest.approx(1.0 + np.radians(1.0))
        press("Shift+ArrowLeft")
        assert opened.q == pytest.approx(1.0 - np.radians(9.0))
        press("Home")
        assert opened.q == pytest.approx(1.0)
        assert opened.page.get_by_role("slider").get_attribute("aria-valuenow") == "57.2958"
        sentence = opened.page.locator(".picture").get_attribute("aria-label")
        assert sentence == "crank_rocker: 3 moving links, driver crank, at 57.3°"


def test_switches_points_and_diagrams(browser: Browser, crank_rocker: Path) -> None:
    m = assur.examples.crank_rocker()
    with opening(browser, crank_rocker) as opened:
        page = opened.page

        def printable(selector: str) -> int:
            return page.locator(f"{selector} >> visible=true").count()

        assert (printable(".label .name"), printable(".layer .path")) == (5, 1)
        for name, selector, count in (
            ("velocity", "path.vector.velocity", 1), ("acceleration", "path.head.acceleration", 1),
            ("positions", ".other", 12), ("groups", ".badge", 3),
            ("names", ".name >> text=/^[A-DP]$/", 0), ("paths", ".layer .path", 0),
        ):  # fmt: skip
            page.locator(f"[data-switch={name}]").click()
            assert printable(f".picture {selector}") == count, name
        speed = float(np.hypot(*m.solve(1.0).joint("P").velocity(3.0)))
        assert f"v {1e3 * speed:.0f} mm/s" in page.locator(".label").all_text_contents()
        page.get_by_text("Points").click()
        page.locator("[data-point=C]").click()
        assert printable("path.vector.velocity") == 2
        # A diagram: another quantity, its value at the cursor, and dragging drives.
        page.locator("select.title").first.select_option("rocker.omega")
        expected = float(m.solve(1.0).link("rocker").velocity(3.0))
        value = page.locator("output.value").first.text_content()
        assert value == f"{expected:.3g} rad/s".replace("-", "−")
        box = page.locator(".plot").nth(1).bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + 46 + (box["width"] - 66) / 2, box["y"] + 60)
        page.mouse.down()
        page.mouse.up()
        assert opened.q == pytest.approx(np.pi, abs=0.03)


def test_a_bad_speed_keeps_the_last_good_one(browser: Browser, crank_rocker: Path) -> None:
    with opening(browser, crank_rocker) as opened:
        field = opened.page.locator("input.number")
        field.fill("abc")
        assert field.get_attribute("aria-invalid") == "true"
        assert opened.page.evaluate("assurPage.player.speed") == 3.0
        field.fill("300")
        assert opened.page.evaluate("assurPage.player.speed") == 300.0
        assert opened.page.locator(".slower").text_content() == "shown 100 times slower"
        # Keys typed in a field are the field's.
        field.press("Home")
        assert opened.q == 1.0


def test_dead_points_are_told(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "peaucellier.html"
    assur.examples.peaucellier().to_html(path)
    with opening(browser, path) as opened:
        page = opened.page
        assert page.locator(".dial .dead").count() == 2
        warning = page.locator(".warning")
        assert not warning.is_visible()
        page.evaluate("assurPage.seek(99)")
        assert "Dead point at 96.4°: II(arm1, side1)" in (warning.text_content() or "")
        assert warning.is_visible()


def test_titles_do_no_harm(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "evil.html"
    evil = "</script><img src=x onerror=alert(1)>"
    assur.FourBar(1.0, 3.0, 2.5, 3.0).to_html(path, title=evil)
    with opening(browser, path) as opened:
        assert opened.page.locator("h1").text_content() == evil
        assert opened.page.evaluate("document.images.length") == 0
        assert opened.page.title() == evil


def test_without_scripts_there_is_the_static_picture(browser: Browser, crank_rocker: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(crank_rocker.as_uri())
    assert page.locator(".assur-static").is_visible()
    context.close()


def test_a_notebook_shows_it_in_a_root_of_its_own(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "notebook.html"
    parts = "".join(assur.examples.engine()._repr_html_() or "" for _ in range(2))
    path.write_text(f"<!doctype html><body>{parts}</body>", encoding="utf-8")
    context = browser.new_context(viewport={"width": 900, "height": 1300})
    page = context.new_page()
    complaints: list[str] = []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(path.as_uri())
    # Locators go into shadow roots.
    assert page.get_by_role("button", name="Play").count() == 2
    page.get_by_role("button", name="Play").first.click()
    assert page.get_by_role("button", name="Pause").count() == 1
    assert complaints == []
    context.close()


def test_keys_and_wheel_in_a_notebook(browser: Browser, tmp_path: Path) -> None:
    """Keys stay in the cell, but commands and what leads out; the wheel zooms with Ctrl alone."""
    path = tmp_path / "notebook.html"
    cell = assur.examples.engine()._repr_html_()
    tall = '<p style="height: 3000px"></p>'
    path.write_text(f"<!doctype html><body>{cell}{tall}</body>", encoding="utf-8")
    context = browser.new_context(viewport={"width": 1200, "height": 700})
    page = context.new_page()
    page.goto(path.as_uri())
    page.evaluate(
        """() => {
             window.heard = [];
             document.addEventListener("keydown", (event) => window.heard.push(event.key));
           }"""
    )
    picture = page.locator("svg.picture")

    def heard(*keys: str) -> list[str]:
        page.evaluate("window.heard.length = 0")
        for key in keys:
            page.keyboard.press(key)
        own: list[str] = page.evaluate("window.heard")
        return own

    letters = ("m", "a", "b", "x", "d", "z", "Enter", "Shift+Enter", "ArrowDown", "Space", "Space")
    picture.focus()
    assert heard(*letters) == []
    assert [key for key in heard("Control+s") if key != "Control"] == ["s"]
    assert heard("Escape") == ["Escape"]
    page.get_by_role("textbox").focus()
    assert [key for key in heard(*letters, "Control+a", "Escape") if key != "Control"] == []
    assert heard("Tab") == ["Tab"]

    def drawn() -> str:
        return str(picture.inner_html())

    picture.focus()
    before = drawn()
    box = picture.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2.0, box["y"] + box["height"] / 2.0)
    page.mouse.wheel(0, 120)
    page.wait_for_function("window.scrollY > 50")
    assert drawn() == before
    page.keyboard.down("Control")
    page.mouse.wheel(0, -120)
    page.keyboard.up("Control")
    wait_until(page, lambda: drawn() != before)
    context.close()


def test_every_width_and_scheme(browser: Browser, crank_rocker: Path) -> None:
    with opening(browser, crank_rocker) as opened:
        page = opened.page
        for size, (width, height) in WIDTHS.items():
            page.set_viewport_size({"width": width, "height": height})
            opened.wait_until(f"assurPage.stage.view.width === {width}")
            assert page.evaluate("document.documentElement.scrollWidth") == width
            assert page.get_by_role("button", name="Play").is_visible()
            assert page.locator(".chart").count() == 3
            heights = page.evaluate(
                """() => [...document.querySelectorAll("button, .switches .switch, summary")]
                     .map((one) => one.getBoundingClientRect().height)"""
            )
            assert min(heights) >= (43.5 if size == "narrow" else 33.5)
            assert_names_are_clear(page)
        page.emulate_media(color_scheme="dark")
        assert canvas_colour(page) == "#0F1419"
        page.emulate_media(color_scheme="light")
        assert canvas_colour(page) == "#FBFCFD"
        page.get_by_role("button", name="Light or dark").click()
        assert canvas_colour(page) == "#0F1419"


def canvas_colour(page: Page) -> str:
    colour = "getComputedStyle(document.querySelector('.assur')).getPropertyValue('--canvas')"
    return str(page.evaluate(colour))


def assert_names_are_clear(page: Page) -> None:
    """Names are clear of each other; the lines of their boxes may touch."""
    boxes = page.evaluate(
        """() => [...document.querySelectorAll(".label .name")].map((one) => {
             const { left, right, top, bottom } = one.getBoundingClientRect();
             return [left, right, top + 3, bottom - 3];
           })"""
    )
    assert len(boxes) == 5
    for i, (left, right, top, bottom) in enumerate(boxes):
        for left2, right2, top2, bottom2 in boxes[:i]:
            assert left >= right2 or right <= left2 or top >= bottom2 or bottom <= top2


def test_a_frame_of_thirty_links_takes_little_script(browser: Browser, tmp_path: Path) -> None:
    m = chain(30)
    assert len(m.links) == 30
    path = tmp_path / "thirty.html"
    m.to_html(path)
    with opening(browser, path) as opened:
        times = opened.page.evaluate(
            """() => {
                 const { player } = assurPage;
                 return [1, 2, 3].map(() => {
                   const times = [];
                   for (let i = 0; i < 100; i++) {
                     player.advance(1 / 60);
                     const start = performance.now();
                     player.show(player.q);
                     times.push(performance.now() - start);
                   }
                   return times;
                 });
               }"""
        )
        # Script alone; what the browser paints is not in it, nor are others that use the machine.
        assert np.percentile(times, 95, axis=1).min() < 8.0
