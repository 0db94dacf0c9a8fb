"""Networks over HTTP: `/api/v1/networks` and what is below it."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import trio
from starlette.requests import Request
from starlette.responses import Response

from hri.core.errors import HriError
from hri.studio.composer.files import LARGEST, Changed, Json, Library, NoFile
from hri.studio.composer.workshop import Workshop
from hri.studio.json_body import read_body

Answer = Callable[[Request], Awaitable[Response]]
Body = Callable[[Request, int], Awaitable[bytes]]

ROOT = "/api/v1/networks"
LONGEST_BODY = 4 * LARGEST
"""Bytes: what JSON makes of the longest network."""


class Wrong(HriError):
    """A request that makes no sense."""


@dataclass(frozen=True)
class Route:
    """What answers a method on a path below `ROOT`."""

    path: str
    method: str
    about: str
    arguments: Mapping[str, str]
    """In the address of a GET or DELETE, else in the body."""


_OF_PAGE = {
    "page": "who edits: up to 32 small letters and digits; empty for a script",
    "count": "digits that rise with each text of a page: no text replaces or drops a later draft",
}
ROUTES = (
    Route("", "GET", "the networks that can be opened, and `home`, where new ones go", {}),
    Route(
        "/file",
        "GET",
        "a network: its text, and the SHA-256 of its bytes as `mark`; with the drafts of what was "
        "not saved, newest first",
        {"path": "its file"},
    ),
    Route(
        "/file",
        "PUT",
        "save a network; 409 with the text that is there now, where that is not as `mark` says",
        {"path": "its file", "text": "all of it", "mark": "of what it replaces; null for none"}
        | _OF_PAGE,
    ),
    Route(
        "/draft",
        "PUT",
        "keep what is not saved yet, a draft for each page",
        {"path": "its file", "text": "all of it", "mark": "of the file that it began from"}
        | _OF_PAGE,
    ),
    Route(
        "/draft",
        "DELETE",
        "forget a draft",
        {
            "path": "its file",
            "page": "whose draft; empty for that of an older version",
            "seen": "the draft goes only if this is its `seen`; empty for whatever it has",
        },
    ),
    Route(
        "/new",
        "GET",
        "the path of a network that can begin there; 409 with the reason where it cannot",
        {"path": "its file"},
    ),
    Route(
        "/watch",
        "GET",
        "whether the file is still as `mark` says; its text where it is not; whether a page's "
        "draft is there",
        {"path": "its file", "mark": "as it was, empty for none", "page": "whose draft"},
    ),
    Route(
        "/check",
        "POST",
        "what `hri network check` finds in a text, each with its place",
        {"path": "the file that it is for", "text": "all of it"},
    ),
    Route(
        "/palette",
        "GET",
        "all behaviors, slots of the board, and devices; only its `mark` where that is the same",
        {"mark": "of the palette that is known; empty for none"},
    ),
    Route("/schema", "GET", "the schema of a behavior as XML", {"type": "such as Hri.Constant"}),
    Route("/app", "GET", "the networks of an app, in its order", {"name": "of the app"}),
)
"""All of them; the interface's document is made from it."""


class NetworkRoutes:
    """What answers for networks; who may ask is the server's affair."""

    def __init__(self, library: Library, devices: list[Json], body: Body) -> None:
        """`body` reads the body of a request, of a number of bytes at most."""
        self._library, self._devices, self._body = library, devices, body
        self._disk = trio.CapacityLimiter(1)  # what is compared is then replaced
        self._workshop = Workshop()
        answers: dict[tuple[str, str], Callable[..., Awaitable[Json]]] = {
            ("", "GET"): lambda: self._from_disk(library.listed),
            ("/file", "GET"): lambda path: self._from_disk(library.open, path),
            ("/file", "PUT"): lambda path, text, mark, page, count: self._from_disk(
                library.save, path, text, mark, page, count
            ),
            ("/draft", "PUT"): lambda path, text, mark, page, count: self._from_disk(
                library.keep_draft, path, text, mark, page, count
            ),
            ("/draft", "DELETE"): lambda path, page, seen: self._from_disk(
                library.drop_draft, path, page, seen
            ),
            ("/new", "GET"): lambda path: self._from_disk(library.new, path),
            ("/watch", "GET"): lambda path, mark, page: self._from_disk(
                library.watch, path, mark, page
            ),
            ("/check", "POST"): lambda path, text: self._workshop.ask("check", text, path),
            ("/palette", "GET"): self._palette,
            ("/schema", "GET"): lambda type: self._workshop.ask("schema", type),
            ("/app", "GET"): lambda name: self._from_disk(library.app, name),
        }
        self.answers: list[tuple[str, str, Answer]] = [
            (ROOT + one.path, one.method, partial(self._answer, one, answers[one.path, one.method]))
            for one in ROUTES
        ]
        """The path, the method, and what answers."""

    async def close(self) -> None:
        """End the workshop."""
        await self._workshop.close()

    async def _from_disk(self, work: Callable[..., Json], *arguments: object) -> Json:
        return await trio.to_thread.run_sync(work, *arguments, limiter=self._disk)

    async def _palette(self, mark: str) -> Json:
        now = await self._workshop.mark()
        if mark == now:
            return {"mark": now}
        found = await self._workshop.ask("palette")
        return {"mark": await self._workshop.mark(), **found, "devices": self._devices}

    async def _answer(
        self, route: Route, work: Callable[..., Awaitable[Json]], request: Request
    ) -> Response:
        try:
            return _json(await work(**await self._arguments(route, request)))
        except Wrong as error:
            return _refused(error, 400)
        except NoFile as error:
            return _refused(error, 404)
        except Changed as error:
            return _json({"error": str(error), "text": error.text, "mark": error.mark}, 409)
        except HriError as error:
            return _refused(error, 409)

    async def _arguments(self, route: Route, request: Request) -> dict[str, Any]:
        """As the table names them. Raises Wrong."""
        given: Any = dict(request.query_params)
        if route.method in ("PUT", "POST"):
            try:
                given = read_body(await self._body(request, LONGEST_BODY))
            except HriError as error:
                raise Wrong(str(error)) from error
        if not isinstance(given, dict):
            raise Wrong("the body must be a JSON object")
        for name in given.keys() - route.arguments.keys():
            raise Wrong(f'{route.path} takes no "{name}" - leave it out')
        found = {name: given.get(name, "") for name in route.arguments}
        for name, value in found.items():
            is_unmarked = name == "mark" and value is None
            if not isinstance(value, str) and not is_unmarked:
                raise Wrong(f'"{name}" must be a text')
        return found


def _refused(error: HriError, status: int) -> Response:
    return _json({"error": str(error)}, status)


def _json(value: Json, status: int = 200) -> Response:
    # Half characters, which a file name may have, are escaped.
    return Response(json.dumps(value), status, media_type="application/json")
