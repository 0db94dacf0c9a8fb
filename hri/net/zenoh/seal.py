"""Messages of a fleet that only who knows the token can have written, each good for once.

A program that joins a fleet takes a random *epoch*. Each message has it, a number that grows, and
an HMAC-SHA256 (RFC 2104) over both, the key expression and the value. An epoch is believed after a
challenge: whoever wants to believe it sends a nonce, and gets the proof of `hri.core.token` with
that nonce in it. So nothing that was recorded earlier counts again, and nothing is changed on its
way. What is said is not hidden: for that there is TLS in Zenoh's own configuration.
"""

from __future__ import annotations

import hmac
import secrets
from collections import OrderedDict
from collections.abc import Mapping

import msgspec

from hri.core.errors import HriError
from hri.core.token import Challenge, is_proof, new_nonce, proof

MOST_STREAMS = 4096
"""Keys of which the last number is remembered; the oldest is forgotten with its epoch's trust."""
REQUEST = "request"
"""What stands for the datatype of a request."""
TICKET_SECONDS = 10.0
LONGEST_ENVELOPE = 600
"""Bytes."""


class Envelope(msgspec.Struct, array_like=True, forbid_unknown_fields=True, frozen=True):
    """What goes with a value."""

    epoch: str
    number: int
    time: float
    """Seconds of the sender's clock: when it was sent."""
    made: float
    """When the value was made."""
    datatype: str
    """Empty for "there is none"."""
    meaning: str = ""
    """Of the value, as in `hri.net.zenoh.values.Row`."""
    mac: bytes = b""


class Hello(msgspec.Struct, array_like=True, forbid_unknown_fields=True, frozen=True):
    """The answer to a challenge."""

    name: str
    epoch: str
    clock: float
    """Seconds of the clock of whoever answers, now."""
    ticket: str
    """For one request."""
    proof: str


class Pen:
    """Seals what one program says."""

    def __init__(self, token: str) -> None:
        self._token = token
        self.epoch = new_nonce()
        self._number = 0

    def sealed(
        self,
        key: str,
        value: bytes,
        time: float,
        made: float,
        datatype: str,
        meaning: str = "",
    ) -> bytes:
        """The envelope of a value under a key expression; see `Envelope`."""
        self._number += 1
        envelope = Envelope(self.epoch, self._number, time, made, datatype, meaning)
        return msgspec.msgpack.encode(
            msgspec.structs.replace(envelope, mac=_mac(self._token, key, value, envelope))
        )

    def hello(self, name: str, nonce: str, clock: float, ticket: str) -> Hello:
        """The answer to a challenge with a nonce."""
        shown = proof(self._token, "server", _challenge(name, nonce, self.epoch, clock, ticket))
        return Hello(name, self.epoch, clock, ticket, shown)


class Reader:
    """Believes what others say; to be used by one thread at a time."""

    def __init__(self, token: str) -> None:
        self._token = token
        self._epochs: dict[str, str] = {}
        self._numbers: OrderedDict[str, int] = OrderedDict()

    @property
    def epochs(self) -> Mapping[str, str]:
        """The epoch of everyone who is believed, by name."""
        return self._epochs

    def meet(self, hello: Hello, nonce: str) -> None:
        """Believe whoever answered a challenge. Raises HriError where that proves nothing."""
        asked = _challenge(hello.name, nonce, hello.epoch, hello.clock, hello.ticket)
        if not is_proof(hello.proof, self._token, "server", asked):
            raise HriError(
                f'"{hello.name}" does not know the token - give both robots the same HRI_TOKEN'
            )
        if self._epochs.get(hello.name) != hello.epoch:
            self.forget(hello.name)
            self._epochs[hello.name] = hello.epoch

    def forget(self, name: str) -> None:
        """Believe nothing more of someone until the next challenge."""
        epoch = self._epochs.pop(name, None)
        for stream in [one for one in self._numbers if one.startswith(f"{epoch} ")]:
            del self._numbers[stream]

    def opened(self, name: str, key: str, value: bytes, envelope: bytes) -> Envelope | None:
        """What someone who is believed says; None for who is not, or not any more.

        Raises HriError for what is damaged, was not written by them, or came before.
        """
        found = envelope_of(envelope)
        if self._epochs.get(name) != found.epoch:
            return None
        _require_seal(self._token, key, value, found)
        self._count(key, found)
        return found

    def _count(self, key: str, found: Envelope) -> None:
        stream = f"{found.epoch} {key}"
        if found.number <= self._numbers.get(stream, 0):
            raise HriError(f"{key}: message {found.number} came before - it is dropped")
        self._numbers[stream] = found.number
        self._numbers.move_to_end(stream)
        if len(self._numbers) > MOST_STREAMS:
            oldest, _ = self._numbers.popitem(last=False)
            epoch = oldest.partition(" ")[0]
            # Without its number a message of that epoch could come again.
            for name in [name for name, one in self._epochs.items() if one == epoch]:
                self.forget(name)


class Tickets:
    """Tickets for one request each. None is kept before it is used, however many are asked for."""

    def __init__(self) -> None:
        self._secret = secrets.token_bytes(32)
        self._used: dict[str, float] = {}

    def new(self, now: float) -> str:
        """A ticket that is good for TICKET_SECONDS."""
        return self._ticket(f"{now!r}", secrets.token_urlsafe(8))

    def use(self, ticket: str, now: float) -> None:
        """Take a ticket of a request whose seal is whole. Raises HriError for any other."""
        made, _, rest = ticket.partition(" ")
        nonce = rest.partition(" ")[0]
        is_ours = hmac.compare_digest(ticket.encode(), self._ticket(made, nonce).encode())
        if not is_ours or not 0 <= now - float(made) <= TICKET_SECONDS or ticket in self._used:
            raise HriError("this ticket is not good any more - ask for another one")
        self._used = {one: used for one, used in self._used.items() if now - used <= TICKET_SECONDS}
        self._used[ticket] = now

    def _ticket(self, made: str, nonce: str) -> str:
        mac = hmac.digest(self._secret, f"{made} {nonce}".encode(), "sha256").hex()
        return f"{made} {nonce} {mac}"


def envelope_of(data: bytes) -> Envelope:
    """The envelope in these bytes. Raises HriError for any others."""
    if len(data) > LONGEST_ENVELOPE:
        raise HriError(f"an envelope of {len(data)} bytes is too long - it is dropped")
    try:
        return msgspec.msgpack.decode(data, type=Envelope)
    except (ValueError, RecursionError) as error:
        raise HriError(f"this envelope is damaged: {error}") from error


def hello_of(data: bytes) -> Hello:
    """The answer in these bytes. Raises HriError for any others."""
    if len(data) > LONGEST_ENVELOPE:
        raise HriError(f"an answer of {len(data)} bytes is too long - it is dropped")
    try:
        return msgspec.msgpack.decode(data, type=Hello)
    except (ValueError, RecursionError) as error:
        raise HriError(f"this answer is damaged: {error}") from error


def opened_request(token: str, key: str, value: bytes, envelope: bytes) -> None:
    """Raises HriError for what is not a request of who knows the token, such as an answer."""
    found = envelope_of(envelope)
    _require_seal(token, key, value, found)
    if found.datatype != REQUEST:
        raise HriError(f"{key}: a {found.datatype!r:.40} is not a request")


def _require_seal(token: str, key: str, value: bytes, found: Envelope) -> None:
    """Raises HriError for a message that was not written by who knows the token."""
    if not hmac.compare_digest(found.mac, _mac(token, key, value, found)):
        raise HriError(f"{key}: the seal is broken - give both robots the same HRI_TOKEN")


def _mac(token: str, key: str, value: bytes, of: Envelope) -> bytes:
    own = (of.epoch, of.number, of.time, of.made, of.datatype, of.meaning)
    told = ("hri fleet", key, *own, value)
    return hmac.digest(token.encode(), msgspec.msgpack.encode(told), "sha256")


def _challenge(name: str, nonce: str, epoch: str, clock: float, ticket: str) -> Challenge:
    return Challenge(nonce, epoch, f"fleet {name} {clock!r} {ticket}")
