"""The other robots of a fleet: which are believed, and what time it is for them."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from hri.core.clock import Clock
from hri.core.errors import HriError
from hri.core.token import new_nonce
from hri.net.zenoh import values
from hri.net.zenoh.clocks import OtherClock, RoundTrip
from hri.net.zenoh.remote_slot import Arrival
from hri.net.zenoh.seal import Envelope, Hello, Reader, hello_of
from hri.net.zenoh.session import PATIENCE

if TYPE_CHECKING:
    import zenoh

RENEW = 1.0
"""Seconds after which a robot is asked again, and clocks are compared."""
MOST = 1000
"""Robots that are asked at all."""


@dataclass(frozen=True, slots=True)
class Believed:
    """A message that counts."""

    envelope: Envelope
    data: bytes
    clock: OtherClock
    """Of its sender."""
    now: float
    """When it came, seconds of our clock."""

    def arrival(self, made: float, datatype: str) -> Arrival:
        """When a value in it was made, sent, and came."""
        ours = self.clock.ours
        return Arrival(datatype, ours(made), ours(self.envelope.time), self.now)


class Acquaintances:
    """Meets others by a challenge, and reads what they say; used by any thread."""

    def __init__(
        self,
        token: str,
        clock: Clock,
        on_met: Callable[[str, Hello], object],
        complain: Callable[[str, str], object],
    ) -> None:
        """`on_met` gets who answered, in a thread of Zenoh; `complain` a subject and a line."""
        self._clock, self._on_met, self._complain = clock, on_met, complain
        self._guard = threading.Lock()
        self._reader = Reader(token)
        self._clocks: dict[str, OtherClock] = {}
        self._asked: dict[str, float] = {}
        """When each was asked last."""
        self.session: zenoh.Session | None = None

    def is_due(self, robot: str) -> bool:
        """Whether it is time to ask a robot again."""
        is_known = robot in self._asked or len(self._asked) < MOST
        return is_known and self._clock.now() - self._asked.get(robot, -RENEW) >= RENEW

    def greet(self, robot: str) -> None:
        """Challenge a robot; the answer comes later."""
        import zenoh

        if (session := self.session) is None:
            return
        asked, nonce = self._clock.now(), new_nonce()
        self._asked[robot] = asked

        def met(reply: zenoh.Reply) -> None:
            answered = self._clock.now()
            if (ok := reply.ok) is None:
                return
            try:
                hello = hello_of(ok.payload.to_bytes())
                if hello.name == robot:
                    self._meet(hello, nonce).take(RoundTrip(asked, answered, hello.clock))
                    self._on_met(robot, hello)
            except HriError as error:
                self._complain(robot, str(error))

        with suppress(zenoh.ZError):  # It was closed meanwhile.
            session.get(f"hri/{robot}/hello", met, payload=nonce, timeout=PATIENCE)

    def _meet(self, hello: Hello, nonce: str) -> OtherClock:
        with self._guard:
            is_another = self._reader.epochs.get(hello.name) != hello.epoch
            self._reader.meet(hello, nonce)
            if is_another:  # It began again, and so did its clock.
                self._clocks[hello.name] = OtherClock()
            return self._clocks[hello.name]

    def believed(self, robot: str, sample: zenoh.Sample) -> Believed | None:
        """A message of a robot; None for one that does not count. Who is not known is greeted."""
        now, key = self._clock.now(), str(sample.key_expr)
        try:
            if sample.attachment is None or len(sample.payload) > values.LONGEST:
                raise HriError(f"{key}: a value without a seal, or a long one")
            data, sealed = sample.payload.to_bytes(), sample.attachment.to_bytes()
            with self._guard:
                envelope = self._reader.opened(robot, key, data, sealed)
                clock = self._clocks.get(robot)
            if envelope is not None and clock is not None:
                return Believed(envelope, data, clock, now)
            if self.is_due(robot):
                self.greet(robot)
        except HriError as error:
            self._complain(key, str(error))
        return None
