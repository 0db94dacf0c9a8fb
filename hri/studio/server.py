"""The studio's server: hands on what the robot does, and asks the robot what the page wants.

It runs in a separate process, which ends with the link to the robot. A page that reads too slowly
gets the newest values, and misses old ones.
"""

from __future__ import annotations

import itertools
import json
import logging
import math
import os
import re
import secrets
import socket
import sys
from collections import deque
from collections.abc import AsyncIterator, Callable
from contextlib import aclosing, asynccontextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from importlib import resources
from pathlib import Path
from typing import Any
from weakref import WeakValueDictionary

import trio
from starlette.applications import Starlette
from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.paths import is_file
from hri.core.token import is_token
from hri.studio.access import (
    Cookies,
    is_loopback,
    is_own_host,
    is_own_origin,
    is_signed_code,
)
from hri.studio.api import openapi
from hri.studio.commands import COMMANDS, PRESS, checked
from hri.studio.composer.files import Library
from hri.studio.composer.routes import (
    LONGEST_BODY as LONGEST_NETWORK,
    ROOT as NETWORKS,
    NetworkRoutes,
)
from hri.studio.connections import SEAT, Connections, Kind, Seat, know
from hri.studio.event_memory import EventMemory
from hri.studio.json_body import read_body
from hri.studio.link import NETWORK, PICTURES, TEXT, THUMBNAIL, LinkError, Unpacker, packed_json
from hri.studio.recording_routes import Answer, RecordingRoutes
from hri.studio.request_queue import MOST_REQUESTS, MOST_STOPS, STOP

MOST_PAGES, MOST_PAGES_EACH = 32, 16
"""Pages that look at once, of all and with the same cookie or token."""
BEHIND_S = 1.0
"""Seconds for which a page that reads nothing keeps its place when another wants it."""
MESSAGE_EVERY = 0.02
"""Seconds between two messages of a page."""
MOST_PRESSES = 100
"""Stops that are known again when they come by another way."""
MOST_SPENT = 1000
"""Codes that the robot was asked about, and need not be asked about again."""
MOST_NETWORKS, MOST_THUMBNAILS = 4, 4
"""Whose values, and whose pictures, a page may want."""
LONGEST_NAME = 300
"""Letters of such a name."""
VALUES = frozenset({"ports", "thumbnails"})
"""Topics that only pages get that want values."""
LONGEST_BODY = 65_536
"""Bytes of a request."""
NICE = 5
"""Steps by which the robot goes before, when the processor is busy."""
PATIENCE = 2.0
"""Seconds that the robot has to answer."""
CODE_PATIENCE = 60.0
"""Seconds that it has to take a code: it may still be starting."""
TYPES = {
    "html": "text/html",
    "js": "text/javascript",
    "css": "text/css",
    "svg": "image/svg+xml",
    "txt": "text/plain",
}
START = "network_start"
"""The command that takes a whole network."""
START_PATIENCE = 20.0
"""Seconds that the robot has to read one and to open its devices."""
_STOPS = "POST /api/v1/stop HTTP/1"
_CODE = re.compile(r"GET /\?code=(\S+)")
_BEARER = re.compile(r"^authorization: *bearer (\S+)", re.IGNORECASE | re.MULTILINE)
_LENGTH = re.compile(r"^content-length: *(\d{1,9})\s*$", re.IGNORECASE | re.MULTILINE)
log = logging.getLogger("hri.studio")
HEADERS = {
    "content-security-policy": "default-src 'self'; img-src 'self' blob:; object-src 'none'; "
    "base-uri 'none'; form-action 'self'; frame-ancestors 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cache-control": "no-store",
    "cross-origin-resource-policy": "same-origin",
}


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
    """Of the robot, as choices for parameters: see `hri.studio.body`."""

    @property
    def cookie(self) -> str:
        """The name of the cookie: pages of one host share theirs, whatever their port."""
        return f"hri_studio_{self.port}"


@dataclass(eq=False)
class Page:
    """One page that looks, and what it does not have yet."""

    proof: str = ""
    """Why it may look: its cookie, or its token."""
    seat: Seat | None = None
    """Of its connection."""
    values: dict[str, str] = field(default_factory=dict)
    pictures: dict[int, bytes] = field(default_factory=dict)
    answers: list[str] = field(default_factory=list)
    events: EventMemory[str] = field(default_factory=EventMemory)
    sending_since: float = math.inf
    """Since when it has not read what is sent."""
    wanted: frozenset[str] = frozenset()
    news: trio.Event = field(default_factory=trio.Event)

    @property
    def wants_values(self) -> bool:
        """Whether it looks at a network."""
        return not self.wanted <= PICTURES.keys()

    def take(self) -> list[str | bytes]:
        """All that is new; the page has it from now on."""
        found: list[str | bytes] = [*self.answers, *self.values.values(), *self.events.take()]
        found += self.pictures.values()
        for waiting in (self.answers, self.values, self.pictures):
            waiting.clear()
        self.news = trio.Event()
        return found


@dataclass(eq=False)
class Question:
    """What the robot was asked, for all who wait for the answer."""

    command: str
    is_answered: trio.Event = field(default_factory=trio.Event)
    answer: dict[str, Any] = field(default_factory=dict)


class Hub:
    """The robot as the server knows it, and the pages that look at it."""

    def __init__(self, link: trio.SocketStream) -> None:
        self._link = link
        self._outbox: deque[bytes] = deque()
        self._is_sending = False
        # The answers that the robot owes another server, which was killed, are not for this one.
        self._numbers = itertools.count(secrets.randbits(48))
        # Without those for whose answer no one waits any more.
        self._questions: WeakValueDictionary[int, Question] = WeakValueDictionary()
        self._presses: dict[str, Question] = {}
        """The last stops that have a name."""
        self._wanted: list[str] = []
        self.values: dict[str, Any] = {}
        self._events: EventMemory[str] = EventMemory(most_flood=0)
        self.pages: set[Page] = set()

    async def follow(self) -> None:
        """Take what the robot sends, until it has ended."""
        unpacker = Unpacker()
        async for data in self._link:
            for kind, content in unpacker.feed(bytes(data)):
                if kind == TEXT:
                    self._take(json.loads(content), content.decode())
                else:
                    self._show(kind, content)

    def _take(self, message: dict[str, Any], text: str) -> None:
        if "answer" in message:
            question = self._questions.pop(message["answer"], None)
            if question is not None:
                question.answer = message
                question.is_answered.set()
            return
        if "topic" in message:
            self.values[message["topic"]] = message["value"]
        else:
            self._events.add(message["event"], text)
        for page in self.pages:
            if message.get("topic") in VALUES and not page.wants_values:
                continue
            if "topic" in message:
                page.values[message["topic"]] = text
            else:
                page.events.add(message["event"], text)
            page.news.set()

    def _show(self, kind: int, content: bytes) -> None:
        name = next(name for name, number in PICTURES.items() if number == kind)
        for page in self.pages:
            if name in page.wanted:
                page.pictures[kind] = bytes((kind,)) + content
                page.news.set()

    async def add(self, page: Page) -> None:
        """Let a page look: it begins with the newest of everything."""
        page.values = {
            topic: json.dumps({"topic": topic, "value": value})
            for topic, value in self.values.items()
        }
        page.events.extend(self._events)
        page.news.set()
        self.pages.add(page)

    async def remove(self, page: Page) -> None:
        """It looks no more."""
        self.pages.discard(page)
        await self.want()

    async def want(self) -> None:
        """Tell the robot which pictures someone looks at."""
        wanted = sorted(frozenset[str]().union(*(page.wanted for page in self.pages)))
        if wanted != self._wanted:
            await self._send({"wanted": wanted})
            self._wanted = wanted

    async def ask(self, command: str, arguments: dict[str, Any], patience: float = PATIENCE) -> Any:
        """The robot's answer. Raises HriError for a refusal, Waiting where none comes in time."""
        return await self.answer(await self.begin(command, arguments), patience)

    async def begin(self, command: str, arguments: dict[str, Any]) -> Question:
        """Ask, and do not wait for the answer. The same press of Stop that comes by another way is
        the question that was asked already. Raises HriError.
        """
        press = arguments.get(PRESS, "") if command == STOP else ""
        if press in self._presses:
            return self._presses[press]
        question, number = Question(command), next(self._numbers)
        self._questions[number] = question
        message = {"number": number, "command": command, "with": arguments}
        await self._send(message, most=MOST_STOPS if command == STOP else MOST_REQUESTS)
        if press:
            self._presses[press] = question
            while len(self._presses) > MOST_PRESSES:
                del self._presses[next(iter(self._presses))]
        return question

    async def answer(self, question: Question, patience: float = PATIENCE) -> Any:
        """What it answers. Raises HriError for a refusal, Waiting where no answer comes in time."""
        with trio.move_on_after(patience):
            await question.is_answered.wait()
        if not question.answer:
            raise Waiting(question.command)
        if question.answer["error"] is not None:
            raise HriError(question.answer["error"])
        return question.answer["result"]

    async def _send(self, message: dict[str, Any], most: int = MOST_REQUESTS) -> None:
        """Whoever sends already sends this as well: no one else waits for a robot that reads
        nothing. Raises HriError when it has ended, or when `most` wait.
        """
        if len(self._outbox) >= most:  # of stops more may wait, so one waits behind all else
            raise HriError("the robot reads nothing - its process may be held up, or has ended")
        self._outbox.append(packed_json(message))
        if self._is_sending:
            return
        self._is_sending = True
        try:
            with trio.CancelScope(shield=True):  # a part of a message would make junk of the rest
                while self._outbox:
                    await self._link.send_all(self._outbox.popleft())
        except trio.BrokenResourceError:
            raise HriError("the robot has ended") from None
        finally:
            self._is_sending = False


class Waiting(HriError):
    """The robot has not answered yet."""

    def __init__(self, command: str) -> None:
        stops = "it stops as soon as its loop goes on, unless it has ended"
        remedy = stops if command == STOP else "it may be busy, or has ended"
        super().__init__(f"the robot does not answer - {remedy}")
        self.is_certain = command == STOP
        """Whether it will be done."""


class Guard:
    """Refuses hosts and pages that are not ours, and bodies that are too long; adds headers."""

    def __init__(
        self, app: ASGIApp, settings: Settings, is_known: Callable[[HTTPConnection], bool]
    ) -> None:
        self._app, self._settings, self._is_known = app, settings, is_known

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        asked = HTTPConnection(scope)
        host = asked.headers.get("host", "")
        why = ""
        if not is_own_host(host, self._settings.allows_remote):
            why = "this name is not the studio's - use the address that it printed"
        elif not is_own_origin(asked.headers.get("origin"), host):
            why = "another site's page may not use the studio"
        elif not _is_short(asked.headers.get("content-length", "0"), most := _most(scope["path"])):
            why = f"at most {most} bytes are taken"
        if not why:
            if self._is_known(asked):
                know(scope)
            await self._app(scope, receive, partial(_send_with_headers, send))
        elif scope["type"] == "http":
            await JSONResponse({"error": why}, 403, HEADERS)(scope, receive, send)
        else:
            await WebSocket(scope, receive, send).close(1008)


def _most(path: str) -> int:
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


class Studio:
    """The routes."""

    def __init__(self, hub: Hub, settings: Settings) -> None:
        self._hub, self._settings = hub, settings
        self._cookies = Cookies(settings.secret)
        self._cookie = re.compile(f"\\b{settings.cookie}=([^;\\s]*)")
        self._spent: deque[str] = deque(maxlen=MOST_SPENT)
        self.recordings = RecordingRoutes()
        library = Library(_now, running=tuple(map(Path, settings.networks)))
        self.networks = NetworkRoutes(library, settings.devices, _body)

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
            WebSocketRoute("/api/v1/live", self._live),
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
        return Guard(app, self._settings, self._is_known)

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
        return JSONResponse(self._hub.values)

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
            body = await _body(request, _most(request.url.path))
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
            return JSONResponse({"result": await self._hub.ask(command, arguments, patience)})
        except Waiting as error:
            return JSONResponse({"error": str(error), "will_be_done": error.is_certain}, 409)
        except HriError as error:
            return JSONResponse({"error": str(error)}, 409)

    async def _live(self, websocket: WebSocket) -> None:
        if not self._is_known(websocket):
            await websocket.close(1008)
            return
        page = Page(self._proof(websocket), websocket.scope.get(SEAT))
        if not self._has_room(page):
            await websocket.close(1013)
            return
        await self._hub.add(page)  # before anything else, so that it counts
        if page.seat is not None:
            page.seat.kind = "page"
        try:
            await websocket.accept()
            async with trio.open_nursery() as nursery:
                nursery.start_soon(_send_news, websocket, page)
                await self._listen(websocket, page, nursery)
                nursery.cancel_scope.cancel()
        except* (WebSocketDisconnect, RuntimeError, OSError):
            pass  # it has gone
        finally:
            with trio.CancelScope(shield=True), suppress(HriError):
                await self._hub.remove(page)

    def _has_room(self, page: Page) -> bool:
        """Whether one more page may look; one that reads nothing is sent away for it."""
        pages = self._hub.pages
        if sum(one.proof == page.proof for one in pages) >= MOST_PAGES_EACH:
            return False
        if len(pages) < MOST_PAGES:
            return True
        slowest = min(pages, key=lambda one: one.sending_since)
        if slowest.seat is None or slowest.sending_since > trio.current_time() - BEHIND_S:
            return False
        pages.discard(slowest)
        slowest.seat.close()
        return True

    async def _listen(self, websocket: WebSocket, page: Page, nursery: trio.Nursery) -> None:
        """What a page says, until it goes: which pictures it wants, and stop."""
        while True:
            message = await websocket.receive()
            if message["type"] == "websocket.disconnect":
                return
            try:
                said = json.loads(message.get("text") or "{}")
                if not isinstance(said, dict):
                    raise TypeError("a page sends objects")
                if "command" in said:
                    await self._stop(page, said, nursery)
                else:
                    page.wanted = _wanted(said)
                    await self._hub.want()
            except (ValueError, KeyError, TypeError, RecursionError):
                await websocket.close(1003)
                return
            except HriError as error:
                log.debug("a page was not heard: %s", error)
            await trio.sleep(MESSAGE_EVERY)  # no page keeps the others waiting

    async def _stop(self, page: Page, message: dict[str, Any], nursery: trio.Nursery) -> None:
        """Stop the robot, also for a page that has gone meanwhile. It is the one command that a
        page may send here. Raises ValueError for any other, HriError.
        """
        number = message.pop("number", None)
        if message.pop("command") != STOP or type(number) is not int:
            raise ValueError("a page sends other commands as requests")
        try:
            arguments = checked(STOP, message)
        except HriError as error:
            raise ValueError(str(error)) from error
        question = await self._hub.begin(STOP, arguments)

        async def tell() -> None:
            failed: str | None = None
            try:
                await self._hub.answer(question)
            except HriError as error:
                failed = str(error)
            page.answers.append(json.dumps({"answer": number, "error": failed}))
            page.news.set()

        nursery.start_soon(tell)

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


def _wanted(message: dict[str, list[str]]) -> frozenset[str]:
    """What a page wants to see. Raises KeyError, TypeError, or ValueError for nonsense."""
    pictures = frozenset(message["pictures"]) & PICTURES.keys()
    networks = [NETWORK + one for one in message.get("networks", [])]
    thumbnails = [THUMBNAIL + one for one in message.get("thumbnails", [])]
    if len(networks) > MOST_NETWORKS or len(thumbnails) > MOST_THUMBNAILS:
        raise ValueError("too much is wanted")
    if any(len(one) > LONGEST_NAME for one in networks + thumbnails):
        raise ValueError("a name is too long")
    return pictures | frozenset(networks) | frozenset(thumbnails)


def _is_token(token: str) -> bool:
    try:
        return is_token(token)
    except HriError:
        return False


def _now() -> float:
    """Seconds since 1970: a cookie outlives the server."""
    return RealClock().wall().timestamp()


async def _send_news(websocket: WebSocket, page: Page) -> None:
    while True:
        await page.news.wait()
        for message in page.take():
            page.sending_since = trio.current_time()
            if isinstance(message, bytes):
                await websocket.send_bytes(message)
            else:
                await websocket.send_text(message)
            page.sending_since = math.inf


async def _body(request: Request, most: int = LONGEST_BODY) -> bytes:
    """The whole body. Raises HriError for one that is too long, whatever its head said."""
    body = b""
    async with aclosing(request.stream()) as parts:
        async for part in parts:
            body += part
            if len(body) > most:
                raise HriError(f"at most {most} bytes are taken")
    return body


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
