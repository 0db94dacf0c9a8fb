"""The link between the robot and the studio's server: messages over a local socket.

A message is a head, its kind and its length, and the content: JSON, or a picture with the time at
which it was taken. The robot never waits for the server: of each topic it keeps the newest value,
and of events the last ones, until the server takes them.
"""

from __future__ import annotations

import json
import math
import socket
import struct
import threading
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import Any

import cv2

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.studio.event_memory import EventMemory
from hri.studio.request_queue import MOST_REQUESTS, MOST_STOPS, Request, RequestQueue

TEXT, FACE, CAMERA, VALUE = 1, 2, 3, 4
"""Kinds of messages: JSON, pictures as JPEG behind their time, and the value of a topic: its name,
a line break, and JSON that the server passes on as it is."""
PICTURES = {"face": FACE, "camera": CAMERA}
NETWORK, THUMBNAIL, REASON = "network:", "thumbnail:", "reason:"
"""What begins the name of a network whose values are wanted, and of an output whose picture is."""
LARGEST = 4_000_000
"""Bytes of a message."""
MOST_ANSWERS = 2 * (MOST_REQUESTS + MOST_STOPS)
"""Answers that wait for the server: more than requests can wait."""
QUALITY = 80
"""Of pictures, as JPEG has it."""
_HEAD, _TIME = struct.Struct(">BI"), struct.Struct(">d")
_CHUNK = 65_536


class LinkError(HriError):
    """The other end does not keep to the protocol."""


def packed(kind: int, content: bytes) -> bytes:
    """A message with its head."""
    return _HEAD.pack(kind, len(content)) + content


def packed_json(value: Any) -> bytes:
    """A message of JSON; numbers that JSON does not have are null."""
    return packed(TEXT, _json(value).encode())


def packed_value(topic: str, value: Any) -> bytes:
    """A message with the value of a topic."""
    return packed(VALUE, f"{topic}\n{_json(value)}".encode())


def _json(value: Any) -> str:
    """JSON; numbers that JSON does not have are null."""
    try:
        return json.dumps(value, separators=(",", ":"), allow_nan=False)
    except (ValueError, TypeError):
        return json.dumps(finite(value), separators=(",", ":"))


def finite(value: Any) -> Any:
    """The same without infinities and NaN, which become None."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {str(key): finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    return value if value is None or isinstance(value, (bool, int, str)) else str(value)


class Unpacker:
    """Cuts a stream of bytes into messages."""

    def __init__(self) -> None:
        self._rest = bytearray()

    def feed(self, data: bytes) -> Iterator[tuple[int, bytes]]:
        """The kind and content of each message that is complete. Raises LinkError."""
        self._rest += data
        while len(self._rest) >= _HEAD.size:
            kind, length = _HEAD.unpack_from(self._rest)
            if length > LARGEST:
                raise LinkError(f"a message of {length} bytes - at most {LARGEST} are taken")
            end = _HEAD.size + length
            if len(self._rest) < end:
                return
            content = bytes(self._rest[_HEAD.size : end])
            del self._rest[:end]
            yield kind, content


class RobotEnd:
    """The robot's end. `put`, `put_picture` and `add_event` are quick and may come from any thread;
    pictures are compressed in the thread that writes.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._values: dict[str, Any] = {}
        """The newest of each topic, for every server that comes."""
        self._fresh: dict[str, None] = {}
        """Topics that the server does not have yet, in order."""
        self._pictures: dict[str, tuple[Image, float]] = {}
        self._memory: EventMemory[dict[str, Any]] = EventMemory(most_flood=0)
        """The last events, for every server that comes."""
        self._events: EventMemory[dict[str, Any]] = EventMemory()
        """Events that the server does not have yet."""
        self._answers: deque[dict[str, Any]] = deque(maxlen=MOST_ANSWERS)
        self._socket: socket.socket | None = None
        self._is_closed = False
        self.requests = RequestQueue()
        self.wanted: frozenset[str] = frozenset()
        """Pictures that someone looks at, and with one of the words above before, values."""
        self.reader: threading.Thread | None = None
        """Of what the server sends, until it has ended."""
        threading.Thread(target=self._write, name="studio link", daemon=True).start()

    def put(self, topic: str, value: Any) -> None:
        """The newest value of a topic, of plain types."""
        with self._changed:
            if self._values.get(topic) != value:
                self._values[topic] = value
                self._fresh[topic] = None
                self._changed.notify()

    def put_later(self, topic: str, written: Callable[[], str]) -> None:
        """The newest value of a topic, which costs something to write: `written` gives it as JSON,
        in the thread that writes, and the same when it is called again.
        """
        self.put(topic, written)

    def put_picture(self, topic: str, image: Image, time: float) -> None:
        """The newest picture (uint8, [height, width, 3], RGB) of a key of `PICTURES`."""
        with self._changed:
            self._pictures[topic] = image, time
            self._changed.notify()

    def wanted_of(self, kind: str) -> list[str]:
        """What is wanted of a kind, without its beginning."""
        return [one.removeprefix(kind) for one in sorted(self.wanted) if one.startswith(kind)]

    def add_event(self, event: dict[str, Any]) -> None:
        """An event; when too many wait the oldest is forgotten."""
        with self._changed:
            self._memory.add(event, event)
            self._events.add(event, event)
            self._changed.notify()

    def answer(self, number: int, error: str | None = None, result: Any = None) -> None:
        """The end of a request: its result, or why it was refused."""
        with self._changed:
            self._answers.append({"answer": number, "error": error, "result": result})
            self._changed.notify()

    def attach(self, server: socket.socket) -> None:
        """Serve another server: it gets the newest of everything, and the last events."""
        with self._changed:
            self._socket, self.wanted = server, frozenset()
            self._fresh = dict.fromkeys(self._values)
            self._events.take()
            self._events.extend(self._memory)
            self._answers.clear()
            self._changed.notify()
        self.reader = threading.Thread(
            target=self._read, args=(server,), name="studio", daemon=True
        )
        self.reader.start()

    def detach(self) -> None:
        """The server has ended."""
        with self._changed:
            server, self._socket, self.wanted = self._socket, None, frozenset()
        if server is not None:
            with suppress(OSError):
                # The server would not see that it is closed while a thread still reads.
                server.shutdown(socket.SHUT_RDWR)
            server.close()

    def close(self) -> None:
        """End the link, and so the server; a second call does nothing."""
        self._is_closed = True
        self.detach()
        with self._changed:
            self._changed.notify()

    def _read(self, server: socket.socket) -> None:
        unpacker = Unpacker()
        with suppress(OSError, LinkError, ValueError, KeyError, TypeError):
            while data := server.recv(_CHUNK):
                for kind, content in unpacker.feed(data):
                    if kind == TEXT:
                        self._take(json.loads(content))

    def _take(self, message: dict[str, Any]) -> None:
        if "wanted" in message:
            self.wanted = frozenset(message["wanted"])
            return
        request = Request(message["number"], message["command"], message["with"])
        for number, why in self.requests.put(request):
            self.answer(number, error=why)

    def _write(self) -> None:
        while not self._is_closed:
            with self._changed:
                self._changed.wait_for(lambda: self._is_closed or self._has_news())
                server, parts = self._socket, self._taken()
            if server is None:
                continue
            try:
                for part in parts:
                    server.sendall(part if isinstance(part, bytes) else part())
            except OSError:
                self.detach()

    def _has_news(self) -> bool:
        waiting = (self._fresh, self._events, self._answers, self._pictures)
        return self._socket is not None and any(waiting)

    def _taken(self) -> list[bytes | Callable[[], bytes]]:
        """What is to be sent now, answers first."""
        if self._socket is None:
            return []
        answers = [packed_json(answer) for answer in self._answers]
        values = [_packed_value(name, self._values[name]) for name in self._fresh]
        events = [packed_json({"event": event}) for event in self._events.take()]
        pictures = [partial(_compressed, name, *one) for name, one in self._pictures.items()]
        for waiting in (self._answers, self._fresh, self._pictures):
            waiting.clear()
        return [*answers, *values, *events, *pictures]


def _packed_value(topic: str, value: Any) -> bytes | Callable[[], bytes]:
    if not callable(value):
        return packed_value(topic, value)
    return lambda: packed(VALUE, f"{topic}\n{value()}".encode())


def _compressed(topic: str, image: Image, time: float) -> bytes:
    # Both leave the interpreter to the robot's loop meanwhile, which numpy would not.
    turned = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
    _, data = cv2.imencode(".jpg", turned, (cv2.IMWRITE_JPEG_QUALITY, QUALITY))
    return packed(PICTURES[topic], _TIME.pack(time) + data.tobytes())
