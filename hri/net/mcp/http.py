"""The door over HTTP: looks at each request before the SDK sees it.

Only this machine may come, under its own name, from no web page of another site, with the bearer,
and with a short body. A connection that breaks off ends its requests.
"""

from __future__ import annotations

import ipaddress
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from typing import Any
from urllib.parse import urlsplit

import trio
from mcp.server import Server
from mcp.server.streamable_http_manager import StreamableHTTPSessionManager
from starlette.datastructures import Headers
from starlette.responses import JSONResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from hri.net.mcp import bearer
from hri.net.mcp.connections import know
from hri.net.mcp.protocol import GONE
from hri.net.mcp.rate import Rate

PATH = "/mcp"
LONGEST_BODY = 1_000_000
"""Bytes of a request."""
MOST_SESSIONS = 8
IDLE = 600.0
"""Seconds without a request after which a session ends."""
MOST_REQUESTS = 32
"""Requests at once; further ones are refused."""
BURST, A_SECOND = 100.0, 100.0
"""Requests that are looked at, at once and then each second; more wait."""
HEADERS = {"cache-control": "no-store", "x-content-type-options": "nosniff"}
LEAVE = {"connection": "close"}
"""What a stranger gets as well: each further try takes another connection."""
STRANGER = "show the bearer: Authorization: Bearer ... (hri mcp token prints it)"


@asynccontextmanager
async def door(server: Server[Any]) -> AsyncIterator[ASGIApp]:
    """What serves MCP over HTTP as long as the block runs."""
    manager = StreamableHTTPSessionManager(
        server,
        json_response=True,
        session_idle_timeout=IDLE,
        max_request_body_size=LONGEST_BODY,
        max_sessions=MOST_SESSIONS,
    )
    async with manager.run():
        yield Guard(manager.handle_request)


class Guard:
    """Refuses who may not come, and what is too much."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._under_way = 0
        self._rate = Rate(BURST, A_SECOND)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return
        await self._rate.turn()
        if (refusal := self._refusal(scope)) is not None:
            await refusal(scope, receive, send)
            return
        know(scope)
        self._under_way += 1
        try:
            await self._serve(scope, receive, send)
        finally:
            self._under_way -= 1

    def _refusal(self, scope: Scope) -> Response | None:
        headers = Headers(scope=scope)
        hosts, length = headers.getlist("host"), headers.get("content-length", "0")
        if len(hosts) != 1 or not is_own_host(hosts[0]):
            return _refused(
                403, "this name is not this machine's - use the address as printed", LEAVE
            )
        if not is_own_origin(headers.get("origin"), hosts[0]):
            return _refused(403, "a page of another site may not use the robot", LEAVE)
        if not bearer.is_shown(headers.get("authorization", "")):
            return _refused(401, STRANGER, {"www-authenticate": "Bearer", **LEAVE})
        if scope["path"] != PATH:
            return _refused(404, f"not found - MCP is at {PATH}")
        if not (length.isdecimal() and len(length) < 10 and int(length) <= LONGEST_BODY):
            return _refused(413, f"at most {LONGEST_BODY} bytes are taken")
        if self._under_way >= MOST_REQUESTS:
            return _refused(503, f"{MOST_REQUESTS} requests are under way - wait for one of them")
        return None

    async def _serve(self, scope: Scope, receive: Receive, send: Send) -> None:
        body = bytearray()
        while True:
            message = await receive()
            if message["type"] != "http.request":
                return  # it broke off
            body += message.get("body", b"")
            if len(body) > LONGEST_BODY:
                too_long = _refused(413, f"at most {LONGEST_BODY} bytes are taken")
                await too_long(scope, receive, send)
                return
            if not message.get("more_body", False):
                break
        gone, is_read = trio.Event(), False

        async def read() -> Message:
            nonlocal is_read
            if not is_read:
                is_read = True
                return {"type": "http.request", "body": bytes(body), "more_body": False}
            await gone.wait()
            return {"type": "http.disconnect"}

        async def watch() -> None:
            while (await receive())["type"] != "http.disconnect":
                pass
            gone.set()

        async with trio.open_nursery() as nursery:
            nursery.start_soon(watch)
            await self._app({**scope, GONE: gone}, read, _with_headers(send))
            nursery.cancel_scope.cancel()


def is_own_host(host: str) -> bool:
    """Whether a request names this machine, and no foreign name that leads here (DNS rebinding)."""
    with suppress(ValueError):
        name = urlsplit(f"//{host}").hostname or ""
        return name == "localhost" or ipaddress.ip_address(name).is_loopback
    return False


def is_own_origin(origin: str | None, host: str) -> bool:
    """Whether a request comes from no web page, or from one of this very server."""
    if origin is None:
        return True
    with suppress(ValueError):
        return urlsplit(origin).netloc == host
    return False


def _refused(status: int, why: str, more: dict[str, str] | None = None) -> Response:
    return JSONResponse({"error": why}, status, {**HEADERS, **(more or {})})


def _with_headers(send: Send) -> Send:
    async def sent(message: Message) -> None:
        if message["type"] == "http.response.start":
            own = [(name.encode(), value.encode()) for name, value in HEADERS.items()]
            message = {**message, "headers": [*message.get("headers", ()), *own]}
        await send(message)

    return sent
