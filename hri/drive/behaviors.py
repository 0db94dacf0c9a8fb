"""The command gate in a network: all motion of the base passes here."""

from __future__ import annotations

import math
from typing import Generic, TypeVar

from hri.behavior.behavior import Behavior, Context
from hri.behavior.drive_command import counts_until
from hri.behavior.effects import NOTHING
from hri.behavior.ports import Input, InputPort, Output, OutputPort, Param
from hri.core.signals import RangeReading, Twist
from hri.drive.supervisor.announcement import Announcer, announced
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.manner import UNBOUND, Manner
from hri.hal.motion import REST
from hri.hal.rank import Rank

T = TypeVar("T")

COMMAND = "drive.command"
"""The board slot in which tasks leave the Twist they want, with its time."""
MOTION = "drive.motion"
"""The board slot that holds the motion that may write commands; empty when there is none."""
LIFT = "drive.lift"
"""The board slot with what lifts a spoken stop for an order that was said at a time, in seconds."""
ANGULAR_FACTOR = 4.0
"""Turning may change this many times as fast, in radians, as driving does in meters: on a base with
wheels half a meter apart both ask the same of the wheels."""


class CommandGate(Behavior):
    """Chooses what the base is asked for, and says how that is to be carried out.

    It shapes nothing itself: its bounds travel with the command, and the supervisor of the base
    keeps to them. It knows which command goes first, how old that is, and when a touch ends a
    motion for good.

    What rests on the word of someone outside, such as a peer over the network, counts for
    `PATIENCE` seconds after that word. A linked sensor that says nothing for `timeout_s` counts as
    an obstacle that touches, a linked switch as pressed. While any network is paused, the base
    rests: one that is silent might have said "slower".
    """

    keeps_inputs = False
    category = "drive"

    may_do = NOTHING
    max_linear = Param(0.4, "meters a second", minimum=0.01, maximum=2)
    max_angular = Param(1.2, "radians a second", minimum=0.01, maximum=6)
    acceleration = Param(0.4, "meters a second squared", minimum=0.05, maximum=5)
    deceleration = Param(0.5, "meters a second squared", minimum=0.05, maximum=10)
    timeout_s = Param(
        0.5,
        "seconds without a command or a sensor's word until it stops",
        minimum=0.05,
        maximum=0.5,
    )
    clearance = Param(0.25, "meters kept free ahead", minimum=0, maximum=2)
    slot = Param(COMMAND, "board slot with the commands of tasks")

    twist = Input[Twist]("twist", "a command of the network; goes before those of tasks")
    speed = Input[float]("double", "factor on every command")
    range = Input[RangeReading]("range", "sensors that look ahead; any number")
    bump = Input[bool]("boolean", "switches that stop driving forward; any number")
    velocity = Output[Twist](
        "twist",
        "for the base, at every tick, with the rank of whoever asks, a task or a behavior, and the"
        " bounds of this gate",
    )

    def start(self, context: Context) -> None:
        self._slot, self._paused = context.board.slot(self.slot), context.paused
        self._motion = context.board.slot(MOTION)
        self._ranges = _LastWords(self.range, self.timeout_s)
        self._bumps = _LastWords(self.bump, self.timeout_s)
        self._command, self._asked_at = REST, -math.inf
        self._taken: tuple[Twist, float] | None = None
        self._asker = ""
        """The rank of whoever asked last; an empty one is that of the network."""
        self._origin = ""
        """Of the last command."""
        self._is_asked = False
        """Whether someone asks for motion, or the base has not come to rest since."""
        self._was_bumped = False
        self._must_let_go = False
        self._subscription = context.events.subscribe("drive.halt", lambda event: self.halt())
        self._because = ""
        """Why it asks for rest; empty where that is what it was asked."""
        self._context = context
        self._base: BaseBus | None = None
        self._announcer: Announcer | None = None

    def compute(self, now: float, dt: float) -> None:
        """Take the command, feel, send it with its bounds: in this order."""
        if self._base is None:
            self._find_base()
        if self._paused:
            self._rest("paused")
        elif now > min(counts_until(self.twist), counts_until(self.speed)):
            self._rest("timeout")
        else:
            self._take_command(now)
        is_bumped = self._feel(now)
        self.velocity.send(self._wish(now))
        self.velocity.rank = self._rank(now)
        self.velocity.manner = self._manner(now, is_bumped)
        if self._announcer is not None:
            self._announcer.origin, self._announcer.because = self._origin, self._because

    def stop(self) -> None:
        self._subscription.cancel()
        self.halt()
        if self._announcer is not None:
            self._announcer.stop()
        self._base = self._announcer = None

    def halt(self) -> None:
        """Stop at once, end the motion of any task and forget all commands.

        A network that keeps asking for motion is heard again only after it has let go once.
        """
        self._drop("halt")

    @property
    def is_moving(self) -> bool:
        """Whether the base is told to move."""
        return self._base is not None and self._base.state.velocity != REST

    @property
    def braking(self) -> Twist:
        """How fast it slows down, m/s² and rad/s²."""
        return Twist(self.deceleration, self.deceleration * ANGULAR_FACTOR)

    @property
    def factor(self) -> float:
        """What it multiplies every command by."""
        return 1.0 if self.speed.value is None else self.speed.value

    def _drop(self, reason: str) -> None:
        self._slot.clear()
        self._motion.clear()
        self._rest(reason)
        self._must_let_go = True

    def _rest(self, reason: str) -> None:
        """Ask for nothing until another command comes."""
        self._command, self._asked_at = REST, -math.inf
        self._because = reason

    def _take_command(self, now: float) -> None:
        twist = self.twist.value
        if twist is None or twist == REST:
            self._must_let_go = False
        if twist is not None:
            if not self._must_let_go:
                self._ask(twist, now)
                self._asker = ""
                self._origin = self.twist.origin
            return
        command, time = self._slot.get()
        if command is not None and (command, time) != self._taken:
            self._taken = (command, time)
            self._ask(command, time)
            self._asker = Rank.TASKS
            self._origin = ""

    def _ask(self, twist: Twist, time: float) -> None:
        self._command, self._asked_at, self._because = twist, time, ""

    def _wish(self, now: float) -> Twist:
        """The command and the factor on it; rest when the command is too old."""
        if now - self._asked_at > self.timeout_s:
            if self._command != REST:
                self._rest("timeout")
            return REST
        return Twist(self._command.linear * self.factor, self._command.angular * self.factor)

    def _rank(self, now: float) -> str:
        """Of who asks; a network that asks for rest asks, too, and a task that does has ended."""
        if self.twist.value is not None:
            return ""
        self._is_asked = self._command != REST or (self._is_asked and self.is_moving)
        return self._asker if self._is_asked else Rank.NOBODY

    def _feel(self, now: float) -> bool:
        """Whether something touches it; a touch ends a motion for good.

        A switch does not tell which side it was touched on, so any motion ends.
        """
        is_bumped = any(pressed is not False for pressed in self._bumps.at(now))
        if is_bumped and not self._was_bumped and (self.is_moving or self._command != REST):
            self._drop("bump")
        self._was_bumped = is_bumped
        return is_bumped

    def _manner(self, now: float, is_bumped: bool) -> Manner:
        """The bounds of this gate, and what is free ahead of the sensors that are linked to it.

        A halt slows down as the base does, not as gently as a motion that ends.
        """
        distances = [self._distance(reading, now) for reading in self._ranges.at(now)]
        return Manner(
            Twist(self.max_linear, self.max_angular),
            Twist(self.acceleration, self.acceleration * ANGULAR_FACTOR),
            UNBOUND if self._because else self.braking,
            0.0 if is_bumped else min(distances, default=math.inf),
            self.clearance,
        )

    def _distance(self, reading: RangeReading | None, now: float) -> float:
        """Meters; a sensor that has stopped reporting might look at anything."""
        if reading is not None and now - reading.time <= self.timeout_s:
            return reading.distance
        return 0.0

    def _find_base(self) -> None:
        """Know how the base moves, as soon as some drive of it is open."""
        base = next(iter(self._context.resources.opened(BaseBus)), None)
        if base is not None:
            self._base, self._announcer = base, announced(base, self._context)


class _LastWords(Generic[T]):
    """What each link of a port carried last; a sensor may be slower than the gate, not silent."""

    def __init__(self, port: InputPort[T], patience: float) -> None:
        """`patience`: seconds that a value counts for."""
        self._port, self._patience = port, patience
        self._heard: dict[OutputPort[T], tuple[T | None, float]] = {}

    def at(self, now: float) -> list[T | None]:
        """A value for each link, None for one that is silent."""
        # Made again each time, so that what was injected for one tick is forgotten after it.
        self._heard = {source: self._last_of(source, now) for source in self._port.sources}
        return [
            value if now - time <= self._patience else None for value, time in self._heard.values()
        ]

    def _last_of(self, source: OutputPort[T], now: float) -> tuple[T | None, float]:
        if source.value is not None:
            return source.value, now
        return self._heard.get(source, (None, now))
