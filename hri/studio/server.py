"""The studio's server: reports the robot's activity to the page, and passes requests back.

It runs in a separate process, which ends with the link to the robot.
"""

from __future__ import annotations

import json
import os
import re
import socket
import sys
from collections import deque
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any

import trio
from starlette.applications import Starlette
from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Scope

from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.paths import is_file
from hri.core.token import is_token
from hri.studio.access import Cookies, is_loopback, is_signed_code
from hri.studio.api import openapi
from hri.studio.commands import COMMANDS, HEAR, checked
from hri.studio.composer.files import Library
from hri.studio.composer.routes import NetworkRoutes
from hri.studio.connections import Connections, Kind, know
from hri.studio.guard import START, Guard, most_bytes, whole_body
from hri.studio.hub import PATIENCE, Hub, Waiting
from hri.studio.json_body import read_body
from hri.studio.link import LinkError
from hri.studio.page_socket import PageSockets
from hri.studio.recording_routes import Answer, RecordingRoutes

MOST_SPENT = 1000
"""Codes that the robot was asked about, and need not be asked about again."""
NICE = 5
"""Steps by which the robot goes before, when the processor is busy."""
CODE_PATIENCE, START_PATIENCE = 60.0, 20.0
"""Seconds that the robot has to take a code, as it may still be starting, and to read a network
and open its devices.
"""
TYPES = {
    "html": "text/html",
    "js": "text/javascript",
    "css": "text/css",
    "svg": "image/svg+xml",
    "txt": "text/plain",
}
_STOPS = "POST /api/v1/stop HTTP/1"
_CODE = re.compile(r"GET /\?code=(\S+)")
_BEARER = re.compile(r"^authorization: *bearer (\S+)", re.IGNORECASE | re.MULTILINE)
_LENGTH = re.compile(r"^content-length: *(\d{1,9})\s*$", re.IGNORECASE | re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Settings:
    """What the robot says at the start."""

    port: int
    secret: str
    """Of cookies."""
    allows_remote: bool
    networks: list[str] = field(default_factory=list)
    """Files of the app that runs."""
    devices: list[dict[str, str]] = field(default_factory=list)
    """Of the robot, as choices for parameters: see `hri.studio.devices`."""

    @property
    def cookie(self) -> str:
        """The name of the cookie: pages of one host share theirs, whatever their port."""
        return f"hri_studio_{self.port}"


class Studio:
    """The routes."""

    def __init__(self, hub: Hub, settings: Settings) -> None:
        self._hub, self._settings = hub, settings
        self._cookies = Cookies(settings.secret)
        self._cookie = re.compile(f"\\b{settings.cookie}=([^;\\s]*)")
        self._spent: deque[str] = deque(maxlen=MOST_SPENT)
        self._pages = PageSockets(hub, self._proof)
        self.recordings = RecordingRoutes()
        library = Library(_now, running=tuple(map(Path, settings.networks)))
        self.networks = NetworkRoutes(library, settings.devices, whole_body)

    def kind_of(self, said: bytes) -> Kind:
        """Whose a connection is, by its first bytes: a whole stop and codes of our own go first."""
        head, end, body = said.decode("latin-1").partition("\r\n\r\n")
        cookie, bearer, code, length = (
            (found[1] if (found := pattern.search(head)) else "")
            for pattern in (self._cookie, _BEARER, _CODE, _LENGTH)
        )
        if self._cookies.is_good(cookie, _now()) or (bearer and _is_token(bearer)):
            return "known"
        is_stop = bool(end) and head.startswith(_STOPS) and len(body) >= int(length or 0)
        return "first" if is_stop or is_signed_code(self._settings.secret, code) else "stranger"

    def app(self) -> ASGIApp:
        """All of it, behind the guard."""
        commands = [
            Route(f"/api/v1/{name}", partial(self._command, name), methods=["POST"])
            for name in COMMANDS
        ]
        routes = [
            Route("/", self._page),
            Route("/{name:str}.{suffix:str}", self._file),
            Route("/api/v1/openapi.json", self._openapi),
            Route("/api/v1/state", self._state),
            Route("/api/v1/codes", self._code, methods=["POST"]),
            WebSocketRoute("/api/v1/live", self._pages.serve),
            *commands,
            *(
                Route(path, partial(self._if_known, answer), methods=["GET"])
                for path, answer in self.recordings.answers.items()
            ),
            *(
                Route(path, partial(self._if_known, answer), methods=[method])
                for path, method, answer in self.networks.answers
            ),
        ]
        app = Starlette(routes=routes, lifespan=self._living)
        return Guard(app, self._settings.allows_remote, self._is_known)

    @asynccontextmanager
    async def _living(self, app: Starlette) -> AsyncIterator[None]:
        """For tests; a server's own processes end with its pipes, as Hypercorn's connections do not
        know of this.
        """
        yield
        await self.networks.close()

    async def _page(self, request: Request) -> Response:
        code = request.query_params.get("code")
        if code is None:
            return _file("index.html")
        response = RedirectResponse("/", 303)
        try:
            is_good = await self._is_good(code, request.scope)
        except HriError as error:
            return JSONResponse({"error": str(error)}, 409)
        if is_good:
            cookie = self._cookies.new(_now())
            response.set_cookie(self._settings.cookie, cookie, httponly=True, samesite="strict")
        return response

    async def _is_good(self, code: str, scope: Scope) -> bool:
        """Whether a code was good until now. The robot is asked once about each that it has made,
        and never about a guess; one that is still starting takes its time. Raises HriError.
        """
        if code in self._spent or not is_signed_code(self._settings.secret, code):
            return False
        know(scope)
        is_good = bool(await self._hub.ask("redeem", {"code": code}, CODE_PATIENCE))
        self._spent.append(code)
        return is_good

    async def _file(self, request: Request) -> Response:
        return _file(f"{request.path_params['name']}.{request.path_params['suffix']}")

    async def _openapi(self, request: Request) -> Response:
        return JSONResponse(openapi())

    async def _state(self, request: Request) -> Response:
        if not self._is_known(request):
            return _stranger()
        values = ",".join(f'"{topic}":{value}' for topic, value in self._hub.values.items())
        return Response(f"{{{values}}}", media_type="application/json")

    async def _code(self, request: Request) -> Response:
        if not self._is_known(request):
            return _stranger()
        return await self._answered("code", {})

    async def _if_known(self, answer: Answer, request: Request) -> Response:
        return await answer(request) if self._is_known(request) else _stranger()

    async def _command(self, name: str, request: Request) -> Response:
        client = request.client.host if request.client else ""
        is_open = COMMANDS[name].is_open and is_loopback(client)
        if not is_open and not self._is_known(request):
            return _stranger()
        try:
            body = await whole_body(request, most_bytes(request.url.path))
            given = read_body(body) if body else {}
            if not isinstance(given, dict):
                raise HriError("the body must be a JSON object")
            arguments = checked(name, given)
        except HriError as error:
            return JSONResponse({"error": str(error)}, 400)
        return await self._answered(name, arguments)

    async def _answered(self, command: str, arguments: dict[str, Any]) -> Response:
        try:
            patience = START_PATIENCE if command == START else PATIENCE
            result = await self._hub.ask(command, arguments, patience)
            more = {"result": None, **(result or {})} if command == HEAR else {"result": result}
            return JSONResponse(more)
        except Waiting as error:
            return JSONResponse({"error": str(error), "will_be_done": error.is_certain}, 409)
        except HriError as error:
            return JSONResponse({"error": str(error)}, 409)

    def _is_known(self, asked: HTTPConnection) -> bool:
        """Whether it has the cookie, or shows the token."""
        return bool(self._proof(asked))

    def _proof(self, asked: HTTPConnection) -> str:
        """The cookie or the token by which it is known; empty for a stranger."""
        cookie = asked.cookies.get(self._settings.cookie, "")
        if self._cookies.is_good(cookie, _now()):
            return cookie
        kind, _, token = asked.headers.get("authorization", "").partition(" ")
        return token if kind.lower() == "bearer" and _is_token(token) else ""


def _is_token(token: str) -> bool:
    try:
        return is_token(token)
    except HriError:
        return False


def _now() -> float:
    """Seconds since 1970: a cookie outlives the server."""
    return RealClock().wall().timestamp()


def _stranger() -> Response:
    remedy = "open the address that the studio printed, or show the token (hri token)"
    return JSONResponse({"error": f"the studio does not know you - {remedy}"}, 401)


def _file(name: str) -> Response:
    """A file of the page."""
    suffix = name.rpartition(".")[2]
    found = resources.files("hri.studio") / "built" / name
    if "/" in name or suffix not in TYPES or not is_file(Path(str(found))):
        return JSONResponse({"error": "not found"}, 404)
    return Response(found.read_bytes(), media_type=TYPES[suffix])


async def serve(listening: int, link: int, settings: Settings) -> None:
    """Serve on an open socket until the link to the robot has ended."""
    hub = Hub(trio.SocketStream(trio.socket.from_stdlib_socket(socket.socket(fileno=link))))
    studio = Studio(hub, settings)
    connections = Connections(studio.app(), studio.kind_of)
    async with trio.open_nursery() as nursery:
        nursery.start_soon(connections.serve, socket.socket(fileno=listening))
        nursery.start_soon(studio.recordings.close_unused)
        with suppress(OSError, trio.BrokenResourceError, LinkError):
            await hub.follow()
        nursery.cancel_scope.cancel()


def main() -> int:
    """`python -m hri.studio.server LISTENING LINK`: the numbers of two open sockets; the settings
    come on standard input.
    """
    listening, link = map(int, sys.argv[1:3])
    with suppress(OSError):
        os.nice(NICE)
    settings = Settings(**json.loads(sys.stdin.buffer.read()))
    trio.run(serve, listening, link, settings)
    return 0


if __name__ == "__main__":
    sys.exit(main())
