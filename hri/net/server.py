"""The end of the bridge that listens."""

from __future__ import annotations

import errno
import logging
import math
import os
import selectors
import socket
import time
from typing import NoReturn

from hri.core.errors import HriError
from hri.core.token import Challenge, Grant, is_nonce, is_proof, load_token, new_nonce, proof
from hri.net import control
from hri.net.malleable_protocol import Message
from hri.net.other_end import ends_of_server
from hri.net.peer import Peer, PeerError, PeerLimits
from hri.net.tcp_port import TcpPort

log = logging.getLogger("hri.net")

AT_THE_DOOR = 8
"""Connections above the limit of peers that may prove the token, each for a moment."""
REST = 1.0
"""Seconds without a new peer, when this process has no file left for one."""


class Server(TcpPort):
    """Listens on a port; port 0 takes any free one, see `port`."""

    def __init__(self, host: str, port: int, limits: PeerLimits | None = None) -> None:
        """Raises HriError when the port cannot be had."""
        self._socket = _listening(host, port)
        super().__init__(host, self._socket.getsockname()[1], limits)
        self._has_warned = False
        """Whether the log says already that no more peers can connect."""
        self._rests_until = math.inf
        """When to accept again; inf while it does."""
        self._selector.register(self._socket, selectors.EVENT_READ, self._accept)
        self._thread.start()
        if port == 0:
            log.info("listening on %s", self.address)

    def _accept(self, mask: int) -> None:
        try:
            connection, (host, port, *_) = self._socket.accept()
        except (BlockingIOError, ConnectionError):
            return  # it hung up again
        except OSError as error:
            # What waits would wake us at once, and for ever.
            self._selector.unregister(self._socket)
            self._rests_until = time.perf_counter() + REST
            self._warn(f"cannot let anyone in: {error.strerror}")
            return
        if len(self._peers) >= self._limits.peers + AT_THE_DOOR:
            connection.close()
            self._turned_away(host)
            return
        if len(self._peers) < self._limits.peers:
            self._has_warned = False
        self._add(connection, f"{host}:{port}")

    def _tend(self, now: float) -> float:
        if now >= self._rests_until:
            self._rests_until = math.inf
            self._selector.register(self._socket, selectors.EVENT_READ, self._accept)
        return min(self._rests_until, self._settle(now))

    def _settle(self, now: float) -> float:
        """Find places for those at the door, or turn them away; when to look again.

        Whoever proves the token gets the place of a stranger. Others get the place of whoever had
        been silent for long when they came: nobody who steers had.
        """
        for guest in self._peers[self._limits.peers :]:
            silent = min(
                self._peers[: self._limits.peers], key=lambda peer: (peer.is_authorized, peer.heard)
            )
            goes_before = guest.is_authorized and not silent.is_authorized
            if goes_before or guest.came - silent.heard >= self._limits.silence:
                log.debug("%s: %s gives way to another one", self.address, silent.name)
                self._remove(silent)
                self._has_warned = False
            elif now - guest.came >= self._limits.introduction:
                self._remove(guest)
                self._turned_away(guest.name)
        waiting = self._peers[self._limits.peers :]
        return min((peer.came + self._limits.introduction for peer in waiting), default=math.inf)

    def _obey(self, message: Message, peer: Peer) -> bool:
        for what, take in (
            (control.HELLO, self._challenge),
            (control.PROOF, self._check),
            (control.TOKEN, self._authorize),
        ):
            if (said := control.said(message, what)) is not None:
                try:
                    take(peer, said)
                except (HriError, OSError) as error:
                    raise PeerError(str(error)) from error
        if control.said(message, control.STOP) is None:
            return False
        may_stop = peer.is_local or peer.is_authorized
        if not may_stop:
            peer.tell(control.refusal("from another machine it takes the token to stop the robot"))
        return may_stop

    def _challenge(self, peer: Peer, nonce: str) -> None:
        """Prove to a client that this is the robot, and let it do the same."""
        if peer.challenge is not None:
            raise PeerError("it said hello again instead of an answer")
        if not is_nonce(nonce):
            raise PeerError("its hello has no nonce of 16 to 64 letters, digits, - and _")
        peer.challenge = Challenge(nonce, new_nonce(), ends_of_server(peer.connection))
        token = load_token()
        own = proof(token, "server", peer.challenge) if token is not None else ""
        peer.tell(control.challenge(peer.challenge, own))

    def _check(self, peer: Peer, shown: str) -> None:
        """A challenge is good for one proof."""
        challenge, peer.challenge = peer.challenge, None
        token = load_token()
        if challenge is None or token is None or not is_proof(shown, token, "client", challenge):
            self._refuse(peer, "this does not prove the token")
        else:
            self._authorize(peer, token)

    def _authorize(self, peer: Peer, token: str) -> None:
        peer.grant = Grant(token)
        if not peer.is_authorized:
            self._refuse(peer, "this is not the token")
        peer.refused = frozenset()  # a refusal after the token has changed is told again

    def _refuse(self, peer: Peer, why: str) -> NoReturn:
        peer.tell(control.refusal(why))
        raise PeerError(f"it was told: {why}")

    def _turned_away(self, name: str) -> None:
        self._warn(f"turned {name} away: {self._limits.peers} peers")

    def _warn(self, what: str) -> None:
        if not self._has_warned:
            log.warning("%s: %s", self.address, what)
        self._has_warned = True

    def _hang_up(self) -> None:
        self._socket.close()


def _listening(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        listening = socket.create_server((host, port), family=family, backlog=128)
    except (OSError, OverflowError, ValueError) as error:
        code = getattr(error, "errno", None)
        reason = os.strerror(code) if code and code > 0 else str(error)
        remedy = "choose another tcp_port"
        if code == errno.EADDRINUSE:
            remedy = "end the program that has it, or choose another tcp_port"
        elif code == errno.EADDRNOTAVAIL:
            remedy = "bind to an address of this machine"
        raise HriError(f"cannot listen on {host}:{port}: {reason} - {remedy}") from error
    listening.setblocking(False)
    return listening
