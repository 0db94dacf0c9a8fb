"""Recordings over HTTP. Threads read the files and decode the films."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Awaitable, Callable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

import trio
from starlette.requests import Request
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from hri.core.errors import HriError
from hri.core.recorded import SOUND
from hri.studio import recordings
from hri.studio.films import Films

T = TypeVar("T")
Answer = Callable[[Request], Awaitable[Response]]

MOST_READERS = 4
"""Files that are read at once."""
CHUNK = 262_144
"""Bytes of a sound that are read at once."""
UNUSED = 60.0
"""Seconds without a look after which a film may be closed."""
_RANGE = re.compile(r"bytes=(\d{1,15})?-(\d{1,15})?")


class Wrong(HriError):
    """A request that makes no sense."""


class RecordingRoutes:
    """What answers for recordings; who may ask is the server's affair."""

    def __init__(self) -> None:
        self._films = Films()
        self._decoder = trio.CapacityLimiter(1)
        self._readers = trio.CapacityLimiter(MOST_READERS)
        answers: Mapping[str, Answer] = {
            "": self._list,
            "/about": self._about,
            "/events": self._events,
            "/face": self._face,
            "/sound": self._sound,
        }
        self.answers = {
            f"/api/v1/recordings{name}": partial(_refusing, answer)
            for name, answer in answers.items()
        }
        """By the path of the request."""

    async def close_unused(self) -> None:
        """Close films that no one looks at any more, for ever."""
        while True:
            await trio.sleep(UNUSED)
            await self._decode(self._films.close_unused)

    async def _read(self, reader: Callable[..., T], *arguments: object) -> T:
        return await trio.to_thread.run_sync(reader, *arguments, limiter=self._readers)

    async def _decode(self, reader: Callable[..., T], *arguments: object) -> T:
        return await trio.to_thread.run_sync(reader, *arguments, limiter=self._decoder)

    async def _folder(self, request: Request) -> Path:
        return await self._read(recordings.folder_of, request.query_params.get("folder", ""))

    async def _list(self, request: Request) -> Response:
        return _json({"recordings": await self._read(recordings.listed)})

    async def _about(self, request: Request) -> Response:
        folder = await self._folder(request)
        return _json(await self._decode(about, folder, self._films))

    async def _events(self, request: Request) -> Response:
        begin = int(_number(request, "from", 0.0))
        folder = await self._folder(request)
        text = await self._read(recordings.events_of, folder, begin)
        return Response(text, media_type="application/json")

    async def _face(self, request: Request) -> Response:
        time = _number(request, "t")
        folder = await self._folder(request)
        picture = await self._decode(picture_at, folder, self._films, time)
        return Response(picture, media_type="image/jpeg")

    async def _sound(self, request: Request) -> Response:
        most = int(_number(request, "bytes", 1e15))
        folder = await self._folder(request)
        await self._read(recordings.sound_of, folder)
        file = await self._read(recordings.opened, folder, SOUND)
        return FilePart(file, most, request.headers.get("range", ""), self._read)


def about(folder: Path, films: Films) -> dict[str, Any]:
    """What a page has to know of a recording before it shows it. Raises HriError."""
    times, wrong = recordings.times_of(folder), []
    face = sound = None
    try:
        film = films.film(folder)
        face = {"start": film.start, "length": film.length, "rate": film.rate}
    except HriError as error:
        wrong.append(str(error))
    try:
        found = recordings.sound_of(folder)
        sound = {"start": times.sound, "length": found.length, "bytes": found.size}
    except HriError as error:
        wrong.append(str(error))
    streams = [stream for stream in (face, sound) if stream is not None]
    return {
        **recordings.summary(folder),
        "start": min([times.log, *(stream["start"] for stream in streams)]),
        "end": max([times.end, *(one["start"] + one["length"] for one in streams)]),
        "face": face,
        "sound": sound,
        "wrong": wrong,
        "words": recordings.words(),
    }


def picture_at(folder: Path, films: Films, time: float) -> bytes:
    """The face at a time of the log, as a JPEG. Raises HriError."""
    return films.film(folder).jpeg(time)


async def _refusing(answer: Answer, request: Request) -> Response:
    try:
        return await answer(request)
    except Wrong as error:
        return _json({"error": str(error)}, 400)
    except HriError as error:
        return _json({"error": str(error)}, 404)


def _number(request: Request, name: str, otherwise: float | None = None) -> float:
    """A number from 0 on that a request names. Raises Wrong."""
    given = request.query_params.get(name)
    if given is None and otherwise is not None:
        return otherwise
    with suppress(ValueError):
        number = float(given or "")
        if math.isfinite(number) and 0 <= number <= 1e15:
            return number
    raise Wrong(f'"{name}" must be a number from 0 on')


def _json(value: Any, status: int = 200) -> Response:
    return Response(json.dumps(value), status, media_type="application/json")


class FilePart(Response):
    """A part of a file, or all of it, as a request wishes (RFC 9110, 14)."""

    def __init__(
        self,
        file: BinaryIO,
        most: int,
        wish: str,
        read: Callable[..., Awaitable[bytes]],
    ) -> None:
        """`most` is where a growing file is taken to end; `read` calls a function in a thread."""
        self._file, self._read = file, read
        size = min(most, os.fstat(file.fileno()).st_size)
        self._begin, self._end = span(wish, size)
        is_part, is_there = bool(_RANGE.fullmatch(wish)), self._begin < self._end
        headers = {"accept-ranges": "bytes", "content-length": str(self._end - self._begin)}
        if is_part:
            told = f"{self._begin}-{self._end - 1}" if is_there else "*"
            headers["content-range"] = f"bytes {told}/{size}"
        status = 200 if not is_part else 206 if is_there else 416
        super().__init__(None, status, headers, "audio/wav")

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        with self._file:
            async with trio.open_nursery() as nursery:
                nursery.start_soon(_cancel_when_gone, receive, nursery.cancel_scope)
                head = {"status": self.status_code, "headers": self.raw_headers}
                await send({"type": "http.response.start", **head})
                if scope["method"] != "HEAD":
                    await self._send(send)
                await send({"type": "http.response.body", "body": b"", "more_body": False})
                nursery.cancel_scope.cancel()

    async def _send(self, send: Send) -> None:
        handle, place = self._file.fileno(), self._begin
        while place < self._end:
            data = await self._read(os.pread, handle, min(CHUNK, self._end - place), place)
            if not data:  # it was cut while it was read; the connection ends early
                return
            await send({"type": "http.response.body", "body": data, "more_body": True})
            place += len(data)


async def _cancel_when_gone(receive: Receive, scope: trio.CancelScope) -> None:
    while (await receive())["type"] != "http.disconnect":
        pass
    scope.cancel()


def span(wish: str, size: int) -> tuple[int, int]:
    """The bytes that a header `Range` wishes, from and up to; all for one that we do not know."""
    found = _RANGE.fullmatch(wish)
    if found is None:
        return 0, size
    first, last = found.groups()
    if first is None:  # the last so many
        return (max(0, size - int(last)), size) if last else (0, 0)
    end = size if last is None else min(size, int(last) + 1)
    return (int(first), end) if int(first) < end else (0, 0)
