"""The studio in a real browser: a server of its own, a window, and what people do in it."""

from __future__ import annotations

import secrets
import socket
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import uvicorn

from assur.studio import document
from assur.studio.app import application
from assur.studio.session import Given
from support.browsers import wait_until

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from playwright.sync_api import Browser, Locator, Page

WIDTHS = {"wide": (1440, 900), "between": (900, 900), "narrow": (390, 844)}
# What this window has written down for itself is what it shows.
KEPT = """(() => {
  const { document, file } = window.assurStudio.model;
  const own = JSON.stringify(document);
  return Object.values(sessionStorage).some((text) => {
    const kept = JSON.parse(text);
    return kept?.stamp === (file?.stamp ?? null) && JSON.stringify(kept.document) === own;
  });
})()"""


class Server:
    """A server in a thread of the tests."""

    def __init__(self, given: Given | None = None, port: int = 0) -> None:
        self.listening = socket.create_server(("127.0.0.1", port))
        self.port = self.listening.getsockname()[1]
        self.token = secrets.token_urlsafe(8)
        self.given = given
        self.start()

    def start(self) -> None:
        """Serve; once more after `stop`, with the same token."""
        app = application(self.given, self.token, "127.0.0.1", self.port)
        config = uvicorn.Config(
            app, log_level="error", ws="websockets-sansio", lifespan="off",
            timeout_graceful_shutdown=1,
        )  # fmt: skip
        self._server = uvicorn.Server(config)
        run = {"sockets": [self.listening]}
        self._thread = threading.Thread(target=self._server.run, kwargs=run, daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """End it as if it had broken down: connections are lost."""
        self._server.should_exit = self._server.force_exit = True
        self._thread.join(10.0)

    def again(self) -> None:
        """Serve at the same place."""
        self.listening = socket.create_server(("127.0.0.1", self.port))
        self.start()

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.port}/?token={self.token}"


class Window:
    """A window of the studio with everything it complained about and asked for."""

    def __init__(self, browser: Browser, server: Server, width: str, *, dark: bool) -> None:
        w, h = WIDTHS[width]
        scheme: Any = "dark" if dark else "light"
        self.context = browser.new_context(
            viewport={"width": w, "height": h}, color_scheme=scheme, accept_downloads=True
        )
        self.server = server
        self.complaints: list[str] = []
        self.requests: list[str] = []
        self.page = self.another()

    def another(self) -> Page:
        """Open the studio in a tab of this browser."""
        page = self.context.new_page()
        page.on("console", lambda message: self.complaints.append(message.text))
        page.on("pageerror", lambda error: self.complaints.append(str(error.stack or error)))
        page.on("request", lambda request: self.requests.append(request.url))
        page.goto(self.server.address)
        self.ready(page)
        return page

    def ready(self, page: Page | None = None) -> None:
        """Wait until it is open."""
        self.wait_until("window.assurStudio !== undefined", page)

    def wait_until(self, condition: str, page: Page | None = None) -> None:
        """Wait for a condition."""
        wait_until(page or self.page, condition, self.complaints)

    def wait_until_kept(self, page: Page | None = None) -> None:
        """Wait until the browser keeps the document for when the page is opened again."""
        self.wait_until(KEPT, page)

    def settle(self) -> None:
        """Wait until nothing is asked or computed."""
        self.wait_until(
            "window.assurStudio.model.link.isQuiet && !window.assurStudio.model.isDragging"
        )
        self.page.wait_for_timeout(30)
        self.wait_until("window.assurStudio.model.link.isQuiet")

    def open(self, own: Mapping[str, Any], title: str = "test") -> None:
        """Show a document."""
        self.page.evaluate(
            """async ([own, title]) => {
                 const { model } = window.assurStudio;
                 model.isNew = true;
                 await model.edit(own, { title });
               }""",
            [own, title],
        )
        self.settle()

    def example(self, name: str) -> None:
        """Open an example from the menu."""
        self.page.get_by_role("button", name="Examples").click()
        self.page.get_by_role("menuitem", name=name.replace("_", " "), exact=False).first.click()
        self.wait_until(f"window.assurStudio.model.title === {name!r}")
        self.settle()

    @property
    def document(self) -> dict[str, Any]:
        own: dict[str, Any] = self.page.evaluate("window.assurStudio.model.document")
        return own

    @property
    def mechanism(self) -> Any:
        """The mechanism of its document, in Python."""
        return document.read_mechanism(self.document)

    @property
    def q(self) -> float:
        return float(self.page.evaluate("window.assurStudio.playback.q"))

    @property
    def state(self) -> str:
        return str(self.page.evaluate("window.assurStudio.model.checked.state"))

    def seek(self, q: float) -> None:
        self.page.evaluate("(q) => window.assurStudio.playback.seek(q)", q)

    def px(self, x: float, y: float) -> tuple[float, float]:
        """Return where a place of the plane, m, is seen."""
        px, py = self.page.evaluate(
            """([x, y]) => {
                 const { stage } = window.assurStudio.canvas;
                 const box = stage.element.getBoundingClientRect();
                 const [px, py] = stage.view.px(x, y);
                 return [box.left + px, box.top + py];
               }""",
            [x, y],
        )
        return px, py

    def place(self, joint: str) -> tuple[float, float]:
        """Return where a joint is drawn, m."""
        x, y = self.page.evaluate(
            """(name) => {
                 const { canvas, playback } = window.assurStudio;
                 const joint = canvas.stage.data.joints.find((one) => one.name === name);
                 const i = 3 * joint.link;
                 const { value } = playback.pose;
                 const [c, s] = [Math.cos(value[i + 2]), Math.sin(value[i + 2])];
                 const [a, b] = joint.at;
                 return [value[i] + c * a - s * b, value[i + 1] + s * a + c * b];
               }""",
            joint,
        )
        return x, y

    def joint_px(self, joint: str) -> tuple[float, float]:
        return self.px(*self.place(joint))

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 8) -> None:
        """Drag with the mouse; px of the page."""
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(*end, steps=steps)
        self.page.mouse.up()

    def button(self, name: str) -> Locator:
        return self.page.get_by_role("button", name=name, exact=True)

    def close(self) -> None:
        """Close it; it has neither complained nor asked for anything of others."""
        self.context.close()
        assert self.complaints == []
        own = f"http://127.0.0.1:{self.server.port}/"
        assert all(url.startswith((own, "blob:", "data:")) for url in self.requests)


@contextmanager
def window(
    browser: Browser,
    path: Path | None = None,
    *,
    example: str | None = None,
    width: str = "wide",
    dark: bool = False,
) -> Iterator[Window]:
    """Open the studio, with a file, an example or what it begins with."""
    given = None if path is None and example is None else Given(path, example)
    server = Server(given)
    try:
        one = Window(browser, server, width, dark=dark)
        yield one
        one.close()
    finally:
        server.stop()
