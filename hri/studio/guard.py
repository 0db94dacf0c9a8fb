"""Refuses what no page of ours asks for, before a route sees it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import aclosing
from functools import partial
from typing import Any

from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket

from hri.core.errors import HriError
from hri.studio.access import is_own_host, is_own_origin
from hri.studio.composer.routes import LONGEST_BODY as LONGEST_NETWORK, ROOT as NETWORKS
from hri.studio.connections import know

LONGEST_BODY = 65_536
"""Bytes of a request."""
START = "network_start"
"""The command that takes a whole network."""
HEADERS = {
    "content-security-policy": "default-src 'self'; img-src 'self' blob:; object-src 'none'; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cache-control": "no-store",
    "cross-origin-resource-policy": "same-origin",
}


class Guard:
    """Refuses hosts and pages that are not ours, and bodies that are too long; adds headers."""

    def __init__(
        self, app: ASGIApp, allows_remote: bool, is_known: Callable[[HTTPConnection], bool]
    ) -> None:
        self._app, self._allows_remote, self._is_known = app, allows_remote, is_known

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        asked = HTTPConnection(scope)
        host, length = asked.headers.get("host", ""), asked.headers.get("content-length", "0")
        most, why = most_bytes(scope["path"]), ""
        if not is_own_host(host, self._allows_remote):
            why = "this name is not the studio's - use the address that it printed"
        elif not is_own_origin(asked.headers.get("origin"), host):
            why = "another site's page may not use the studio"
        elif not _is_short(length, most):
            why = f"at most {most} bytes are taken"
        if not why:
            if self._is_known(asked):
                know(scope)
            await self._app(scope, receive, partial(_send_with_headers, send))
        elif scope["type"] == "http":
            await JSONResponse({"error": why}, 403, HEADERS)(scope, receive, send)
        else:
            await WebSocket(scope, receive, send).close(1008)


def most_bytes(path: str) -> int:
    """The bytes of a request that are taken."""
    is_network = path.startswith(f"{NETWORKS}/") or path == f"/api/v1/{START}"
    return LONGEST_NETWORK if is_network else LONGEST_BODY


def _is_short(length: str, most: int) -> bool:
    return length.isdecimal() and len(length) < 10 and int(length) <= most


async def _send_with_headers(send: Send, message: Any) -> None:
    if message["type"] == "http.response.start":
        own = [(name.encode(), value.encode()) for name, value in HEADERS.items()]
        message = {**message, "headers": [*message["headers"], *own]}
    await send(message)


async def whole_body(request: Request, most: int = LONGEST_BODY) -> bytes:
    """The whole body. Raises HriError for one that is too long, whatever its head said."""
    body = b""
    async with aclosing(request.stream()) as parts:
        async for part in parts:
            body += part
            if len(body) > most:
                raise HriError(f"at most {most} bytes are taken")
    return body
