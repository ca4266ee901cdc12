"""The studio in a real browser: it opens, plays, is dragged, undone, saved, and loses nothing."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur.studio import document
from studio.asking import FOUR_BAR
from studio.browser.browsing import WIDTHS, Server, Window, window
from support.samples import IS_CAMPAIGN

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "four_bar.toml"
    path.write_text(document.toml_of(FOUR_BAR), encoding="utf-8")
    return path


def joints_in_python(one: Window) -> dict[str, np.ndarray]:
    m = one.mechanism
    motion = m.solve(one.q)
    return {name: motion.joint(name).value for name in m.joints}


def assert_drawn_as_solved(one: Window, tolerance: float = 1e-6) -> None:
    """Every joint is drawn where Python says that it is."""
    for name, place in joints_in_python(one).items():
        assert one.place(name) == pytest.approx(tuple(place), abs=tolerance)


def test_it_opens_and_plays_without_the_server(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        assert one.page.get_by_role("textbox", name="untitled").input_value() == "four_bar"
        assert "Moves" in (one.page.locator(".pill").text_content() or "")
        assert_drawn_as_solved(one)
        # From now on nothing is sent.
        one.page.evaluate(
            """() => {
                 const { carrier } = window.assurStudio.model.link;
                 const { send } = carrier;
                 window.sent = [];
                 carrier.send = (text) => (window.sent.push(JSON.parse(text).kind), send(text));
               }"""
        )
        one.page.keyboard.press(" ")
        q = one.q
        one.wait_until(f"Math.abs(window.assurStudio.playback.q - {q}) > 0.3")
        # The panel asks for numbers that it has not; the picture and the diagrams ask for nothing.
        kinds = set(one.page.evaluate("window.sent"))
        assert kinds <= {"position", "assemblies", "sensitivity"}
        one.button("Pause").click()
        assert_drawn_as_solved(one)


def test_a_joint_is_dragged_and_its_dimensions_follow(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        before = one.document
        x, y = one.joint_px("C")
        one.drag((x, y), (x + 40.0, y - 25.0))
        one.settle()
        after = one.document
        changed = set(after["dimensions"]) - set(before.get("dimensions", {}))
        assert changed <= {"coupler.length", "rocker.length", "coupler.P.x", "coupler.P.y"}
        assert {"coupler.length", "rocker.length"} <= changed
        assert one.joint_px("C") == pytest.approx((x + 40.0, y - 25.0), abs=0.1)
        assert_drawn_as_solved(one)
        # One gesture is one step.
        one.button("Undo").click()
        one.settle()
        assert one.document == before
        assert one.joint_px("C") == pytest.approx((x, y), abs=0.1)
        assert one.button("Undo").is_disabled()
        one.button("Redo").click()
        one.settle()
        assert one.document == after


# The nearest circle of a joint, px from a place of the window.
NEAREST = """([x, y]) => {
  const distance = (one) => {
    const box = one.getBoundingClientRect();
    return Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y);
  };
  return Math.min(...[...document.querySelectorAll(".picture circle.joint")].map(distance));
}"""
# Answers to `drag` wait until they are let through.
HOLD = """() => {
  const { link } = window.assurStudio.model;
  const ask = link.ask.bind(link);
  const gate = new Promise((resolve) => (window.letThrough = resolve));
  link.ask = async (kind, ...rest) => {
    if (kind === "drag") await gate;
    return ask(kind, ...rest);
  };
}"""


@pytest.mark.parametrize("joint", ["C", "D"])
def test_a_joint_is_under_the_hand_before_the_server_answers(
    browser: Browser, file: Path, joint: str
) -> None:
    with window(browser, file) as one:
        one.page.evaluate(HOLD)
        before = one.document
        x, y = one.joint_px(joint)
        to = (x + 30.0, y - 20.0)

        def drag() -> None:
            one.page.mouse.move(x, y)
            one.page.mouse.down()
            one.page.mouse.move(*to, steps=4)
            one.page.wait_for_timeout(50)

        drag()
        assert one.document == before
        assert one.page.evaluate(NEAREST, to) < 1.0
        assert one.page.evaluate(NEAREST, (x, y)) > 10.0
        one.page.keyboard.press("Escape")
        one.page.mouse.up()
        assert one.page.evaluate(NEAREST, (x, y)) < 0.1
        drag()
        one.page.evaluate("window.letThrough()")
        one.page.mouse.up()
        one.settle()
        assert one.document != before
        assert one.joint_px(joint) == pytest.approx(to, abs=0.1)
        assert one.page.evaluate(NEAREST, to) < 0.1
        assert_drawn_as_solved(one)


def test_what_cannot_be_is_not_drawn(browser: Browser, file: Path) -> None:
    """Where no mechanism has the joint, the last one that does stays."""
    with window(browser, file) as one:
        one.page.evaluate(
            """() => {
                 const { link } = window.assurStudio.model;
                 const ask = link.ask.bind(link);
                 link.ask = async (kind, ...rest) => {
                   if (kind === "drag") throw new Error("there is none");
                   return ask(kind, ...rest);
                 };
               }"""
        )
        before = one.document
        x, y = one.joint_px("C")
        one.page.mouse.move(x, y)
        one.page.mouse.down()
        for i in range(4):
            one.page.mouse.move(x + 10.0 * (i + 1), y)
            one.page.wait_for_timeout(30)
            assert one.page.evaluate(NEAREST, (x, y)) < 0.1
        assert "there is none" in one.page.locator(".warning").inner_text()
        one.page.mouse.up()
        one.settle()
        assert one.document == before
        assert one.page.evaluate(NEAREST, (x, y)) < 0.1


def test_escape_ends_a_gesture_as_if_it_had_not_begun(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        before = one.document
        x, y = one.joint_px("D")
        one.page.mouse.move(x, y)
        one.page.mouse.down()
        one.page.mouse.move(x + 60.0, y - 30.0, steps=5)
        one.wait_until("window.assurStudio.model.document.dimensions !== undefined")
        one.page.keyboard.press("Escape")
        one.page.mouse.up()
        one.settle()
        assert one.document == before
        assert one.button("Undo").is_disabled()
        assert_drawn_as_solved(one)


def test_it_plays_on_while_a_joint_is_dragged(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        one.page.keyboard.press(" ")
        x, y = one.joint_px("D")
        q = one.q
        one.page.mouse.move(x, y)
        one.page.mouse.down()
        for i in range(20):
            one.page.mouse.move(x + i, y - i / 2.0)
            one.page.wait_for_timeout(10)
        one.page.mouse.up()
        one.settle()
        assert one.q != q
        assert one.page.evaluate("window.assurStudio.playback.player.isPlaying")
        one.button("Pause").click()
        assert one.joint_px("D") == pytest.approx((x + 19.0, y - 9.5), abs=1.0)
        assert_drawn_as_solved(one)


def test_a_quick_drag_never_has_two_requests_under_way(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        x, y = one.joint_px("C")
        one.page.evaluate(
            """() => {
                 const { model } = window.assurStudio;
                 const ask = model.link.ask.bind(model.link);
                 window.most = window.under = 0;
                 model.link.ask = async (kind, ...rest) => {
                   if (kind !== "drag") return ask(kind, ...rest);
                   window.most = Math.max(window.most, (window.under += 1));
                   try { return await ask(kind, ...rest); } finally { window.under -= 1; }
                 };
               }"""
        )
        one.page.evaluate(
            """async ([x, y]) => {
                 const { picture } = window.assurStudio.canvas;
                 const at = (type, i) => picture.dispatchEvent(new PointerEvent(type, {
                   clientX: x + 30 * Math.sin(i / 60), clientY: y - 30 * (1 - Math.cos(i / 60)),
                   pointerId: 1, bubbles: true, button: 0, pointerType: "mouse",
                 }));
                 picture.setPointerCapture = () => {};
                 at("pointerdown", 0);
                 const end = performance.now() + 500;
                 let i = 0;
                 while (performance.now() < end) {
                   for (let k = 0; k < 10; k++) at("pointermove", i++);
                   await new Promise((resolve) => setTimeout(resolve, 10));
                 }
                 at("pointermove", 100);
                 at("pointerup", 100);
               }""",
            [x, y],
        )
        one.settle()
        assert one.page.evaluate("window.most") == 1
        last = (x + 30.0 * np.sin(100 / 60), y - 30.0 * (1.0 - np.cos(100 / 60)))
        assert one.joint_px("C") == pytest.approx(last, abs=0.2)
        assert_drawn_as_solved(one)


def test_the_crank_is_dragged(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        (ax, ay), (bx, by) = one.joint_px("A"), one.joint_px("B")
        radius = float(np.hypot(bx - ax, by - ay))
        one.drag(((ax + bx) / 2.0, (ay + by) / 2.0), (ax - radius, ay - 1.0))
        assert one.q == pytest.approx(np.pi, abs=0.05)
        assert one.button("Undo").is_disabled()


def test_examples_and_undo_across_them(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        own = one.document
        one.example("jansen_leg")
        assert_drawn_as_solved(one)
        one.example("excavator")
        assert one.page.evaluate("window.assurStudio.model.held.length") == 3
        one.button("Undo").click()
        one.button("Undo").click()
        one.settle()
        assert one.document == own
        assert_drawn_as_solved(one)


# Every third; `make campaign` opens all.
ALL = sorted(assur.examples.ALL)
SHOWN = ALL if IS_CAMPAIGN else ALL[::3]


@pytest.mark.parametrize("name", SHOWN)
def test_every_example_is_drawn_as_it_is_solved(example_window: Window, name: str) -> None:
    one = example_window
    one.page.evaluate("(example) => window.assurStudio.model.open({ example })", name)
    one.settle()
    assert one.state == "moves"
    m = one.mechanism
    held = one.page.evaluate("window.assurStudio.model.place")
    motion = m.solve(held if isinstance(held, float | int) else [held])
    size = float(np.ptp(np.array(list(m.joints.values())), axis=0).max())
    for joint in m.joints:
        exact = np.array(motion.joint(joint).value).reshape(-1)
        assert one.place(joint) == pytest.approx(tuple(exact), abs=2e-6 * size)


@pytest.fixture(scope="module")
def example_window(browser: Browser) -> Iterator[Window]:
    with window(browser) as one:
        yield one


def test_saving(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        note = one.page.locator(".bar .note").first
        assert note.text_content() == "saved"
        x, y = one.joint_px("P")
        one.drag((x, y), (x + 20.0, y))
        one.settle()
        assert note.text_content() == "not saved"
        one.button("Open").click()
        one.page.get_by_role("menuitem", name="Save").click()
        one.wait_until("document.querySelector('.bar .note').textContent === 'saved'")
        again = assur.load(file)
        assert isinstance(again, assur.Mechanism)
        own = one.mechanism
        assert again.dimensions == own.dimensions
        # Another program changes it: nobody's work is lost without a question.
        file.write_text(document.toml_of({**FOUR_BAR, "driver": "rocker"}), encoding="utf-8")
        one.drag(one.joint_px("P"), (x, y))
        one.settle()
        one.button("Open").click()
        one.page.get_by_role("menuitem", name="Save").click()
        one.page.get_by_text("has changed since it was opened").wait_for()
        assert "rocker" in file.read_text(encoding="utf-8").partition("\n")[0] + file.read_text()
        one.button("Save over it").click()
        one.wait_until("document.querySelector('.bar .note').textContent === 'saved'")
        last = assur.load(file)
        assert isinstance(last, assur.Mechanism)
        assert last.dimensions == one.mechanism.dimensions


def test_two_windows_on_one_file(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        second = one.another()
        second.get_by_text("open in another window").wait_for()
        second.get_by_role("button", name="Work on a copy").click()
        assert second.evaluate("window.assurStudio.model.file") is None


def test_what_was_not_saved_comes_back(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        before = one.document
        x, y = one.joint_px("C")
        one.drag((x, y), (x + 20.0, y))
        one.settle()
        after = one.document
        one.page.reload()
        one.ready()
        one.settle()
        assert one.document == after
        one.button("Undo").click()
        one.settle()
        assert one.document == before


def test_a_new_window_goes_on_with_what_was_drawn(browser: Browser) -> None:
    with window(browser) as one:
        one.open(FOUR_BAR, "mine")
        one.wait_until_kept()
        second = one.another()
        one.wait_until("window.assurStudio.model.title === 'mine'", second)
        assert second.evaluate("window.assurStudio.model.document") == FOUR_BAR


def test_files_that_are_no_mechanism(browser: Browser, file: Path, tmp_path: Path) -> None:
    cases = {
        "notes.txt": (b"a shopping list", "notes.txt is not a mechanism"),
        "picture.toml": (bytes(range(256)), "picture.toml is not a mechanism"),
        "huge.toml": (b"#" * 3_000_000, "the studio opens files up to"),
        "half.toml": (b'format = "assur 1"\ndriver = "crank"\n', "half.toml is not a mechanism"),
        "nan.toml": (
            document.toml_of(FOUR_BAR).replace("4.8", "nan").encode(),
            "nan.toml is not a mechanism",
        ),
    }
    with window(browser, file) as one:
        before = one.document
        for name, (content, message) in cases.items():
            path = tmp_path / name
            path.write_bytes(content)
            one.button("Open").click()
            with one.page.expect_file_chooser() as chosen:
                one.page.get_by_role("menuitem", name="Open a file").click()
            chosen.value.set_files(path)
            one.page.locator(".notice", has_text=message).wait_for()
            assert one.document == before
        path = tmp_path / "other.toml"
        assur.examples.watt_1().save(path)
        one.button("Open").click()
        with one.page.expect_file_chooser() as chosen:
            one.page.get_by_role("menuitem", name="Open a file").click()
        chosen.value.set_files(path)
        one.wait_until("window.assurStudio.model.title === 'other'")
        one.settle()
        assert_drawn_as_solved(one)


def test_a_lost_connection(browser: Browser) -> None:
    server = Server()
    one = Window(browser, server, "wide", dark=False)
    one.page.keyboard.press(" ")
    server.stop()
    one.page.get_by_text("The connection is lost").wait_for()
    q = one.q
    one.wait_until(f"window.assurStudio.playback.q !== {q}")
    before = one.document
    x, y = one.joint_px("D")
    one.drag((x, y), (x + 40.0, y))
    assert one.document == before
    server.again()
    one.wait_until("window.assurStudio.model.link.isOpen")
    one.button("Pause").click()
    x, y = one.joint_px("D")
    one.drag((x, y), (x + 40.0, y))
    one.settle()
    assert one.document != before
    assert_drawn_as_solved(one)
    assert one.page.locator(".notice.offline").count() == 0
    server.stop()
    one.context.close()
    # The browser itself says that it cannot connect; nothing else is said.
    own = ("WebSocket connection", "ERR_CONNECTION_REFUSED")
    assert all(any(part in text for part in own) for text in one.complaints), one.complaints


@pytest.mark.parametrize("what", ["TOML", "SVG", "DXF", "CSV", "HTML"])
def test_taking_it_away(browser: Browser, file: Path, tmp_path: Path, what: str) -> None:
    with window(browser, file) as one:
        one.button("Export").click()
        with one.page.expect_download() as got:
            one.page.get_by_role("menuitem", name=what).click()
        path = tmp_path / got.value.suggested_filename
        got.value.save_as(path)
        text = path.read_text(encoding="utf-8")
        if what == "TOML":
            assert assur.files.read(path).mechanism.dimensions == one.mechanism.dimensions
        elif what == "CSV":
            rows = np.genfromtxt(path, delimiter=",", names=True)
            assert len(rows) == 361
        else:
            start = {"SVG": "<?xml", "DXF": "  0", "HTML": "<!doctype html>"}[what]
            assert text.startswith(start)


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("dark", [False, True])
def test_every_width_and_scheme(browser: Browser, file: Path, width: str, dark: bool) -> None:
    with window(browser, file, width=width, dark=dark) as one:
        page = one.page
        assert page.evaluate("document.documentElement.scrollWidth") <= WIDTHS[width][0]
        box = page.locator(".picture").bounding_box()
        assert box is not None
        assert box["height"] > 0.3 * WIDTHS[width][1]
        colour = page.evaluate(
            "getComputedStyle(document.querySelector('.assur')).getPropertyValue('--canvas')"
        )
        assert colour == ("#0F1419" if dark else "#FBFCFD")
        small = page.evaluate(
            """() => [...document.querySelectorAll("button, select, [role=tab]")].filter((one) => {
                 const { width, height } = one.getBoundingClientRect();
                 return width > 0 && Math.min(width, height) < 44;
               }).map((one) => one.className + " " + one.textContent)"""
        )
        assert width != "narrow" or small == []
        # Everything that can be used has a name.
        nameless = page.evaluate(
            """() => [...document.querySelectorAll("button, input, select, [role=slider]")]
                 .filter((one) => one.offsetParent !== null)
                 .filter((one) => !(one.getAttribute("aria-label") || one.labels?.length
                   || one.textContent.trim())).map((one) => one.outerHTML)"""
        )
        assert nameless == []


@pytest.mark.parametrize("code", ["de", "ru", "uk"])
def test_languages(browser: Browser, file: Path, code: str) -> None:
    words = {"de": "Laufgrad 1", "ru": "степень подвижности 1", "uk": "ступінь рухомості 1"}
    with window(browser, file) as one:
        one.seek(1.0)
        one.page.evaluate("(code) => window.assurStudio.speak(code)", code)
        one.settle()
        assert words[code] in (one.page.locator(".pill").text_content() or "")
        assert one.q == pytest.approx(1.0)
        assert one.page.evaluate("document.documentElement.lang") == code
        x, y = one.joint_px("C")
        one.drag((x, y), (x + 20.0, y))
        one.settle()
        assert json.dumps(one.document) != json.dumps(FOUR_BAR)
