"""Attacks on the page: slow answers and quick hands, garbage kept, other servers, no answers."""

from __future__ import annotations

import base64
import json
import time
from typing import TYPE_CHECKING, Any

import pytest

from assur.studio.answers import answered
from assur.studio.bundle import widget_script
from assur.studio.kinds import KINDS
from assur.studio.request import parse
from assur.studio.session import Deadline, Given, Session
from studio.asking import FOUR_BAR
from studio.browser.browsing import Server, Window, window

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser

    from assur.studio.session import Answer

SLOW = """(ms) => {
  const { link } = window.assurStudio.model;
  const take = link.take.bind(link);
  link.take = (frame) => setTimeout(() => take(frame), ms);
}"""
STUDIO = "window.assurStudio"


@pytest.fixture(scope="module")
def slow(browser: Browser) -> Iterator[Window]:
    """A window whose answers come late."""
    with window(browser) as one:
        one.page.evaluate(SLOW, 120)
        yield one


@pytest.fixture
def fresh(slow: Window) -> dict[str, Any]:
    slow.open(FOUR_BAR)
    slow.page.evaluate(f"{STUDIO}.model.history.clear()")
    return slow.document


def hold(one: Window, joint: str, by: tuple[float, float]) -> None:
    """Drag a joint and keep it."""
    x, y = one.joint_px(joint)
    one.page.mouse.move(x, y)
    one.page.mouse.down()
    one.page.mouse.move(x + by[0], y + by[1], steps=3)
    one.page.wait_for_timeout(200)


def undone(one: Window) -> int:
    """Undo all there is, and say how many steps it was."""
    count = 0
    while one.page.evaluate(f"{STUDIO}.model.history.canUndo"):
        one.page.evaluate(f"{STUDIO}.model.undo()")
        count += 1
    one.settle()
    return count


def test_escape_and_at_once_another_drag(slow: Window, fresh: dict[str, Any]) -> None:
    hold(slow, "C", (30.0, 0.0))
    slow.page.mouse.move(*slow.joint_px("C"))
    slow.page.keyboard.press("Escape")
    slow.page.mouse.up()
    hold(slow, "D", (20.0, 0.0))
    slow.page.mouse.up()
    slow.settle()
    assert "coupler.length" not in slow.document["dimensions"]
    assert undone(slow) == 1
    assert slow.document == fresh


def test_two_quick_drags_are_two_steps(slow: Window, fresh: dict[str, Any]) -> None:
    x, y = slow.joint_px("C")
    slow.drag((x, y), (x + 30.0, y))
    slow.drag(slow.joint_px("D"), (slow.joint_px("D")[0] + 20.0, slow.joint_px("D")[1]))
    slow.settle()
    assert slow.joint_px("C") == pytest.approx((x + 30.0, y), abs=0.1)
    assert undone(slow) == 2
    assert slow.document == fresh


@pytest.mark.parametrize(
    ("act", "steps"),
    [
        ("model.undo()", 0),
        ("model.open({ example: 'watt_1' })", 1),
        ("begin()", 1),
        ("speak('de')", 1),
    ],
)
def test_something_else_in_the_midst_of_a_drag(
    slow: Window, fresh: dict[str, Any], act: str, steps: int
) -> None:
    hold(slow, "C", (30.0, 0.0))
    slow.page.evaluate(f"{{ {STUDIO}.{act} }}")
    x, y = slow.joint_px("C") if "begin" not in act and "open" not in act else (700.0, 300.0)
    slow.page.mouse.move(x + 9.0, y + 9.0, steps=3)
    slow.page.mouse.up()
    slow.settle()
    slow.page.evaluate(f"{STUDIO}.speak('en')")
    assert undone(slow) == steps
    assert slow.document == fresh


def test_garbage_that_the_browser_kept(browser: Browser) -> None:
    loads = {"document": {**FOUR_BAR, "loads": [None]}, "held": ["x"], "target": {"points": [1]}}
    server = Server()
    try:
        for kept in ({"document": None}, loads):
            own = json.dumps(json.dumps({**kept, "stamp": None}))
            context = browser.new_context()
            # Once: what the page then keeps is its own.
            put = f"localStorage.getItem('x') ?? localStorage.setItem('assur-studio', {own})"
            context.add_init_script(f"{put}; localStorage.setItem('x', 1)")
            one = object.__new__(Window)
            one.context, one.server, one.complaints, one.requests = context, server, [], []
            one.page = one.another()
            one.settle()
            assert one.page.evaluate(f"{STUDIO}.model.title") == "crank_rocker"
            one.close()
    finally:
        server.stop()


def test_a_slider_that_tells_no_change(slow: Window, fresh: dict[str, Any]) -> None:
    """Browsers tell none if the value was put back while it was pressed: letting go is enough."""
    slow.page.evaluate(
        """() => {
             const range = document.querySelector(".slider input[type=range]");
             range.value = String((Number(range.min) + 3 * Number(range.max)) / 4);
             range.dispatchEvent(new Event("input", { bubbles: true }));
             range.dispatchEvent(new PointerEvent("pointerup", { bubbles: true }));
           }"""
    )
    slow.settle()
    assert undone(slow) == 1
    assert slow.document == fresh


def test_undo_by_key_ends_a_drag_that_nobody_ends(slow: Window, fresh: dict[str, Any]) -> None:
    slow.page.evaluate(f"{{ {STUDIO}.model.previews.begin(); {STUDIO}.canvas.picture.focus() }}")
    slow.page.evaluate(
        f"{STUDIO}.model.previews.show({{ ...{STUDIO}.model.document, driver: 'rocker' }})"
    )
    slow.page.keyboard.press("Control+z")
    slow.settle()
    assert slow.document == fresh


def test_a_server_with_another_token(browser: Browser) -> None:
    server = Server()
    one = Window(browser, server, "wide", dark=False)
    hold(one, "C", (20.0, 0.0))
    one.wait_until(f"{STUDIO}.model.link.isQuiet")
    before = one.document
    server.stop()
    one.page.mouse.up()
    server.token = "another"
    server.again()
    one.page.get_by_text("open the address that it printed").wait_for()
    assert one.document == before
    assert not one.page.evaluate(f"{STUDIO}.model.isDragging")
    # The new address lets this window in too.
    second = one.another()
    one.wait_until(f"{STUDIO}.model.link.isOpen")
    assert second.evaluate(f"{STUDIO}.model.document") == before
    assert one.page.locator(".notice.offline").count() == 0
    server.stop()
    one.context.close()


def test_one_window_too_many_is_told(browser: Browser, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("assur.studio.connection.MOST_CONNECTIONS", 1)
    with window(browser) as one:
        second = one.context.new_page()
        second.goto(one.server.address)
        second.get_by_text("windows are open already").wait_for()
        one.page.close()
        one.ready(second)


def test_more_than_the_server_takes(browser: Browser, monkeypatch: pytest.MonkeyPatch) -> None:
    """No answer, or none in time: what was said of the document before is not said of this one."""
    many = {f"J{i}": [i / 7, i / 9] for i in range(9000)}
    check = KINDS["check"]

    def slowly(data: dict[str, Any], session: Session) -> Answer:
        time.sleep(0.6)
        return check(data, session)

    with window(browser) as one:
        one.open({**FOUR_BAR, "joints": {**FOUR_BAR["joints"], **many}})
        assert one.state == "unchecked"
        assert "Not checked" in (one.page.locator(".pill").text_content() or "")
        one.page.get_by_text("more than the studio takes").first.wait_for()
        one.page.evaluate(f"{STUDIO}.model.undo()")
        one.settle()
        assert one.state == "moves"
        monkeypatch.setattr("assur.studio.connection.SECONDS", 0.1)
        monkeypatch.setattr("assur.studio.workers.GRACE", 0.1)
        with monkeypatch.context() as late:
            late.setitem(KINDS, "check", slowly)
            one.open({**FOUR_BAR, "links": {**FOUR_BAR["links"], "brace": ["B", "D"]}})
            assert one.state == "unchecked"
        # Busy with what took too long; then it answers.
        one.page.evaluate(f"{{ {STUDIO}.model.look() }}")
        one.wait_until(f"{STUDIO}.model.checked.state === 'stuck'")


def test_a_speed_of_zero_and_beyond_all_numbers(slow: Window, fresh: dict[str, Any]) -> None:
    assert fresh
    slow.page.evaluate(f"{STUDIO}.playback.charts[0].choose('P.v')")
    field = slow.page.get_by_role("textbox", name="Speed of the driver")
    for typed in ("0", "-0", "1e308", "-1e308", "1e9", "1"):
        field.fill(typed)
    assert slow.page.evaluate("document.body.innerHTML.includes('NaN')") is False


def test_a_file_that_is_none_leaves_a_page_that_works(browser: Browser, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_bytes(bytes(range(256)))
    server = Server(Given(path=path))
    one = Window(browser, server, "wide", dark=False)
    one.page.get_by_text("bad.toml is not a mechanism").wait_for()
    assert one.state == "moves"
    one.close()
    server.stop()
    assert path.read_bytes() == bytes(range(256))


CELL = """async ([code, document]) => {
  const blob = new Blob([code], { type: "text/javascript" });
  const { default: widget } = await import(URL.createObjectURL(blob));
  const on = {};
  const values = { document, q: 0, height: 640 };
  const cell = window.cell = {
    get: (name) => values[name], set: (name, value) => (values[name] = value),
    save_changes: () => {},
    on: (name, act) => (on[name] = act), off: (name) => delete on[name],
    send: async ({ text }) => {
      const bytes = Uint8Array.from(atob(await window.kernel(text)), (one) => one.charCodeAt(0));
      on["msg:custom"]?.({}, [new DataView(bytes.buffer)]);
    },
    tell: (name, value) => { values[name] = value; on[`change:${name}`]?.(); },
    message: (...given) => on["msg:custom"](...given),
  };
  window.close = widget.render({ model: cell, el: window.document.body });
}"""


def test_nonsense_in_a_notebook(browser: Browser) -> None:
    def kernel(text: str) -> str:
        frame = answered(parse(text), Session(None, Deadline(5.0)))
        return base64.b64encode(frame).decode()

    complaints: list[str] = []
    page = browser.new_page()
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.expose_function("kernel", kernel)
    shown = "window.document.querySelector('.assur-explorer').studio"
    page.evaluate(CELL, [widget_script(), FOUR_BAR])
    page.wait_for_function(f"{shown}?.model.checked.state === 'moves'")
    nonsense: tuple[Any, ...] = ({}, [], 5, None, "x", {"joints": 5}, {**FOUR_BAR, "loads": [None]})
    for own in nonsense:
        page.evaluate("(own) => window.cell.tell('document', own)", own)
        page.wait_for_timeout(30)
        assert page.evaluate(f"{shown}.model.document") == FOUR_BAR
    page.get_by_text("not a description of a mechanism").wait_for()
    places: tuple[Any, ...] = (None, "x", [], {})
    for q in places:
        page.evaluate("(q) => window.cell.tell('q', q)", q)
    page.evaluate("window.cell.message({}); window.cell.message({}, []); window.cell.message(null)")
    other = {**FOUR_BAR, "driver": "rocker"}
    page.evaluate("(own) => window.cell.tell('document', own)", other)
    page.wait_for_function(f"{shown}.model.data.driver === 'rocker'")
    # Closed and opened again.
    page.evaluate("window.close(); window.document.body.replaceChildren()")
    page.evaluate(CELL, [widget_script(), FOUR_BAR])
    page.wait_for_function(f"{shown}?.model.checked.state === 'moves'")
    assert complaints == []
    page.close()
