"""A TCP port in a separate thread, for all behaviors of this process that use it.

A `Server` listens, a `Client` connects and reconnects; both send lines to every peer they have, and
hand each message that arrives to whoever subscribed to its tag. A peer that sends anything but a
message, or reads too slowly, loses its connection and costs one line in the log; the others notice
nothing. Real sockets take real time, whatever clock the robot has.
"""

from __future__ import annotations

import logging
import math
import selectors
import socket
import threading
import time
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from functools import partial

from hri.net import control
from hri.net.malleable_protocol import Message, ProtocolError, Surplus, decode
from hri.net.peer import Peer, PeerError, PeerLimits

log = logging.getLogger("hri.net")

Listener = Callable[[Message], object]
"""Called in the thread of the port; when it raises ProtocolError the peer loses its connection."""

AFTER_MISTAKE = 1.0
"""Seconds that the thread rests after an exception that nobody expected."""
MOST_WARNINGS, WARNINGS_WITHIN = 200, 60.0
"""Number of dropped peers logged per period, and the period in seconds; others need
`--debug=net`.
"""
TO_STOP = 2.0
"""Seconds that `close` waits for the thread; only the search for a host's address takes longer."""


class TcpPort(ABC):
    """What servers and clients share: peers, subscribers, and the thread that serves them."""

    def __init__(self, host: str, port: int, limits: PeerLimits | None = None) -> None:
        self.host = host
        self.port = port
        self._limits = limits or PeerLimits()
        self._peers: tuple[Peer, ...] = ()
        self._listeners: dict[str, tuple[Listener, ...]] = {}
        self._warned: deque[float] = deque(maxlen=MOST_WARNINGS)
        """When the last warnings about peers were written."""
        self._changed = threading.Condition()
        self._closing = threading.Event()
        self._selector = selectors.DefaultSelector()
        self._bell, self._ear = socket.socketpair()
        self._bell.setblocking(False)
        self._ear.setblocking(False)
        self._selector.register(self._ear, selectors.EVENT_READ, self._hear)
        self._thread = threading.Thread(target=self._run, name=f"hri port {port}", daemon=True)

    @property
    def address(self) -> str:
        """Host and port, as they read in the log."""
        return f"{self.host}:{self.port}"

    @property
    def backlog(self) -> int:
        """Bytes that wait for the slowest peer."""
        return max((peer.backlog for peer in self._peers), default=0)

    def subscribe(self, tag: str, listener: Listener) -> None:
        """Hand over the messages with a tag, in the thread of the port."""
        with self._changed:
            self._listeners[tag] = (*self._listeners.get(tag, ()), listener)

    def unsubscribe(self, tag: str, listener: Listener) -> None:
        """End a subscription."""
        with self._changed:
            kept = tuple(one for one in self._listeners[tag] if one != listener)
            self._listeners[tag] = kept

    def send(self, frame: bytes) -> None:
        """Send a line to all peers, without waiting; with no peer it is lost."""
        needs_care = [peer.send(frame) for peer in self._peers]
        if any(needs_care):
            self._ring()

    def wait_for_peers(self, count: int, timeout: float) -> bool:
        """Block until the number of peers is exactly this; False after `timeout` s."""
        with self._changed:
            return self._changed.wait_for(lambda: len(self._peers) == count, timeout)

    def close(self) -> None:
        """Hang up and end the thread; a second call does nothing."""
        self._closing.set()
        self._ring()
        self._thread.join(TO_STOP)

    @abstractmethod
    def _tend(self, now: float) -> float:
        """Make progress with connections to come; the time at which to be called again."""

    @abstractmethod
    def _obey(self, message: Message, peer: Peer) -> bool:
        """Do what a message for the bridge itself says; whether listeners get it, too.

        Raises PeerError when it costs the connection.
        """

    @abstractmethod
    def _hang_up(self) -> None:
        """Close what is not yet, or no longer, a peer."""

    def _ring(self) -> None:
        # A full pipe has woken the thread already, a closed one has none to wake.
        with suppress(OSError):
            self._bell.send(b"!")

    def _hear(self, mask: int) -> None:
        self._ear.recv(4096)

    def _run(self) -> None:
        wake = -math.inf
        while not self._closing.is_set():
            try:
                wake = self._turn(wake)
            except Exception as error:
                # Our own mistake; the thread must not end, nor try again in a rush.
                log.error("%s: %s", self.address, error, exc_info=error)
                self._closing.wait(AFTER_MISTAKE)
        for peer in self._peers:
            self._remove(peer)
        self._hang_up()
        self._selector.close()
        self._bell.close()
        self._ear.close()

    def _turn(self, wake: float) -> float:
        """Serve who has something for us, at the latest at `wake`; when to be called again."""
        timeout = None if wake == math.inf else max(0.0, wake - time.perf_counter())
        for key, mask in self._selector.select(timeout):
            key.data(mask)
        now = time.perf_counter()
        cared = min([self._care(peer, now) for peer in self._peers], default=math.inf)
        return min(cared, self._tend(now))

    def _add(self, connection: socket.socket, name: str, first: bytes = b"") -> None:
        """`first` goes before all that this program sends to everyone."""
        try:
            peer = Peer(connection, name, self._limits, time.perf_counter())
        except OSError as error:
            log.debug("%s: %s was gone at once: %s", self.address, name, error)
            connection.close()
            return
        if first:
            peer.send(first)
        with self._changed:
            self._peers = (*self._peers, peer)
            self._changed.notify_all()
        log.debug("%s: connected with %s", self.address, name)

    def _remove(self, peer: Peer) -> None:
        with suppress(KeyError):
            self._selector.unregister(peer.connection)
        peer.close()
        with self._changed:
            self._peers = tuple(kept for kept in self._peers if kept is not peer)
            self._changed.notify_all()

    def _drop(self, peer: Peer, why: str) -> None:
        if why:
            level = logging.WARNING if self._may_warn() else logging.DEBUG
            log.log(level, "%s: dropped %s: %s", self.address, peer.name, why)
        else:
            log.debug("%s: %s hung up", self.address, peer.name)
        self._remove(peer)

    def _may_warn(self) -> bool:
        """Whether the log has room: peers that come again and again must not fill it."""
        now = time.perf_counter()
        is_full = len(self._warned) == MOST_WARNINGS and now - self._warned[0] < WARNINGS_WITHIN
        if not is_full:
            self._warned.append(now)
        return not is_full

    def _serve(self, peer: Peer, mask: int) -> None:
        """Read and write as far as the socket allows."""
        try:
            if mask & selectors.EVENT_WRITE:
                peer.flush()
            if mask & selectors.EVENT_READ:
                for line in peer.receive(time.perf_counter()):
                    if line.strip():
                        self._take(line, peer)
        except (PeerError, ProtocolError) as error:
            self._drop(peer, str(error))

    def _take(self, line: bytes, peer: Peer) -> None:
        """Deliver a line; if text follows its message, inform the peer."""
        try:
            self._deliver(line, peer)
        except Surplus as error:
            peer.tell(control.refusal(str(error)))
            level = logging.WARNING if self._may_warn() else logging.DEBUG
            log.log(level, "%s: skipped a line of %s: %s", self.address, peer.name, error)

    def _deliver(self, line: bytes, peer: Peer) -> None:
        message = decode(line, peer)
        peer.heard = time.perf_counter()
        if message.tag == control.TAG and not self._obey(message, peer):
            return
        for listener in self._listeners.get(message.tag, ()):
            try:
                listener(message)
            except ProtocolError:
                raise
            except Exception as error:
                # Our own mistake; the peer and the port must not pay for it.
                log.error(
                    "%s: <%s> not taken: %s", self.address, message.tag, error, exc_info=error
                )

    def _care(self, peer: Peer, now: float) -> float:
        """Drop who is at fault, watch the others; the time at which to look again."""
        if peer.fault:
            self._drop(peer, peer.fault)
            return math.inf
        # While we do not read, the peer is not to blame for what is missing.
        late = max(peer.unfinished_since, peer.held_until) + self._limits.patience
        if now >= late:
            self._drop(peer, f"a line not finished within {self._limits.patience:g} s")
            return math.inf
        is_held = now < peer.held_until
        reads = 0 if is_held else selectors.EVENT_READ
        self._watch(peer, reads | (selectors.EVENT_WRITE if peer.backlog else 0))
        return peer.held_until if is_held else late

    def _watch(self, peer: Peer, mask: int) -> None:
        """Update the selector, which does not accept a mask of 0."""
        known = self._selector.get_map().get(peer.connection)
        if known is None:
            if mask:
                self._selector.register(peer.connection, mask, partial(self._serve, peer))
        elif not mask:
            self._selector.unregister(peer.connection)
        elif mask != known.events:
            self._selector.modify(peer.connection, mask, known.data)
