"""The application: the page's files by an explicit list, and the socket."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING, NamedTuple

from starlette.applications import Starlette
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute

from assur.pictures.page.html import css
from assur.studio.connection import Studio
from assur.studio.guard import Guard

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

    from starlette.requests import Request
    from starlette.types import ASGIApp
    from starlette.websockets import WebSocket

    from assur.studio.session import Given

TYPES = {
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".svg": "image/svg+xml",
}
# Folders of the package whose files of these types are served, at the same addresses.
SERVED = ("studio/page", "pictures/page")
INDEX, STYLE = "/studio/page/index.html", "/pictures/page/page.css"


class Resource(NamedTuple):
    """A file of the package, and its type."""

    file: Traversable
    type: str
    is_style: bool

    def content(self) -> str:
        """Return the text of the file; the style has the colours of pictures."""
        if self.is_style:
            return f"html,body{{height:100%;margin:0}}\n{css()}"
        return self.file.read_text(encoding="utf-8")


def listed() -> dict[str, Resource]:
    """Return all that is served, by address. Nothing else is ever read."""
    found: dict[str, Resource] = {}
    for folder in SERVED:
        _list(files("assur").joinpath(folder), f"/{folder}", found)
    found["/"] = found.pop(INDEX)
    return found


def _list(folder: Traversable, address: str, found: dict[str, Resource]) -> None:
    for one in folder.iterdir():
        own = f"{address}/{one.name}"
        ending = one.name[one.name.rfind(".") :]
        if one.is_dir():
            _list(one, own, found)
        elif ending in TYPES:
            found[own] = Resource(one, TYPES[ending], own == STYLE)


def application(given: Given | None, token: str, host: str, port: int) -> ASGIApp:
    """Return the application.

    Parameters
    ----------
    given : Given or None
        The file or example that the command named.
    token : str
        Who has it is let in.
    host, port : str, int
        Where the server listens.
    """
    served, studio = listed(), Studio(given)

    async def page(request: Request) -> Response:
        resource = served.get(request.url.path)
        if resource is None:
            return PlainTextResponse("There is nothing here.", 404)
        return Response(resource.content(), media_type=resource.type)

    async def socket(websocket: WebSocket) -> None:
        await studio.connect(websocket)

    routes = [WebSocketRoute("/socket", socket), Route("/{path:path}", page)]
    return Guard(Starlette(routes=routes), token, host, port)
