"""The command gate in a network: all motion of the base passes here."""

from __future__ import annotations

import math
from typing import Generic, TypeVar

from hri.behavior.behavior import Behavior, Context
from hri.behavior.drive_command import counts_until
from hri.behavior.effects import NOTHING
from hri.behavior.ports import Input, InputPort, Output, OutputPort, Param
from hri.core.event_bus import EventBus
from hri.core.origin import caused_by
from hri.core.signals import RangeReading, Twist
from hri.drive.gate import ANGULAR_FACTOR, VelocityGate
from hri.drive.oncoming_watch import OncomingWatch, stopping_time
from hri.drive.velocity_limits import GateLimits, safe_speed
from hri.hal.helm import Rank
from hri.hal.motion import REST

T = TypeVar("T")

COMMAND = "drive.command"
"""The board slot in which tasks leave the Twist they want, with its time."""
MOTION = "drive.motion"
"""The board slot that holds the motion that may write commands; empty when there is none."""

LIFT = "drive.lift"
"""The board slot with what lifts a spoken stop for an order that was said at a time, in seconds."""

_USUAL = GateLimits()
_SLACK = 0.03
"""Meters a second by which it may be too fast for who comes and still slows down gently."""


class CommandGate(Behavior):
    """Limits what the base is asked for, stops it at obstacles and when nobody asks any more.

    What rests on the word of someone outside, such as a peer over the network, counts for
    `PATIENCE` seconds after that word. A linked sensor that says nothing for `timeout_s` counts as
    an obstacle that touches, a linked switch as pressed. While any network is paused, the base
    rests: one that is silent might have said "slower".

    All range sensors of the configuration, linked or not, are watched for someone who comes. Then
    it goes only so fast that it stands before they are here, and where that is too late for
    slowing down gently it sends nothing, which brakes the base at once.
    """

    keeps_inputs = False
    category = "drive"

    may_do = NOTHING
    max_linear = Param(_USUAL.max_linear, "meters a second", minimum=0.01, maximum=2)
    max_angular = Param(_USUAL.max_angular, "radians a second", minimum=0.01, maximum=6)
    acceleration = Param(_USUAL.acceleration, "meters a second squared", minimum=0.05, maximum=5)
    deceleration = Param(_USUAL.deceleration, "meters a second squared", minimum=0.05, maximum=10)
    timeout_s = Param(
        _USUAL.timeout_s,
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
        "for the base, at every tick but those in which it brakes, with the rank of whoever asks:"
        " a task or a behavior",
    )

    def start(self, context: Context) -> None:
        self._slot, self._paused = context.board.slot(self.slot), context.paused
        self._motion = context.board.slot(MOTION)
        self._gate = VelocityGate(self._limits())
        self._reporter = MotionReporter(context.events)
        self._ranges = _LastWords(self.range, self.timeout_s)
        self._bumps = _LastWords(self.bump, self.timeout_s)
        self._taken: tuple[Twist, float] | None = None
        self._asker = ""
        """The rank of whoever asked last; an empty one is that of the network."""
        self._origin = ""
        """Of the last command."""
        self._was_bumped = False
        self._must_let_go = False
        self._subscription = context.events.subscribe("drive.halt", lambda event: self.halt())
        self._watch = OncomingWatch(context.resources)
        self._brakes_until = -math.inf

    def compute(self, now: float, dt: float) -> None:
        """Take the command, look ahead, limit, send, report: in this order."""
        if self._paused:
            self._gate.halt("paused")
        elif now > min(counts_until(self.twist), counts_until(self.speed)):
            self._gate.halt("timeout")
        else:
            self._take_command(now)
        if self._must_brake(now, dt):
            self._gate.brake(now)
        else:
            self.velocity.send(self._passed(now))
            self.velocity.rank = self._rank(now)
        with caused_by(self._origin):
            self._reporter.report(self._gate, now)

    def stop(self) -> None:
        self._subscription.cancel()
        self.halt()
        self._watch.release()

    def halt(self) -> None:
        """Stop at once, end the motion of any task and forget all commands.

        A network that keeps asking for motion is heard again only after it has let go once.
        """
        self._drop("halt")

    @property
    def is_moving(self) -> bool:
        return self._gate.is_moving

    @property
    def braking(self) -> Twist:
        """How fast it slows down, m/s² and rad/s²."""
        return Twist(self.deceleration, self.deceleration * ANGULAR_FACTOR)

    def _limits(self) -> GateLimits:
        return GateLimits(
            self.max_linear, self.max_angular, self.acceleration, self.deceleration, self.timeout_s
        )

    def _drop(self, reason: str) -> None:
        self._slot.clear()
        self._motion.clear()
        self._gate.halt(reason)
        self._must_let_go = True

    def _take_command(self, now: float) -> None:
        twist = self.twist.value
        if twist is None or twist == REST:
            self._must_let_go = False
        if twist is not None:
            if not self._must_let_go:
                self._gate.command(twist, now)
                self._asker = ""
                self._origin = self.twist.origin
            return
        command, time = self._slot.get()
        if command is not None and (command, time) != self._taken:
            self._taken = (command, time)
            self._gate.command(command, time)
            self._asker = Rank.TASKS
            self._origin = ""

    def _rank(self, now: float) -> str:
        """Of who asks; a network that asks for rest asks, too, and a task that does has ended."""
        if self.twist.value is not None:
            return ""
        return self._asker if self._gate.is_asked(now) else Rank.NOBODY

    def _must_brake(self, now: float, dt: float) -> bool:
        """Whether somebody comes before whom it could not slow down gently."""
        going = self._gate.current
        self._watch.look(now, going, dt)
        if abs(going.linear) > self._watch.speed(now) + _SLACK:
            self._brakes_until = now + stopping_time(going) + dt
        return now < self._brakes_until

    def _passed(self, now: float) -> Twist:
        """What is left of the command within all limits."""
        speed = self.speed.value
        return self._gate.velocity(
            now,
            speed=1.0 if speed is None else speed,
            max_forward=self._max_forward(now),
            fastest=min(self._watch.speed(now), self._watch.pace(now)),
        )

    def _max_forward(self, now: float) -> float:
        """How fast it may go forward, in m/s; a touch ends a motion for good."""
        is_bumped = any(pressed is not False for pressed in self._bumps.at(now))
        # The ring does not tell which side it was touched on, so any motion ends.
        if is_bumped and not self._was_bumped and self._gate.is_moving:
            self._drop("bump")
        self._was_bumped = is_bumped
        if is_bumped:
            return 0.0
        is_moving = self._gate.current.linear > 0
        return min(
            (
                safe_speed(
                    self._distance(reading, now),
                    self.clearance,
                    self.deceleration,
                    is_moving,
                    reaction=0.0,
                )
                for reading in self._ranges.at(now)
            ),
            default=math.inf,
        )

    def _distance(self, reading: RangeReading | None, now: float) -> float:
        """Meters; a sensor that has stopped reporting might look at anything."""
        if reading is not None and now - reading.time <= self.timeout_s:
            return reading.distance
        return 0.0


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


class MotionReporter:
    """Raises `drive.commanded` and `drive.stopped`, the former at most twice a second."""

    _INTERVAL_S = 0.5
    _NOTABLE_LINEAR = 0.1
    _NOTABLE_ANGULAR = 0.3

    def __init__(self, events: EventBus) -> None:
        self._events = events
        self._reported = REST
        self._time = -math.inf

    def report(self, gate: VelocityGate, now: float) -> None:
        if gate.target != REST:
            if self._is_news(gate.target, now):
                self._reported, self._time = gate.target, now
                self._events.raise_event(
                    "drive.commanded",
                    linear=_rounded(gate.target.linear),
                    angular=_rounded(gate.target.angular),
                )
        elif not gate.is_moving and self._reported != REST:
            self._reported = REST
            with caused_by(""):  # also an obstacle, or the end of its patience, may be why
                self._events.raise_event("drive.stopped", reason=gate.reason)

    def _is_news(self, target: Twist, now: float) -> bool:
        if self._reported == REST:
            return True
        linear = abs(target.linear - self._reported.linear)
        angular = abs(target.angular - self._reported.angular)
        has_changed = linear >= self._NOTABLE_LINEAR or angular >= self._NOTABLE_ANGULAR
        return has_changed and now - self._time >= self._INTERVAL_S


def _rounded(value: float) -> float:
    """To four places, never minus zero."""
    return round(value, 4) + 0.0
