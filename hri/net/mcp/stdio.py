"""Messages over standard input and output, a line of JSON each.

The SDK's transport reads lines without a limit, in a thread that nothing ends. This one bounds
them, and how many requests wait for an answer that nobody fetches.
"""

from __future__ import annotations

import os
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager, suppress
from dataclasses import dataclass, field

import anyio
import mcp_types as types
import trio
from anyio.streams.memory import MemoryObjectReceiveStream, MemoryObjectSendStream
from mcp.shared.message import SessionMessage

from hri.net.mcp.rate import Rate

LONGEST_LINE = 1_000_000
"""Bytes of a message; a longer one is passed over."""
MOST_WAITING = 32
"""Requests that are not answered yet; no more is read before one is."""
BURST, A_SECOND = 100.0, 200.0
"""Messages that are taken at once, and then each second: the robot's loop has more to do."""
CHUNK = 65_536
"""Bytes that are read at once."""

Incoming = MemoryObjectReceiveStream[SessionMessage | Exception]
Outgoing = MemoryObjectSendStream[SessionMessage]


class TooLong(ValueError):
    """A line beyond `LONGEST_LINE`."""


class Lines:
    """Cuts bytes into lines; of one that is too long nothing is kept but that it came."""

    def __init__(self) -> None:
        self._begun = bytearray()
        self._is_too_long = False

    def feed(self, data: bytes) -> Iterator[bytes | TooLong]:
        """The lines that end in some bytes."""
        *ended, rest = data.split(b"\n")
        for part in ended:
            line = bytes(self._begun) + part
            if self._is_too_long or len(line) > LONGEST_LINE:
                yield TooLong(f"a message of more than {LONGEST_LINE} bytes")
            elif line.strip():
                yield line
            self._begun.clear()
            self._is_too_long = False
        self._begun += rest
        if len(self._begun) > LONGEST_LINE:
            self._begun.clear()
            self._is_too_long = True


@dataclass
class Waiting:
    """The requests that are not answered yet, by their ids as text."""

    ids: set[str] = field(default_factory=set)
    changed: trio.Event = field(default_factory=trio.Event)

    def taken(self, line: bytes | TooLong) -> SessionMessage | Exception | None:
        """What a line is to the server; None for a request that has no place."""
        message = line if isinstance(line, TooLong) else _parsed(line)
        if isinstance(message, Exception):
            return message
        return SessionMessage(message) if self.note(message) else None

    def note(self, message: types.JSONRPCMessage) -> bool:
        """Take a message in; False for a request whose id is in use, which has no place."""
        if isinstance(message, types.JSONRPCRequest):
            if str(message.id) in self.ids:
                return False
            self.ids.add(str(message.id))
        if (
            isinstance(message, types.JSONRPCNotification)
            and message.method == "notifications/cancelled"
        ):
            self.settle((message.params or {}).get("requestId"))
        return True

    def settle(self, id: object) -> None:
        """A request is answered, or its client wants no answer any more."""
        self.ids.discard(str(id))
        self.changed.set()
        self.changed = trio.Event()

    async def until_few(self) -> None:
        """Wait until there is room for one more."""
        while len(self.ids) >= MOST_WAITING:
            await self.changed.wait()


@dataclass(frozen=True, slots=True)
class Wire:
    """The two descriptors that carry the protocol."""

    input: int
    output: int


@contextmanager
def taken() -> Iterator[Wire]:
    """Standard input and output for the protocol alone: whatever else is printed meanwhile goes to
    standard error, and nothing can be read.
    """
    wire = Wire(os.dup(0), os.dup(1))
    # A pipe to which no one writes: what reads the keyboard waits, and does not find it ended.
    silence, held = os.pipe()
    os.dup2(silence, 0)
    os.dup2(2, 1)
    try:
        yield wire
    finally:
        os.dup2(wire.input, 0)
        os.dup2(wire.output, 1)
        for one in (wire.input, wire.output, silence, held):
            os.close(one)


@asynccontextmanager
async def streams(wire: Wire) -> AsyncIterator[tuple[Incoming, Outgoing]]:
    """Messages from and to the other end of a wire; the first stream ends with its input."""
    to_server, incoming = anyio.create_memory_object_stream[SessionMessage | Exception](0)
    outgoing, to_wire = anyio.create_memory_object_stream[SessionMessage](0)
    waiting = Waiting()
    source = trio.lowlevel.FdStream(os.dup(wire.input))
    sink = trio.lowlevel.FdStream(os.dup(wire.output))
    async with source, sink, to_wire, incoming, outgoing, trio.open_nursery() as nursery:
        nursery.start_soon(_read, source, to_server, waiting)
        nursery.start_soon(_write, sink, to_wire, waiting)
        try:
            yield incoming, outgoing
        finally:
            nursery.cancel_scope.cancel()


async def _read(
    source: trio.lowlevel.FdStream,
    to_server: MemoryObjectSendStream[SessionMessage | Exception],
    waiting: Waiting,
) -> None:
    lines, rate = Lines(), Rate(BURST, A_SECOND)
    async with to_server:
        with suppress(trio.BrokenResourceError):  # an input that breaks has ended
            while data := await source.receive_some(CHUNK):
                for line in lines.feed(data):
                    await rate.turn()
                    await waiting.until_few()
                    if (message := waiting.taken(line)) is not None:
                        await to_server.send(message)


def _parsed(line: bytes) -> types.JSONRPCMessage | Exception:
    try:
        return types.jsonrpc_message_adapter.validate_json(line, by_name=False)
    except (ValueError, RecursionError) as error:  # pydantic's errors are ValueErrors
        return error


async def _write(
    sink: trio.lowlevel.FdStream,
    to_wire: MemoryObjectReceiveStream[SessionMessage],
    waiting: Waiting,
) -> None:
    async for sent in to_wire:
        text = sent.message.model_dump_json(by_alias=True, exclude_unset=True)
        try:
            await sink.send_all(text.encode("utf-8") + b"\n")
        except trio.BrokenResourceError:  # the reader has gone; the input will end, too
            await trio.sleep_forever()
        if isinstance(sent.message, (types.JSONRPCResponse, types.JSONRPCError)):
            waiting.settle(sent.message.id)
