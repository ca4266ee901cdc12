"""Runs the studio: finds a port, says the address, opens the browser, serves until Ctrl-C."""

from __future__ import annotations

import secrets
import socket
import webbrowser
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from assur._arrays import flag
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur.studio.session import Given

LOCAL = "127.0.0.1"
# Autosaved documents belong to an address, so it should be the same every time.
USUAL_PORT, MORE_PORTS, LAST_PORT = 8417, 20, 65535
EVERYWHERE = ("0.0.0.0", "::")


def require_packages() -> None:
    """Refuse to start without what the studio needs."""
    try:
        import starlette
        import uvicorn
        import websockets
    except ImportError as error:
        message = f"the studio needs {error.name}: pip install assur[studio]"
        raise InputError(message) from error
    del starlette, uvicorn, websockets


def serve(
    given: Given | None,
    host: str | None = None,
    port: int | None = None,
    browser: bool = True,
    say: Callable[[str], Any] = print,
) -> None:
    """Serve until Ctrl-C.

    Parameters
    ----------
    given : Given or None
        The document to open; None for an empty page.
    host : str, optional
        Where to listen: this machine alone by default.
    port : int, optional
        0 for any; by default the usual one, or one of the next that are free.
    browser : bool
        Whether to open the page.
    say : callable
        Called with the address.
    """
    browser = flag(browser, "browser")
    require_packages()
    import uvicorn

    from assur.studio.app import application
    from assur.studio.limits import MOST_READ

    listening = _listening(host or LOCAL, port)
    token, own_port = secrets.token_urlsafe(24), listening.getsockname()[1]
    app = application(given, token, host or LOCAL, own_port)
    config = uvicorn.Config(
        app,
        log_level="warning",
        access_log=False,
        ws="websockets-sansio",
        ws_max_size=MOST_READ,
        ws_per_message_deflate=False,
        server_header=False,
        date_header=False,
        proxy_headers=False,
        lifespan="off",
        timeout_graceful_shutdown=1,
    )
    address = f"http://{_shown(host or LOCAL)}:{own_port}/?token={token}"
    say(address)
    if browser:
        webbrowser.open(address)
    with suppress(KeyboardInterrupt), listening:
        uvicorn.Server(config).run(sockets=[listening])


def _listening(host: str, port: int | None) -> socket.socket:
    """Return a socket that listens, at the port given or at the first free one."""
    if port is not None and not 0 <= port <= LAST_PORT:
        message = f"--port {port}: a port is from 0 to {LAST_PORT}"
        raise InputError(message)
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    ports = range(USUAL_PORT, USUAL_PORT + MORE_PORTS) if port is None else ()
    for number in ports:
        with suppress(OSError):
            return socket.create_server((host, number), family=family)
    try:
        return socket.create_server((host, 0 if port is None else port), family=family)
    except OSError as error:
        message = f"{host}:{port}: the studio cannot listen there: {error.strerror or error}"
        raise InputError(message) from error


def _shown(host: str) -> str:
    if host in EVERYWHERE:
        return socket.gethostname()
    return f"[{host}]" if ":" in host else host
