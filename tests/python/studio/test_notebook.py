"""``m.explore()``: the widget by itself, and in a real JupyterLab."""

from __future__ import annotations

import json
import os
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.studio import document
from assur.studio.bundle import widget_script
from assur.studio.frame import decode
from assur.studio.notebook import Explorer
from studio.asking import FOUR_BAR
from support.browsers import wait_until
from support.node import run_node

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, Locator, Page

# The cells of the notebook.
CELLS = (
    """\
import assur
m = assur.Mechanism({"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
    {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"}, "crank")
view = m.explore(height=560)
view""",
    'print("place", *view.mechanism.solve(view.q).joint("C").value)',
    'view.mechanism = m.with_dimensions({"rocker.length": 3.0})\nview.q = 0.7',
)


# -- by itself ---------------------------------------------------------------


class Asking:
    """What a page sends to a widget, and gets."""

    def __init__(self, view: Explorer, monkeypatch: pytest.MonkeyPatch) -> None:
        self.view = view
        self.frames: list[bytes] = []
        monkeypatch.setattr(view, "send", lambda _, buffers: self.frames.extend(buffers))

    def ask(self, text: Any) -> dict[str, Any]:
        self.view._asked(None, {"text": text}, [])
        return decode(self.frames.pop())[0]


def test_both_ways(monkeypatch: pytest.MonkeyPatch) -> None:
    m = assur.Mechanism(**{k: FOUR_BAR[k] for k in ("joints", "links", "driver")})
    view = m.explore()
    assert view.mechanism is m
    page = Asking(view, monkeypatch)
    fields = {"document": view.document, "q": 0.0, "joint": "C", "to": [4.0, 3.0]}
    answer = page.ask(json.dumps({"id": 1, "rev": 1, "kind": "drag", **fields}))
    # As anywidget does when the page sets a trait.
    view.set_state({"document": answer["document"]})
    place = view.mechanism.solve(0.0).joint("C").value
    assert place == pytest.approx([4.0, 3.0], abs=1e-9)
    view.mechanism = assur.examples.watt_1()
    assert document.read_mechanism(view.document) == assur.examples.watt_1()
    assert view.q == pytest.approx(float(assur.examples.watt_1().q0))
    press = assur.Machine(assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)})
    view.machine = press
    assert document.read_machine(view.document).mechanism == press.mechanism
    assert press.explore().machine is press


def test_what_does_not_move_is_not_taken() -> None:
    view = assur.FourBar(1.0, 3.0, 2.5, 3.0).explore()
    before = view.mechanism
    for broken in ({}, {"joints": 3}, {**view.document, "driver": "rod"}):
        view.set_state({"document": broken})
        assert view.mechanism is before


def test_malformed_requests_are_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    page = Asking(assur.FourBar(1.0, 3.0, 2.5, 3.0).explore(), monkeypatch)
    for text in ("", "{", None, 5, "[]", '{"id": 1}', '{"id": 1, "rev": 1, "kind": "rm"}'):
        assert page.ask(text)["error"]["kind"] == "malformed"
    # No file is within its reach.
    opened = page.ask(json.dumps({"id": 1, "rev": 1, "kind": "open", "file": True}))
    assert "without a file" in opened["error"]["message"]


def test_what_is_not_shown() -> None:
    batch = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"rocker.length": [2.5, 3.0]})
    with pytest.raises(assur.InputError, match=r"batch \(2,\)"):
        batch.explore()
    with pytest.raises(assur.InputError, match="not int"):
        Explorer(5)  # type: ignore[arg-type]


def test_without_anywidget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "assur.studio.notebook")
    with pytest.raises(assur.InputError, match=r"pip install assur\[notebook\]"):
        assur.FourBar(1.0, 3.0, 2.5, 3.0).explore()


def test_the_bundle_is_a_module(tmp_path: Path) -> None:
    path = tmp_path / "widget.mjs"
    path.write_text(widget_script(), encoding="utf-8")
    run_node("--check", str(path))
    assert "import {" not in widget_script()


# -- in JupyterLab -----------------------------------------------------------


@contextmanager
def jupyter(folder: Path) -> Iterator[str]:
    """Run a JupyterLab with a notebook of the cells; yield its address."""
    code: dict[str, Any] = {
        "cell_type": "code",
        "execution_count": None,
        "metadata": {},
        "outputs": [],
    }
    cells = [{**code, "id": f"c{i}", "source": text} for i, text in enumerate(CELLS)]
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = {"cells": cells, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}
    (folder / "explore.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    folders = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
    own = {name: str(folder / name) for name in folders}
    command = [
        sys.executable, "-m", "jupyterlab", "--no-browser", f"--port={port}", "--allow-root",
        "--IdentityProvider.token=", "--ServerApp.password=", f"--ServerApp.root_dir={folder}",
        "--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]  # fmt: skip
    with (folder / "log.txt").open("w") as log:
        running = subprocess.Popen(
            command, stdout=log, stderr=log, cwd=folder, env={**os.environ, **own}
        )
    address = f"http://127.0.0.1:{port}"
    try:
        for _ in range(300):
            try:
                urllib.request.urlopen(f"{address}/api", timeout=5).close()
                break
            except OSError:
                time.sleep(0.1)
        else:
            pytest.fail((folder / "log.txt").read_text())
        yield f"{address}/lab/tree/explore.ipynb?reset"
    finally:
        running.terminate()
        running.wait(20)


def in_widget(page: Page, expression: str) -> Any:
    """Evaluate an expression of `studio`."""
    return page.evaluate(
        f"(() => {{ const {{ studio }} = document.querySelector('.assur-explorer');"
        f" return {expression}; }})()"
    )


def run_cell(page: Page, i: int) -> None:
    """Run a cell; a notebook that is still opening takes no notice of keys."""
    cell = page.locator(".jp-CodeCell").nth(i)
    prompt = cell.locator(".jp-InputPrompt")
    before = prompt.text_content()
    for _ in range(10):
        cell.locator(".cm-content").click()
        page.keyboard.press("Control+Enter")
        for _ in range(100):
            if prompt.text_content() != before:
                return
            page.wait_for_timeout(30)
    pytest.fail(f"cell {i} does not run")


@pytest.fixture(scope="module")
def notebook(
    browser: Browser, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Page, Path, list[str]]]:
    """Open the notebook in one JupyterLab; yield its page, its file and the failures of scripts."""
    pytest.importorskip("jupyterlab", reason="JupyterLab is not installed: no test in a notebook")
    folder = tmp_path_factory.mktemp("jupyter")
    with jupyter(folder) as address:
        page = browser.new_page(viewport={"width": 1300, "height": 1000})
        errors: list[str] = []
        page.on("pageerror", lambda error: errors.append(str(error.stack or error)))

        def accept(asked: Locator) -> None:
            asked.locator("button").last.click()

        # On a slow machine JupyterLab may ask for a kernel, or say that it waits.
        page.add_locator_handler(page.locator(".jp-Dialog"), accept)
        page.goto(address)
        page.locator(".jp-CodeCell").nth(2).wait_for(timeout=60_000)
        page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for(timeout=60_000)
        yield page, folder / "explore.ipynb", errors
        page.close()


@pytest.fixture
def explored(notebook: tuple[Page, Path, list[str]]) -> Iterator[Page]:
    """Run the first cell and wait for a new widget; no script may fail."""
    page, _, errors = notebook
    page.evaluate("document.querySelector('.assur-explorer')?.setAttribute('data-old', '')")
    run_cell(page, 0)
    page.locator(".assur-explorer:not([data-old]) .picture").wait_for(timeout=60_000)
    page.locator(".assur-explorer[data-old]").wait_for(state="detached")
    wait_until(page, "document.querySelector('.assur-explorer').studio?.model.moves === true")
    page.locator(".assur-explorer").scroll_into_view_if_needed()
    yield page
    assert errors == []


def cells(page: Page) -> list[str]:
    """Return the kinds and prompts of the notebook's cells."""
    own: list[str] = page.evaluate(
        """() => [...document.querySelectorAll(".jp-Notebook .jp-Cell")].map(
             (one) => `${one.className.match(/jp-(Code|Markdown|Raw)Cell/)[0]} `
               + (one.querySelector(".jp-InputPrompt")?.textContent ?? ""))"""
    )
    return own


def test_keys_stay_in_the_cell(explored: Page, notebook: tuple[Page, Path, list[str]]) -> None:
    page, written = explored, notebook[1]
    before = cells(page)
    picture = page.locator(".assur-explorer .picture")
    box = picture.bounding_box()
    assert box is not None
    keys = [
        "m",
        "y",
        "a",
        "b",
        "x",
        "c",
        "v",
        "z",
        "d",
        "d",
        "1",
        "Enter",
        "Shift+Enter",
        "Shift+M",
    ]
    places: dict[str, Any] = {
        "picture": lambda: page.mouse.click(box["x"] + 30.0, box["y"] + box["height"] / 2.0),
        "tab": page.locator(".assur-explorer .tab:visible").first.click,
        "text": page.locator(".assur-explorer .section h2:visible").first.click,
        "field": page.get_by_role("textbox", name="Speed of the driver").click,
    }
    for name, click in places.items():
        if name == "field":
            page.locator(".assur-explorer .tab[data-tab=diagrams]").click()
        click()
        for key in keys:
            page.keyboard.press(key)
        page.wait_for_timeout(150)
        assert cells(page) == before, name
        assert picture.is_visible()
        page.keyboard.press("Escape")
    # A word typed in a field is in it, and edited there.
    field = page.get_by_role("textbox", name="Speed of the driver")
    field.fill("")
    field.press_sequentially("2 rpm")
    field.press("Control+a")
    field.press_sequentially("30 rpm")
    assert field.input_value() == "30 rpm"
    assert cells(page) == before
    field.press("Enter")
    wait_until(
        page, "document.querySelector('.assur-explorer').studio.model.document.input_speed > 3"
    )
    # Ctrl S saves the notebook, and gives no file of the mechanism.
    stamp = written.stat().st_mtime_ns
    downloads: list[str] = []
    page.on("download", lambda one: downloads.append(one.url))
    picture.focus()
    page.keyboard.press("Control+s")
    wait_until(page, lambda: written.stat().st_mtime_ns != stamp)
    assert downloads == []
    # Escape is the notebook's where there is nothing to end here.
    page.evaluate("document.addEventListener('keydown', ({ key }) => (window.last = key))")
    page.keyboard.press("Escape")
    assert page.evaluate("window.last") == "Escape"


def test_the_wheel_scrolls_and_zooms_with_ctrl(explored: Page) -> None:
    page = explored
    box = page.locator(".assur-explorer .picture").bounding_box()
    assert box is not None
    scale = "studio.canvas.stage.view.scale"
    before = in_widget(page, scale)
    top = "document.querySelector('.assur-explorer').getBoundingClientRect().top"
    page.mouse.click(box["x"] + 30.0, box["y"] + box["height"] / 2.0)
    page.mouse.wheel(0, 100)
    own = page.evaluate(top)
    page.wait_for_timeout(300)
    moved = page.evaluate(top)
    page.mouse.wheel(0, -100)
    page.wait_for_timeout(300)
    assert in_widget(page, scale) == before
    assert own != moved or page.evaluate(top) != moved
    page.get_by_text("Ctrl and the wheel zoom.").wait_for()
    page.keyboard.down("Control")
    page.mouse.wheel(0, -100)
    page.keyboard.up("Control")
    wait_until(page, lambda: in_widget(page, scale) > before)


def test_in_a_real_jupyter(explored: Page) -> None:
    page = explored
    # A joint that is dragged changes the mechanism of the kernel.
    start = in_widget(
        page,
        "(() => { const { stage } = studio.canvas; const box ="
        " stage.element.getBoundingClientRect(); const [x, y] = stage.view.px(4.1, 3.2);"
        " return [box.left + x, box.top + y]; })()",
    )
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 30, start[1] - 20, steps=6)
    page.mouse.up()
    wait_until(
        page,
        "(({ model }) => model.document.dimensions && !model.isDragging"
        " && model.link.isQuiet)(document.querySelector('.assur-explorer').studio)",
    )
    page.wait_for_timeout(400)
    shown = in_widget(
        page,
        "(() => { const { pose } = studio.playback; const joint ="
        " studio.canvas.stage.data.joints.find((one) => one.name === 'C');"
        " const i = 3 * joint.link, [a, b] = joint.at, v = pose.value,"
        " c = Math.cos(v[i + 2]), s = Math.sin(v[i + 2]);"
        " return [v[i] + c * a - s * b, v[i + 1] + s * a + c * b]; })()",
    )
    run_cell(page, 1)
    out = page.locator(".jp-CodeCell").nth(1).locator(".jp-OutputArea-output")
    out.get_by_text("place").wait_for()
    place = [float(word) for word in (out.text_content() or "").split()[1:]]
    assert place == pytest.approx(shown, abs=1e-5)
    assert np.hypot(place[0] - 4.1, place[1] - 3.2) > 0.1

    # A mechanism that is assigned is drawn.
    run_cell(page, 2)
    wait_until(
        page,
        "document.querySelector('.assur-explorer').studio.model.document"
        ".dimensions['rocker.length'] === 3",
    )
    wait_until(page, "document.querySelector('.assur-explorer').studio.playback.q === 0.7")
