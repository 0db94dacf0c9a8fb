"""A program that looks at a fleet: who is there, how they are, and what it asks of them."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import msgspec

from hri.core.clock import RealClock
from hri.core.errors import HriError, did_you_mean
from hri.core.token import new_nonce, own_token
from hri.net.zenoh.acquaintances import RENEW
from hri.net.zenoh.requests import Request
from hri.net.zenoh.seal import REQUEST, Hello, Pen, Reader, hello_of
from hri.net.zenoh.session import PATIENCE, ROBOTS, FleetSettings, opened

if TYPE_CHECKING:
    import zenoh

MOST_EVENTS = 10_000
"""That wait to be printed; the oldest give way."""
ALL = "all"
"""Stands for every robot."""


class Fleet:
    """The robots, as a program sees them that is none of them; made by `fleet`."""

    def __init__(self, session: zenoh.Session) -> None:
        """Raises HriError where no token can be had."""
        token = own_token()
        self._session, self._pen, self._reader = session, Pen(token), Reader(token)
        self._guard, self._clock = threading.Lock(), RealClock()

    def names(self) -> list[str]:
        """The robots that are alive."""
        replies = self._session.liveliness().get(f"{ROBOTS}/*", timeout=PATIENCE)
        keys = (str(reply.ok.key_expr) for reply in replies if reply.ok is not None)
        return sorted({key.rpartition("/")[2] for key in keys})

    def chosen(self, names: list[str]) -> list[str]:
        """Those of these names, or every robot for "all". Raises HriError for one not there."""
        there = self.names()
        for name in names:
            if name != ALL and name not in there:
                what = f'no robot "{name}" is in the fleet'
                raise HriError(f"{what} - {did_you_mean(name, [*there, ALL], 'start it')}")
        return there if ALL in names else list(dict.fromkeys(names))

    def meet(self, name: str) -> tuple[Hello, float]:
        """The answer of a robot to a challenge, and how long that took, seconds.

        Raises HriError where it does not answer, or knows another token.
        """
        nonce, asked = new_nonce(), self._clock.now()
        key = f"hri/{name}/hello"
        for reply in self._session.get(key, payload=nonce, timeout=PATIENCE):
            answered = self._clock.now()
            if reply.ok is None:
                continue
            hello = hello_of(reply.ok.payload.to_bytes())
            if hello.name != name:
                continue
            with self._guard:
                self._reader.meet(hello, nonce)
            return hello, answered - asked
        raise HriError(f'"{name}" does not answer - it may have just ended')

    def ask(self, name: str, verb: str, arguments: Mapping[str, Any]) -> Any:
        """What came of a request. Raises HriError where it was refused, or has no answer."""
        hello, _ = self.meet(name)
        key = f"hri/{name}/do"
        data = msgspec.msgpack.encode(Request(hello.ticket, verb, dict(arguments)))
        now = self._clock.now()
        sealed = self._pen.sealed(key, data, now, now, REQUEST)
        replies = self._session.get(key, payload=data, attachment=sealed, timeout=PATIENCE)
        for reply in replies:
            if reply.ok is None or reply.ok.attachment is None:
                continue
            payload = reply.ok.payload.to_bytes()
            with self._guard:
                envelope = self._reader.opened(name, key, payload, reply.ok.attachment.to_bytes())
            if envelope is None:
                continue
            told = msgspec.msgpack.decode(payload)
            if envelope.datatype == "refused":
                raise HriError(f"{name}: {told}")
            return told
        raise HriError(f'"{name}" did not say whether it did that - see `hri fleet list`')

    def events(self, names: list[str], seconds: float) -> Iterator[dict[str, Any]]:
        """What happens to these robots, as it happens, for a number of seconds.

        Those that are not there yet, or not any more, are watched when they come; "all" are all.
        """
        came: deque[dict[str, Any]] = deque(maxlen=MOST_EVENTS)
        news = threading.Condition()

        def take(sample: zenoh.Sample) -> None:
            robot = str(sample.key_expr).split("/")[1]
            if (event := self._event(robot, sample)) is not None:
                with news:
                    came.append({"robot": robot} | event | {"robot": robot})
                    news.notify()

        with self._session.declare_subscriber("hri/*/event/**", take):
            end, renew = self._clock.now() + seconds, 0.0
            while (now := self._clock.now()) < end:
                if now >= renew:
                    renew = now + RENEW
                    self._watch(names)
                with news:
                    news.wait_for(lambda: bool(came), max(min(renew, end) - self._clock.now(), 0.0))
                    told = list(came)
                    came.clear()
                yield from (one for one in told if ALL in names or one["robot"] in names)

    def _watch(self, names: list[str]) -> None:
        """Ask those of them that are there for their events."""
        for name in self.names():
            if ALL in names or name in names:
                with suppress(HriError):  # It may have just ended.
                    self.ask(name, "want", {"events": True})

    def _event(self, robot: str, sample: zenoh.Sample) -> dict[str, Any] | None:
        """An event of a robot that is believed."""
        if sample.attachment is None:
            return None
        key, data = str(sample.key_expr), sample.payload.to_bytes()
        with self._guard, suppress(HriError, ValueError):
            if self._reader.opened(robot, key, data, sample.attachment.to_bytes()) is not None:
                return msgspec.json.decode(data, type=dict[str, Any])
        return None


@contextmanager
def fleet(settings: FleetSettings) -> Iterator[Fleet]:
    """The fleet, until the block ends. Raises HriError where it cannot be joined."""
    with opened(settings) as session:
        yield Fleet(session)
