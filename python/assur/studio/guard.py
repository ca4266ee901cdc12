"""Access: only the page that has the token, on the host it was given, from its own origin.

Any web page can send requests to this machine. So the token keeps out everyone without it;
Host keeps out names that another site lets point here (DNS rebinding); Origin and Sec-Fetch-Site
keep out requests of other sites, even where the browser adds the cookie.
"""

from __future__ import annotations

import ipaddress
import secrets
import socket
from http.cookies import CookieError, SimpleCookie
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, MutableMapping

    from starlette.types import ASGIApp, Receive, Scope, Send

LOOPBACK = frozenset({"127.0.0.1", "localhost", "[::1]"})
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cache-control": "no-store",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
REFUSED = b"This page is for the window that assur studio opened. Use the address that it printed."
# What WebSockets call a violated policy; before it is accepted it becomes 403.
POLICY_VIOLATED = 1008


class Guard:
    """Lets a request through to the application, or refuses it.

    Parameters
    ----------
    app : callable
        The application (ASGI).
    token : str
        In the address first, then in a cookie.
    host : str
        Where the server listens.
    port : int
        Its port.
    """

    def __init__(self, app: ASGIApp, token: str, host: str, port: int) -> None:
        self._app, self._token, self._host, self._port = app, token, host, port
        # Cookies of one host are shared by all its ports.
        self.cookie = f"assur-studio-{port}"

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, or refuse."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = _headers(scope)
        with_token = self._has_token(scope)
        if not self._lets_in(scope, headers, with_token):
            await self._refuse(scope, receive, send)
            return
        cookie = f"{self.cookie}={self._token}; Path=/; HttpOnly; SameSite=Strict"
        await self._app(scope, receive, _adding(send, {"set-cookie": cookie} if with_token else {}))

    def _lets_in(self, scope: Scope, headers: dict[str, list[str]], with_token: bool) -> bool:
        hosts, origins = headers.get("host", []), headers.get("origin", [])
        if len(hosts) != 1 or not self._is_own(hosts[0]):
            return False
        is_socket = scope["type"] == "websocket"
        if any(origin != f"http://{hosts[0]}" for origin in origins) or len(origins) > 1:
            return False
        if is_socket and not origins:
            return False
        if not is_socket and scope["method"] not in ("GET", "HEAD"):
            return False
        sites = headers.get("sec-fetch-site", [])
        # Anyone who has the token may open the first page from anywhere.
        if not with_token and any(site not in ("same-origin", "none") for site in sites):
            return False
        return with_token or self._has_cookie(headers)

    def _is_own(self, host: str) -> bool:
        """Whether a Host is this server's, not a name that another site lets point here."""
        name, colon, port = host.rpartition(":")
        if not colon or port != str(self._port):
            return False
        if self._host in ("127.0.0.1", "localhost", "::1"):
            return name in LOOPBACK
        if name in LOOPBACK or name in (self._host, f"[{self._host}]", socket.gethostname()):
            return True
        try:
            # No name server lies about a number.
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return True

    def _has_token(self, scope: Scope) -> bool:
        """Whether the address of the page itself has the token."""
        if scope["type"] != "http" or scope["path"] != "/":
            return False
        try:
            query = parse_qs(scope["query_string"].decode("latin-1"), max_num_fields=8)
        except ValueError:
            # More fields than that.
            return False
        return any(self._is_token(token) for token in query.get("token", []))

    def _has_cookie(self, headers: dict[str, list[str]]) -> bool:
        for text in headers.get("cookie", []):
            try:
                cookie = SimpleCookie(text).get(self.cookie)
            except CookieError:
                continue
            if cookie is not None and self._is_token(cookie.value):
                return True
        return False

    def _is_token(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(errors="replace"), self._token.encode())

    async def _refuse(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": POLICY_VIOLATED})
            return
        head = [(b"content-type", b"text/plain; charset=utf-8")]
        send = _adding(send, {})
        await send({"type": "http.response.start", "status": 403, "headers": head})
        await send({"type": "http.response.body", "body": REFUSED})


def _headers(scope: Scope) -> dict[str, list[str]]:
    headers: dict[str, list[str]] = {}
    for name, value in scope["headers"]:
        headers.setdefault(name.decode("latin-1").lower(), []).append(value.decode("latin-1"))
    return headers


def _adding(
    send: Callable[[MutableMapping[str, Any]], Awaitable[None]], more: dict[str, str]
) -> Callable[[MutableMapping[str, Any]], Awaitable[None]]:
    """Return a send that adds the headers of every answer."""
    added = [(k.encode(), v.encode()) for k, v in {**HEADERS, **more}.items()]

    async def adding(message: MutableMapping[str, Any]) -> None:
        if message["type"] == "http.response.start":
            names = {name for name, _ in added}
            kept = [(k, v) for k, v in message.get("headers", []) if k.lower() not in names]
            message = {**message, "headers": [*kept, *added]}
        await send(message)

    return adding
