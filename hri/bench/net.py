"""The bridge on loopback between two processes: messages a second, and times there and back.

Both ends are the code of the bridge: `encode`, a Client, a Server, `decode`, an Inbox. In the same
run, with the same messages: plain blocking sockets with lines of XML read by xml.etree, as in 2003,
and pyzmq when it is installed. A message is 200 bytes.
"""

from __future__ import annotations

import importlib.util
import math
import multiprocessing
import socket
import threading
import time
from collections.abc import Callable
from multiprocessing.connection import Connection as Pipe
from typing import Any
from xml.etree import ElementTree

import numpy as np

from hri.bench.figures import machine, summary
from hri.bench.table import attempt
from hri.bench.workers import safe_start
from hri.core.errors import HriError
from hri.net.client import Client
from hri.net.inbox import Inbox
from hri.net.malleable_protocol import Item, Message, Sender, encode
from hri.net.peer import PeerLimits
from hri.net.server import Server
from hri.net.values import write

LENGTH = 200
"""Bytes of a message, its end included."""
MESSAGES = 50_000
"""One way."""
ROUNDS = 5_000
"""There and back, one at a time."""
PAUSE = 200e-6
"""Seconds between two rounds, as the sender's next tick would come."""
TIMEOUT = 60.0
BACKLOG = 500_000
"""Bytes that may wait before the sender does."""

Measured = tuple[float, list[float]]
"""Messages a second one way, and seconds of each round trip."""


def measure(messages: int = MESSAGES, rounds: int = ROUNDS) -> dict[str, Any]:
    """Measure the bridge and its peers, one after the other. Takes some 10 seconds."""
    peers: dict[str, Any] = {"tcp lines, xml.etree": _figures(_plain, messages, rounds)}
    if importlib.util.find_spec("zmq"):
        peers["pyzmq"] = _figures(_zmq, messages, rounds)
    else:
        peers["pyzmq"] = "not installed"
    return {
        "bench": "net",
        "machine": machine(),
        "message_bytes": LENGTH,
        "messages": messages,
        "rounds": rounds,
        "bridge": _figures(_bridge, messages, rounds),
        "peers": peers,
        "goal": {"messages_per_second": 20_000, "round_trip_p99_ms": 1.0},
    }


def _figures(of: Callable[[int, int], Measured], messages: int, rounds: int) -> dict[str, Any]:
    return attempt(lambda: _measured(of, messages, rounds))  # type: ignore[no-any-return]


def _measured(of: Callable[[int, int], Measured], messages: int, rounds: int) -> dict[str, Any]:
    rate, times = of(messages, rounds)
    in_ms = [1e3 * seconds for seconds in times]
    p99 = round(float(np.percentile(in_ms, 99)), 3)
    return {"messages_per_second": round(rate), "round_trip_ms": {**summary(in_ms), "p99": p99}}


def _message(tag: str) -> Message:
    """A message of LENGTH bytes: an array, and a text that fills it up."""
    array = Item("array", write("doublearray", (1.0, 2.0, 3.0)))
    empty = encode(Message(tag, (array, Item("text", write("string", "")))))
    text = "x" * (LENGTH - len(empty))
    return Message(tag, (array, Item("text", write("string", text))))


class _Other:
    """A process at the other end; what it gives first is its port."""

    def __init__(self, serve: Callable[[Pipe, int], None], messages: int) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, there = context.Pipe()
        self._process = context.Process(target=serve, args=(there, messages), daemon=True)
        with safe_start():
            self._process.start()
        self.port = self.get()

    def get(self) -> Any:
        if not self._pipe.poll(TIMEOUT):
            raise HriError("the other process does not answer - run the bench again")
        return self._pipe.recv()

    def close(self) -> None:
        self._pipe.send(None)
        self._process.join(TIMEOUT)


def _nap(seconds: float) -> None:
    threading.Event().wait(seconds)


def _rounds(count: int, once: Callable[[], float]) -> list[float]:
    """Seconds of each round; `once` returns when its answer was received and parsed."""
    times = []
    for _ in range(count):
        _nap(PAUSE)
        begun = time.perf_counter()
        times.append(once() - begun)
    return times


# --- the bridge ---


def _bridge(messages: int, rounds: int) -> Measured:
    other = _Other(_serve_bridge, messages)
    client = Client("127.0.0.1", other.port)
    try:
        if not client.wait_for_peers(1, TIMEOUT):
            raise HriError("no connection on loopback - run the bench again")
        one_way, there = _message("one_way"), _message("there")
        begun = time.perf_counter()
        for _ in range(messages):
            client.send(encode(one_way))
            while client.backlog > BACKLOG:
                _nap(0.001)
        rate = messages / (other.get() - begun)
        back = threading.Event()
        arrived = 0.0

        def take(message: Message) -> None:
            nonlocal arrived
            arrived = time.perf_counter()
            back.set()

        def once() -> float:
            back.clear()
            client.send(encode(there))
            if not back.wait(TIMEOUT):
                raise HriError("an answer was lost - run the bench again")
            return arrived

        client.subscribe("back", take)
        return rate, _rounds(rounds, once)
    finally:
        client.close()
        other.close()


def _serve_bridge(pipe: Pipe, messages: int) -> None:
    server = Server("127.0.0.1", 0, PeerLimits(rate=math.inf))
    inbox = Inbox({"array": "doublearray", "text": "string"})
    answer = encode(_message("back"))
    count = 0

    def take(message: Message) -> None:
        nonlocal count
        inbox.put(*message.items, sender=message.sender or Sender())
        count += 1
        if count == messages:
            pipe.send(time.perf_counter())

    def reply(message: Message) -> None:
        inbox.put(*message.items, sender=message.sender or Sender())
        server.send(answer)

    server.subscribe("one_way", take)
    server.subscribe("there", reply)
    pipe.send(server.port)
    pipe.recv()
    server.close()


# --- plain lines ---


def _plain(messages: int, rounds: int) -> Measured:
    other = _Other(_serve_plain, messages)
    line = encode(_message("plain"))
    with (
        socket.create_connection(("127.0.0.1", other.port), TIMEOUT) as connection,
        connection.makefile("rb") as file,
    ):
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        begun = time.perf_counter()
        for _ in range(messages):
            connection.sendall(line)
        rate = messages / (other.get() - begun)

        def once() -> float:
            connection.sendall(line)
            ElementTree.fromstring(file.readline())
            return time.perf_counter()

        times = _rounds(rounds, once)
    other.close()
    return rate, times


def _serve_plain(pipe: Pipe, messages: int) -> None:
    answer = encode(_message("plain"))
    with socket.create_server(("127.0.0.1", 0)) as listening:
        pipe.send(listening.getsockname()[1])
        connection = listening.accept()[0]
    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    file = connection.makefile("rb")
    for _ in range(messages):
        ElementTree.fromstring(file.readline())
    pipe.send(time.perf_counter())
    while line := file.readline():
        ElementTree.fromstring(line)
        connection.sendall(answer)
    pipe.recv()


# --- pyzmq ---


def _zmq(messages: int, rounds: int) -> Measured:
    import zmq

    other = _Other(_serve_zmq, messages)
    line = encode(_message("zmq"))
    with zmq.Context() as context, context.socket(zmq.PAIR) as pair:
        pair.connect(f"tcp://127.0.0.1:{other.port}")
        begun = time.perf_counter()
        for _ in range(messages):
            pair.send(line)
        rate = messages / (other.get() - begun)

        def once() -> float:
            pair.send(line)
            pair.recv()
            return time.perf_counter()

        times = _rounds(rounds, once)
        other.close()
    return rate, times


def _serve_zmq(pipe: Pipe, messages: int) -> None:
    import zmq

    with zmq.Context() as context, context.socket(zmq.PAIR) as pair:
        pipe.send(pair.bind_to_random_port("tcp://127.0.0.1"))
        for _ in range(messages):
            pair.recv()
        pipe.send(time.perf_counter())
        while not pipe.poll(0):
            if pair.poll(100):
                pair.send(pair.recv())
