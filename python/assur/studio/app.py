"""The application: the page, its script and its style, and the socket."""

from __future__ import annotations

from importlib.resources import files
from typing import TYPE_CHECKING

from starlette.applications import Starlette
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute

from assur.studio.bundle import joined, style
from assur.studio.connection import Studio
from assur.studio.guard import Guard

if TYPE_CHECKING:
    from starlette.requests import Request
    from starlette.types import ASGIApp
    from starlette.websockets import WebSocket

    from assur.studio.session import Given

INDEX = "studio/page/index.html"


def pages() -> dict[str, tuple[str, str]]:
    """Return the served files by address, each with text and type. Nothing else is ever read."""
    index = files("assur").joinpath(INDEX).read_text(encoding="utf-8")
    return {
        "/": (index, "text/html; charset=utf-8"),
        "/studio.js": (joined(), "text/javascript; charset=utf-8"),
        "/studio.css": (f"html,body{{height:100%;margin:0}}\n{style()}", "text/css; charset=utf-8"),
    }


def application(opened: Given | None, token: str, host: str, port: int) -> ASGIApp:
    """Return the application.

    Parameters
    ----------
    opened : Given or None
        The file or example that the command named.
    token : str
        Whoever has it is let in.
    host, port : str, int
        Where the server listens.
    """
    served, studio = pages(), Studio(opened)

    async def page(request: Request) -> Response:
        if request.url.path not in served:
            return PlainTextResponse("There is nothing here.", 404)
        text, media_type = served[request.url.path]
        return Response(text, media_type=media_type)

    async def socket(websocket: WebSocket) -> None:
        await studio.connect(websocket)

    routes = [WebSocketRoute("/socket", socket), Route("/{path:path}", page)]
    return Guard(Starlette(routes=routes), token, host, port)
