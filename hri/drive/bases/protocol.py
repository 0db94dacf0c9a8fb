"""The protocol of a base on a serial line, and its reports.

A protocol is arithmetic on bytes: it owns no port and no clock, and time is an argument. The owner
of the port writes `greeting`, `velocity`, `stop` and `poll`, and passes incoming bytes to `feed`.
What arrives may be late, lost, damaged or not from a base at all.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, Self

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Twist
from hri.hal.motion import Way
from hri.hal.resource import Description
from hri.hal.wheels import WheelPair

OBEYING = ("safe", "full", "ready")
"""The modes in which a base follows velocities."""


@dataclass(frozen=True, slots=True)
class BaseReport:
    """What a base says of itself at a moment; a mapping has only the sensors that it has."""

    time: float
    """Seconds, when its last byte came."""
    rolled: Way
    """How far the wheels have carried the base since the protocol was made."""
    velocity: Twist | None
    """What the wheels measure; None while that is not known."""
    bumps: Mapping[str, bool] = field(default_factory=dict)
    """By place: "left", "right"; true when something presses."""
    cliffs: Mapping[str, bool] = field(default_factory=dict)
    """By place: "left", "front_left", "front_right", "right"; true when there is no floor."""
    cliff_signals: Mapping[str, int] = field(default_factory=dict)
    """Raw readings of the same sensors: light from the floor, where the base reports it."""
    wheel_drops: Mapping[str, bool] = field(default_factory=dict)
    """By place: "left", "right"; true when the wheel hangs in the air."""
    buttons: Mapping[str, bool] = field(default_factory=dict)
    """By name: "clean", "stop"; true while someone presses it."""
    ranges: Mapping[str, float] = field(default_factory=dict)
    """Meters from the sensor; infinity when it sees nothing."""
    battery: float | None = None
    """0 (empty) to 1 (full); None while that is not known."""
    voltage: float | None = None
    """Volts; None while that is not known."""
    battery_fault: str = ""
    """What the base says of its battery that cannot be: "says 65529 of 2696 mAh"."""
    is_charging: bool = False
    mode: str = "off"
    """"off", "passive", or one of OBEYING."""

    @property
    def obeys(self) -> bool:
        """Whether the base follows velocities."""
        return self.mode in OBEYING


def within(value: float | None, least: float, most: float) -> float | None:
    """A value that can be; None for one that is not known, not a number, or out of its range."""
    return value if value is not None and least <= value <= most else None


@dataclass(frozen=True, slots=True)
class Greeting:
    """A step that brings a base into the state in which it obeys."""

    data: bytes
    pause: float = 0.0
    """Seconds to wait before the next step."""
    rts: bool | None = None
    """What becomes of the wire "request to send"; None leaves it as it is."""


@dataclass(frozen=True, slots=True)
class Sensors:
    """The names of what a base will report."""

    bumps: tuple[str, ...] = ()
    cliffs: tuple[str, ...] = ()
    cliff_signals: tuple[str, ...] = ()
    wheel_drops: tuple[str, ...] = ()
    buttons: tuple[str, ...] = ()
    ranges: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Note:
    """A note of a song."""

    pitch: int
    """As in MIDI: 60 is the middle C, 69 is 440 Hz; 31 to 127."""
    duration: float
    """Seconds."""


class BaseProtocol(ABC):
    """One kind of base. A new object for each opening of the port: it remembers what came."""

    title: ClassVar[str]
    """What people call it."""
    parameters: ClassVar[tuple[str, ...]] = ()
    """Names of the parameters that `described` understands."""
    baud: ClassVar[int]
    period: ClassVar[float]
    """Seconds between two reports when all goes well, and the least between two velocities."""
    timeout: ClassVar[float | None]
    """Seconds without a velocity after which the base stops by itself; None when it never does."""
    boot: ClassVar[float] = 0.0
    """Seconds that a base may be deaf after its port was opened."""
    question: ClassVar[bytes]
    """Asks what base is there; it never moves one."""
    resync: ClassVar[bytes] = b""
    """Ends a command whose rest was lost, so that the next one is not taken for it; goes before
    each velocity. Alone it means nothing."""
    farewell: ClassVar[bytes] = b""
    """Leaves the base to itself, standing and silent."""
    senseless: int = 0
    """Bytes fed so far that belong to nothing that such a base says."""
    track: float
    """Meters between the wheels."""
    limits: Twist
    """The fastest that the hardware goes straight on and on the spot, m/s and rad/s."""
    sensors: Sensors

    @classmethod
    @abstractmethod
    def described(cls, description: Description) -> Self:
        """The protocol of the base that a configuration describes. Raises AuthoringError."""

    @classmethod
    @abstractmethod
    def recognizes(cls, answer: bytes) -> bool:
        """Whether what came after the question can only be from such a base."""

    @abstractmethod
    def greeting(self) -> Sequence[Greeting]:
        """What brings it into the state in which it obeys, standing still.

        To be said when the port is open, and again when reports cease or the base does not obey.
        """

    def waking(self) -> Sequence[Greeting]:
        """What may wake a base that sleeps; to be said before it is greeted again."""
        return ()

    @abstractmethod
    def velocity(self, twist: Twist) -> bytes:
        """Go on with this velocity, along the same curve where the hardware is slower.

        Raises HriError for what is not finite.
        """

    @property
    @abstractmethod
    def stop(self) -> bytes:
        """Stand still."""

    @property
    @abstractmethod
    def emergency_stop(self) -> bytes:
        """Stand still, even after a command whose writer was killed halfway."""

    def _rims(self, twist: Twist) -> tuple[float, float]:
        """Velocities of the left and the right wheel, m/s, for a velocity cut to `limits`."""
        half, slowed = self.track / 2, self._slowed(twist)
        return WheelPair(half, -half).rolling(slowed.linear, slowed.angular)

    def _slowed(self, twist: Twist) -> Twist:
        """A velocity cut to `limits`. Raises HriError for what is not finite.

        The faster wheel rolls with |v| + |w| track / 2; where that is too fast, both are slowed
        down alike, which keeps the curve.
        """
        if not (math.isfinite(twist.linear) and math.isfinite(twist.angular)):
            what = f"a velocity of {twist.linear} m/s and {twist.angular} rad/s"
            raise HriError(f"{self.title}: {what} - send finite numbers")
        faster = abs(twist.linear) + abs(twist.angular) * self.track / 2
        share = min(1.0, self.limits.linear / faster) if faster else 1.0
        return Twist(twist.linear * share, twist.angular * share)

    def poll(self, now: float) -> bytes:
        """What to ask now; nothing when the base speaks by itself, or still owes an answer."""
        return b""

    @abstractmethod
    def feed(self, data: bytes, now: float) -> list[BaseReport]:
        """The reports that these bytes complete; what is lost or damaged is left out.

        Never raises, whatever comes, and remembers less than a kilobyte of it.
        """

    def song(self, notes: Sequence[Note]) -> bytes:
        """Play a tune. Raises NotAvailable without a loudspeaker, HriError for what it cannot."""
        raise NotAvailable(f"{self.title}: it has no loudspeaker - leave the song out")

    def leds(self, power: float, is_dock_lit: bool = False) -> bytes:
        """Light the power lamp from green (0) to red (1), and the dock's. Raises NotAvailable."""
        raise NotAvailable(f"{self.title}: it has no lamps - leave them out")

    def dock(self) -> bytes:
        """Drive to the charging station by itself; it then no longer obeys. Raises NotAvailable."""
        raise NotAvailable(f"{self.title}: it finds no dock by itself - drive it there")
