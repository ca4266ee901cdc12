"""How quick the studio is in a real browser: frames while it plays, and a drag until it is seen.

``python benches/python/studio_page.py`` prints medians and 95th percentiles for 4, 10 and 30 links;
``--minutes 30`` plays and drags for so long and prints the memory of both sides.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Page

LINKS = (4, 10, 30)
FRAMES, DRAGS = 300, 200
# Of the page's own work: from the clock of one frame to the end of its script.
FRAME_SCRIPT = """(count) => new Promise((resolve) => {
  const { playback } = window.assurStudio;
  const script = [], between = [];
  let last = null;
  const show = playback.player.show;
  playback.player.show = (q) => {
    const start = performance.now();
    show(q);
    script.push(performance.now() - start);
    if (last !== null) between.push(start - last);
    last = start;
    if (script.length < count) return;
    playback.player.show = show;
    playback.toggle();
    resolve({ script, between });
  };
  playback.toggle();
})"""
# From the event of the pointer to the first frame with the joint under it (checked), and to the
# first that can show all that the server has computed of it.
DRAG_SCRIPT = """([joint, count]) => new Promise((resolve, reject) => {
  const { model, canvas } = window.assurStudio;
  const [x, y] = window.placeOf(joint);
  const box = canvas.picture.getBoundingClientRect();
  const circles = [...canvas.picture.querySelectorAll("circle.joint")];
  const middle = (one) => {
    const own = one.getBoundingClientRect();
    return [own.x + own.width / 2 - box.x, own.y + own.height / 2 - box.y];
  };
  const away = (one, [px, py]) => Math.hypot(middle(one)[0] - px, middle(one)[1] - py);
  const circle = circles.reduce((a, b) => (away(b, [x, y]) < away(a, [x, y]) ? b : a));
  canvas.picture.setPointerCapture = () => {};
  const at = (i) => [x + 8 * Math.sin(i / 9), y + 8 * (Math.cos(i / 9) - 1)];
  const send = (type, i) => canvas.picture.dispatchEvent(new PointerEvent(type, {
    clientX: box.x + at(i)[0], clientY: box.y + at(i)[1],
    pointerId: 1, bubbles: true, button: 0, pointerType: "mouse",
  }));
  // A message is taken up after the frame's layout and paint were handed over.
  const afterFrame = (act) => requestAnimationFrame(() => {
    const channel = new MessageChannel();
    channel.port1.onmessage = act;
    channel.port2.postMessage(0);
  });
  const seen = [], computed = [];
  let sent = 0, i = 0;
  const next = () => {
    if (computed.length === count && seen.length === count) {
      end();
      send("pointerup", i);
      resolve({ seen, computed });
      return;
    }
    const own = (sent = performance.now());
    send("pointermove", ++i);
    afterFrame(() => {
      seen.push(performance.now() - own);
      if (away(circle, at(i)) > 1) reject(new Error(`the joint is ${away(circle, at(i))} px away`));
      if (seen.length === computed.length) next();
    });
  };
  const end = model.on("picture", () => {
    const own = sent;
    afterFrame(() => {
      computed.push(performance.now() - own);
      if (seen.length === computed.length) next();
    });
  });
  send("pointerdown", 0);
  next();
})"""
PLACE_SCRIPT = """() => {
  window.placeOf = (name) => {
    const { canvas, playback } = window.assurStudio;
    const joint = canvas.stage.data.joints.find((one) => one.name === name);
    const i = 3 * joint.link, { value } = playback.pose, [a, b] = joint.at;
    const c = Math.cos(value[i + 2]), s = Math.sin(value[i + 2]);
    return canvas.stage.view.px(value[i] + c * a - s * b, value[i + 1] + s * a + c * b);
  };
}"""


def chain(links: int) -> assur.Mechanism:
    """Return a crank with dyads, each driven by the one before; `links` with the ground."""
    joints: dict[str, tuple[float, float]] = {"A": (0.0, 0.0), "B": (0.3, 0.6)}
    members: dict[str, list[str]] = {"ground": ["A"], "crank": ["A", "B"]}
    last = "B"
    for i in range((links - 2) // 2):
        x = 1.5 * (i + 1)
        joints |= {f"C{i}": (x, 1.4), f"D{i}": (x, 0.0), f"E{i}": (x + 0.2, 0.8)}
        members["ground"].append(f"D{i}")
        members[f"rod{i}"] = [last, f"C{i}"]
        members[f"rocker{i}"] = [f"D{i}", f"C{i}", f"E{i}"]
        last = f"E{i}"
    return assur.Mechanism(joints, members, "crank")


@contextmanager
def studio(mechanism: assur.Mechanism) -> Iterator[tuple[Page, int]]:
    """Open the studio of a server of its own; yield the page and the server's process."""
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "chain.toml"
        mechanism.save(path)
        command = [sys.executable, "-m", "assur", "studio", str(path), "--no-browser", "--port=0"]
        environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run:
            assert run.stdout is not None
            address = run.stdout.readline().strip()
            with sync_playwright() as playwright:
                browser = playwright.chromium.launch(
                    executable_path=os.environ.get("CHROMIUM") or shutil.which("chromium"),
                    args=["--no-sandbox", "--enable-precise-memory-info", "--js-flags=--expose-gc"],
                )
                page = browser.new_page(viewport={"width": 1440, "height": 900})
                page.goto(address)
                while not page.evaluate("window.assurStudio?.model.link.isQuiet ?? false"):
                    page.wait_for_timeout(50)
                page.evaluate(PLACE_SCRIPT)
                yield page, run.pid
                browser.close()
            run.terminate()


def both(times: list[float]) -> str:
    """Return the median and the 95th percentile."""
    return f"{np.median(times):5.1f} / {np.percentile(times, 95):5.1f} ms"


def measure(links: int) -> None:
    """Print frames and drags of a chain."""
    with studio(chain(links)) as (page, _):
        frames = page.evaluate(FRAME_SCRIPT, FRAMES)
        drags = page.evaluate(DRAG_SCRIPT, [f"C{(links - 4) // 4}", DRAGS])
    print(
        f"{links:3d} links: script of a frame {both(frames['script'])}, between frames "
        f"{both(frames['between'])}; a drag until it is seen {both(drags['seen'])}, "
        f"until all is computed {both(drags['computed'])}"
    )


def memory(process: int) -> float:
    """Return the memory of a process, MB."""
    status = Path(f"/proc/{process}/status").read_text(encoding="ascii")
    match = re.search(r"VmRSS:\s+(\d+)", status)
    assert match is not None
    return int(match[1]) / 1024.0


def endure(minutes: float) -> None:
    """Play and drag for minutes; print the memory of both sides now and then."""
    with studio(chain(10)) as (page, process):
        end = time.monotonic() + 60.0 * minutes
        step = 0
        while time.monotonic() < end:
            page.evaluate(FRAME_SCRIPT, 200)
            page.evaluate(DRAG_SCRIPT, [f"C{step % 4}", 150])
            page.evaluate("window.assurStudio.model.undo()")
            step += 1
            if step % 10 == 1:
                heap = page.evaluate("(gc(), performance.memory.usedJSHeapSize / 1e6)")
                nodes = page.evaluate("document.querySelectorAll('*').length")
                spent = minutes - (end - time.monotonic()) / 60.0
                print(
                    f"{spent:5.1f} min: server {memory(process):6.1f} MB, page {heap:5.1f} MB, "
                    f"{nodes} elements",
                    flush=True,
                )


def main() -> None:
    """Measure, or endure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=0.0)
    arguments = parser.parse_args()
    if arguments.minutes:
        endure(arguments.minutes)
        return
    for links in LINKS:
        measure(links)


if __name__ == "__main__":
    main()
