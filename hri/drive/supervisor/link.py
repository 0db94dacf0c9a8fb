"""What a program and the supervisor of its base say to each other, each message one packet.

The program asks, and every packet of it is answered by a `State`. Each order carries `echo`, the
time of the last State that the program has read: so the supervisor knows how old an order is at
most, by its own clock, however long it lay in a queue, and a program that stands still falls
silent. Packets travel through a socket pair that the supervisor's process inherits; nothing
listens on any network.
"""

from __future__ import annotations

import json
import socket
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Final, TypeVar

from hri.core.signals import Twist
from hri.drive.bases.protocol import BaseReport, Note
from hri.drive.supervisor.cause import POWER_UP, Cause
from hri.drive.velocity_limits import Cap
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import REST, Way
from hri.hal.rank import Rank

NOTHING: Final = Cap(0.0, 0.0, 0.0)
LARGEST: Final = 65536
"""Bytes of a packet."""
MOST: Final = 64
"""Packets that are read at once; a flood must not keep the supervisor from its base."""
LONGEST_WORDS: Final = 200
"""Characters of a cause that a program may give."""


@dataclass(frozen=True, slots=True)
class Heartbeat:
    """Asks for only the State: the program's heartbeat."""

    echo: float


@dataclass(frozen=True, slots=True)
class Ask:
    """A velocity; None takes back what this source asked for before."""

    source: Rank
    twist: Twist | None
    echo: float
    manner: Manner = FREELY


@dataclass(frozen=True, slots=True)
class Brake:
    """Stand still at once."""

    echo: float


@dataclass(frozen=True, slots=True)
class Trip:
    """Stand still at once, and stay so until a release."""

    cause: Cause


@dataclass(frozen=True, slots=True)
class Release:
    """Someone says that the base may move, although it was stopped for this cause."""

    echo: float
    cause: Cause


@dataclass(frozen=True, slots=True)
class Nearest:
    """How far the nearest person is, meters; infinite when surely nobody is about."""

    distance: float
    echo: float


@dataclass(frozen=True, slots=True)
class Song:
    """Play a tune."""

    notes: tuple[Note, ...]


@dataclass(frozen=True, slots=True)
class Lamps:
    """Light the power lamp from green (0) to red (1), and the dock's."""

    power: float
    is_dock_lit: bool


@dataclass(frozen=True, slots=True)
class Dock:
    """Drive to the charging station by itself."""

    echo: float


Extra = Song | Lamps | Dock
"""What only some bases can do."""
Order = Heartbeat | Ask | Brake | Trip | Release | Nearest | Extra


@dataclass(frozen=True, slots=True)
class Numbered:
    """Something that happened, with its number since the supervisor began."""

    number: int
    cause: Cause


@dataclass(frozen=True, slots=True)
class State:
    """All that a program may know of its base."""

    time: float
    """Seconds of the supervisor's clock."""
    report: BaseReport | None = None
    """The newest; `time` of it is the supervisor's too, `rolled` goes on after a lost port."""
    velocity: Twist = REST
    """What the wheels were told last."""
    level: Rank = Rank.LATCH
    reason: Cause = POWER_UP
    is_latched: bool = True
    is_open: bool = False
    """Whether the port is."""
    trouble: str = ""
    """Why the port is not open: problem - remedy."""
    allowed: Cap = NOTHING
    """The fastest that is allowed just now, by who is near; an obstacle may allow less."""
    waiting: tuple[Rank, ...] = ()
    """Sources that ask for something, the one that is heard first."""
    faults: tuple[str, ...] = ()
    """Sensors that cannot be believed: "my left bumper says nothing"."""
    news: tuple[Numbered, ...] = field(default=())
    """The last stops and refusals."""
    target: Twist = REST
    """The velocity that `velocity` leads to."""


class Packets:
    """One end of the line between a program and its supervisor; never blocks, never raises."""

    def __init__(self, line: socket.socket) -> None:
        self._line = line
        self.is_over = False
        """Whether the other side is gone."""
        line.setblocking(False)

    def fileno(self) -> int:
        """Its descriptor, to wait for."""
        return self._line.fileno()

    def send(self, packet: bytes) -> bool:
        """Whether it was sent; one that finds the line full is dropped."""
        try:
            return self._line.send(packet) == len(packet)
        except (BlockingIOError, InterruptedError):
            return False
        except OSError:
            self.is_over = True
            return False

    def receive(self) -> list[bytes]:
        """What has come, at most MOST packets."""
        packets: list[bytes] = []
        while len(packets) < MOST and not self.is_over:
            try:
                packet = self._line.recv(LARGEST)
            except (BlockingIOError, InterruptedError):
                break
            except OSError:
                packet = b""
            if packet:
                packets.append(packet)
            else:
                self.is_over = True
        return packets

    def close(self) -> None:
        """Hang up; a second call does nothing."""
        self.is_over = True
        self._line.close()


def pair() -> tuple[socket.socket, socket.socket]:
    """Both ends of a line that keeps packets apart."""
    return socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)


def encoded(message: Order | State) -> bytes:
    """A message as a packet."""
    return json.dumps({type(message).__name__: asdict(message)}).encode()


def decoded_order(packet: bytes) -> Order | None:
    """The order in a packet; None for an invalid one."""
    return _decoded(packet, _ORDERS)


def decoded_state(packet: bytes) -> State | None:
    """The state in a packet; None for an invalid one."""
    return _decoded(packet, {"State": _state})


M = TypeVar("M")
Fields = Mapping[str, Any]


def _decoded(packet: bytes, kinds: Mapping[str, Callable[[Fields], M]]) -> M | None:
    try:
        ((name, fields),) = json.loads(packet).items()
        return kinds[name](fields)
    except (ValueError, KeyError, TypeError, AttributeError, ArithmeticError, RecursionError):
        return None


def _twist(fields: Fields | None) -> Twist | None:
    return None if fields is None else Twist(float(fields["linear"]), float(fields["angular"]))


def _manner(fields: Fields) -> Manner:
    return Manner(
        Twist(**fields["fastest"]),
        Twist(**fields["acceleration"]),
        Twist(**fields["deceleration"]),
        float(fields["free"]),
        float(fields["clearance"]),
    )


def _cause(fields: Fields) -> Cause:
    name, because = str(fields["name"]), str(fields["because"])
    said = None if fields["said"] is None else float(fields["said"])
    return Cause(name[:LONGEST_WORDS], because[:LONGEST_WORDS], said)


_ORDERS: Mapping[str, Callable[[Fields], Order]] = {
    "Heartbeat": lambda f: Heartbeat(float(f["echo"])),
    "Ask": lambda f: Ask(
        Rank(f["source"]), _twist(f["twist"]), float(f["echo"]), _manner(f["manner"])
    ),
    "Brake": lambda f: Brake(float(f["echo"])),
    "Trip": lambda f: Trip(_cause(f["cause"])),
    "Release": lambda f: Release(float(f["echo"]), _cause(f["cause"])),
    "Nearest": lambda f: Nearest(float(f["distance"]), float(f["echo"])),
    "Song": lambda f: Song(tuple(Note(int(n["pitch"]), float(n["duration"])) for n in f["notes"])),
    "Lamps": lambda f: Lamps(float(f["power"]), bool(f["is_dock_lit"])),
    "Dock": lambda f: Dock(float(f["echo"])),
}


def _state(fields: Fields) -> State:
    velocity = _twist(fields["velocity"])
    return State(
        time=float(fields["time"]),
        report=_report(fields["report"]),
        velocity=REST if velocity is None else velocity,
        target=Twist(**fields["target"]),
        level=Rank(fields["level"]),
        reason=_cause(fields["reason"]),
        is_latched=bool(fields["is_latched"]),
        is_open=bool(fields["is_open"]),
        trouble=str(fields["trouble"]),
        allowed=Cap(**fields["allowed"]),
        waiting=tuple(map(Rank, fields["waiting"])),
        faults=_texts(fields["faults"]),
        news=tuple(Numbered(int(n["number"]), _cause(n["cause"])) for n in fields["news"]),
    )


def _report(fields: Fields | None) -> BaseReport | None:
    if fields is None:
        return None
    told = {**fields, "rolled": Way(**fields["rolled"]), "velocity": _twist(fields["velocity"])}
    return BaseReport(**told)


def _texts(values: Sequence[Any]) -> tuple[str, ...]:
    return tuple(map(str, values))
