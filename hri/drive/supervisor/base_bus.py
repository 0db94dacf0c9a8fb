"""A real base as resources: what a program holds in its hand, above the supervisor.

    <DeviceBus id="base" type="Hri.Create2">
      <Parameter name="port" value="/dev/ttyUSB0"/>
      <Device id="drive" type="Hri.BaseDrive"/>
      <Device id="odometry" type="Hri.BaseOdometry"/>
      <Device id="bumper" type="Hri.BaseBumper"/>
      <Device id="cliff_left" type="Hri.BaseCliffSensor">
        <Parameter name="sensor" value="left"/>
      </Device>
    </DeviceBus>

The `devices` are the same for every base; each kind of base has its own bus. With
the port "simulated" the base is an emulated one in the simulated world.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from functools import cached_property
from typing import ClassVar

from hri.core.clock import Timer
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Pose2D, Twist
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Note
from hri.drive.supervisor.base_rules import rules
from hri.drive.supervisor.cause import NO_SUPERVISOR, POWER_UP, Cause
from hri.drive.supervisor.controller import Controller
from hri.drive.supervisor.free_space import Body
from hri.drive.supervisor.line import BaseLine
from hri.drive.supervisor.link import (
    LONGEST_WORDS,
    Ask,
    Brake,
    Dock,
    Lamps,
    Nearest,
    Order,
    Release,
    Song,
    State,
    Trip,
)
from hri.drive.supervisor.supervisor import Supervisor
from hri.drive.supervisor.supervisor_connection import BEAT, Inline, SupervisorConnection
from hri.drive.velocity_limits import BaseLimits
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.manner import FREELY, Manner
from hri.hal.motion import Response, Way
from hri.hal.range_sensor import RangeSensor
from hri.hal.rank import Rank
from hri.hal.resource import Description, Resources

SIMULATED = "simulated"
"""The port of a base that is emulated in the simulated world."""
STALE = 0.5
"""Seconds after which the program's sensors ignore a report."""
UNLATCHING = 5.0
"""Seconds that a release waits for a base that does not report yet."""
_LIMITS = {limit.name: float(getattr(BaseLimits(), limit.name)) for limit in fields(BaseLimits)}
_BODY = {side.name: float(getattr(Body(), side.name)) for side in fields(Body)}
LIMITS = (*_LIMITS, *_BODY)
"""Parameters of a base, whatever its hardware."""
_LEAST, _MOST = {"clearance": 0.0}, {"jerk": 100.0, "angular_jerk": 500.0}

Watcher = Callable[[State], object]


class BaseBus(EmergencyStop):
    """A base on a serial port, with its supervisor; the devices of the base sit on this bus.

    Parameters: `port`, those of the protocol, the fields of `BaseLimits` and of `Body` (SI units
    and radians; without them the body is the box that the configuration gives as dimensions).

    After it was opened, after a lost port, and after its supervisor died and another has taken its
    place, the base does not move until `unlatch`.
    """

    protocol: ClassVar[type[BaseProtocol]]
    """What the base speaks."""
    line: ClassVar[str]
    """Type of the resource that emulates this base."""
    # The supervisor limits the jerk, and the line takes its time: what is told shows 75 ms later.
    # The wheels of a Create 2 count 0.44 mm, and turn at whole mm/s.
    response: ClassVar[Response] = Response(3.0, 0.075, 0.075, Way(0.002, math.radians(0.4)))
    """How the base follows what it is told."""
    parameters: ClassVar[tuple[str, ...]] = ("port", *LIMITS)

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.parameters = (*BaseBus.parameters, *cls.protocol.parameters)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        cls.protocol.described(description)
        refuse_wrong_limits(description)
        if not description.text("port"):
            raise description.error("port", "no port is given", "name one, such as /dev/ttyUSB0")

    def __init__(self, description: Description, manager: Resources) -> None:
        super().__init__(description, manager)
        self._watchers: list[Watcher] = []
        self._unlatching: tuple[Cause, float] | None = None
        self._stopping: Cause | None = None
        """Why it must stop; said until the supervisor has heard it."""
        self._has_begun = False
        self._cause = POWER_UP
        """Why it begins latched: what held it when it was closed."""
        self._timer: Timer | None = None

    # --- for people and programs ---

    @property
    def state(self) -> State:
        """What the supervisor said last."""
        return self._connection.state

    @property
    def is_latched(self) -> bool:
        return self._stopping is not None or self.state.is_latched

    def stop_latched(self, because: str) -> None:
        self._stop(Cause("e-stop", because[:LONGEST_WORDS]))

    def stop_spoken(self, because: str, said: float) -> None:
        self._stop(Cause("e-stop", because[:LONGEST_WORDS], said))

    def _stop(self, cause: Cause) -> None:
        self._unlatching, self._stopping = None, cause
        self._say(Trip(cause))  # whatever is known of the base, which may be old
        self._poll()

    @property
    def is_spoken(self) -> bool:
        state = self.state
        return self._stopping is None and state.is_latched and state.reason.said is not None

    def unlatch(self) -> None:
        """Let the base move, because a person says so.

        A base that does not report yet is released as soon as it does, within UNLATCHING seconds.
        """
        self._stopping = None
        self._release(self.state.reason)

    def unlatch_spoken(self, said: float) -> bool:
        cause = self.state.reason
        is_lifted = self.is_spoken and cause.said is not None and said > cause.said
        if is_lifted:
            self._release(cause)  # void if the supervisor knows of a newer stop
        return is_lifted

    def _release(self, cause: Cause) -> None:
        self._unlatching = cause, self.manager.clock.now() + UNLATCHING
        self._poll()

    def teleop(self, twist: Twist) -> None:
        """Drive by hand: goes before networks and tasks; to be repeated within 0.2 s."""
        self.ask(Rank.TELEOP, twist)

    def hear_person(self, distance: float) -> None:
        """How far the nearest person is, meters; infinity when surely nobody is about.

        To be repeated every second, otherwise someone may be near.
        """
        self._say(Nearest(distance, self.state.time))

    def song(self, notes: Sequence[Note]) -> None:
        """Play a tune, of 16 notes at most on a Create 2.

        Raises NotAvailable without a loudspeaker, HriError for a note that it cannot play.
        """
        self._protocol().song(notes)
        self._order(Song(tuple(notes)))

    def leds(self, power: float, is_dock_lit: bool = False) -> None:
        """Light the power lamp from green (0) to red (1), and the dock's. Raises NotAvailable."""
        self._protocol().leds(power, is_dock_lit)
        self._order(Lamps(power, is_dock_lit))

    def dock(self) -> None:
        """Let it drive to its charging station by itself, latched: `stop_latched` ends that.

        Raises NotAvailable where it finds none by itself, HriError while it is latched.
        """
        self._protocol().dock()
        if self.state.is_latched:
            raise HriError(f"{self.id}: {self.explain()} - unlatch the base first")
        self._order(Dock(self.state.time))

    def explain(self) -> str:
        state = self.state
        if state.is_latched:
            return state.reason.words
        stops = [news.cause for news in state.news if news.cause.name != "refused"]
        return stops[-1].words if stops else "I have not stopped"

    def watch(self, watcher: Watcher) -> None:
        """Call back with each new state, until `unwatch` or the bus is closed."""
        self._watchers.append(watcher)

    def unwatch(self, watcher: Watcher) -> None:
        """Call back no more; one that does not watch does nothing."""
        if watcher in self._watchers:
            self._watchers.remove(watcher)

    @cached_property
    def limits(self) -> BaseLimits:
        """What the configuration allows this base."""
        return BaseLimits(**{n: _number(self.description, n, d) for n, d in _LIMITS.items()})

    @cached_property
    def fastest(self) -> Twist:
        """What the hardware can do."""
        return self._protocol().limits

    # --- for the devices ---

    def ask(
        self,
        source: Rank,
        twist: Twist | None,
        said: float = math.inf,
        manner: Manner = FREELY,
    ) -> None:
        """A velocity, as of the time when it was said at the latest; None takes back what this
        source asked for. Raises NotAvailable."""
        if self._stopping is not None:
            twist = None
        age = max(0.0, self.manager.clock.now() - said)
        self._order(Ask(source, twist, self.state.time - age, manner))

    @property
    def waiting(self) -> Sequence[Rank]:
        """The ranks that ask for something, the most important first."""
        return self.state.waiting

    def brake(self) -> None:
        """Stand still at once. Raises NotAvailable."""
        self._order(Brake(self.state.time))

    def look(self) -> None:
        """Fetch what the supervisor says now; without it, what it said in the last BEAT counts."""
        with self._lock:
            self._connection.look()

    def report(self) -> BaseReport:
        """The newest. Raises NotAvailable when there is none."""
        report = self.state.report
        if report is None or self._connection.is_mute:
            raise self.not_available("its supervisor says nothing", "see that the base is on")
        return report

    def age(self, now: float) -> float:
        """Seconds since the newest report; infinite without one."""
        state = self.state
        if state.report is None:
            return float("inf")
        return now - self._connection.heard_at + state.time - state.report.time

    def begin(self) -> None:
        """Someone is about to drive: let a base go that was switched on just now, and is well.

        Once for each opening, and never for one that anything else holds.
        """
        if not self._has_begun:
            self._has_begun = True
            self._release(POWER_UP)

    def set_power(self, percent: float, now: float) -> None:
        """Let the motors use a share of their force, 0 to 100."""

    # --- opening and closing ---

    def _open(self) -> None:
        self._watchers.clear()
        self._unlatching = self._stopping = None
        self._has_begun = False
        self._connection = self._connected(self.description.text("port"))
        self._poll()
        self._timer = self._next_beat()

    def _close(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        held = self.state.reason if self.state.is_latched else POWER_UP
        self._cause = self._stopping or held
        self._connection.close()

    def _connected(self, port: str) -> SupervisorConnection:
        clock = self.manager.clock
        limits, body = self.limits, self._body()
        if port == SIMULATED:
            line = self._line()
            known = rules(self._protocol(), limits, body, self._mounts())
            supervisor = Supervisor(known, self._cause)
            controller = Controller(self._protocol, line.connect(), supervisor)
            return Inline(clock, controller)
        if clock.is_fake:
            raise self.not_available("a serial port needs real time", "use its stand-in")
        # A simulated base needs no serial ports and no processes, which some systems do not have.
        from hri.drive.supervisor.process import Settings
        from hri.drive.supervisor.remote import Remote

        kind = f"{self.protocol.__module__}:{self.protocol.__qualname__}"
        settings = Settings(
            kind,
            port,
            -1,
            self.id,
            self.description.parameters,
            limits,
            body,
            self._mounts(),
            self._cause,
        )
        try:
            return Remote(clock, settings)
        except NotAvailable as error:
            raise NotAvailable(f"{self.id}: {error}") from error

    def _protocol(self) -> BaseProtocol:
        return self.protocol.described(self.description)

    def _line(self) -> BaseLine:
        """The line to an emulated base."""
        return self.use(self._declared_line(), BaseLine)

    def _declared_line(self) -> str:
        """Id of that line."""
        id, given = f"{self.id}_line", self.description
        parameters = {n: v for n, v in given.parameters.items() if n in self.protocol.parameters}
        self.manager.declare(
            Description(id, self.line, parameters, bus=given.bus, members=given.members)
        )
        return id

    def _body(self) -> Body:
        box = self.manager.dimensions
        sides = dict(_BODY)
        if box.lx > 0 and box.ly > 0:
            sides |= {
                "front": box.x + box.lx / 2,
                "back": box.lx / 2 - box.x,
                "half_width": box.ly / 2 + abs(box.y),
            }
        return Body(**{n: _number(self.description, n, d) for n, d in sides.items()})

    def _mounts(self) -> Mapping[str, Pose2D]:
        """Where the range sensors are that the configuration names, by their names in reports."""
        mounts = {}
        for id in self.manager.ids(RangeSensor):
            device = self.manager.descriptions[id]
            if device.bus == self.id:
                pose = self.manager.pose_of(id)
                mounts[device.text("sensor")] = Pose2D(pose.x, pose.y, pose.yaw)
        return mounts

    # --- the heartbeat ---

    def _say(self, order: Order) -> None:
        with self._lock:
            self._connection.say(order)

    def _order(self, order: Order) -> None:
        with self._lock:
            self._connection.say(order)
            if self._connection.is_mute:
                self._connection.look()  # perhaps it was us who stood still
        if self._connection.is_mute:
            raise self.not_available(
                "its supervisor does not answer", "wait until another has started"
            )

    def _beat(self) -> None:
        self._poll()
        with self._lock:
            if self._timer is not None:  # it was not closed meanwhile
                self._timer = self._next_beat()

    def _next_beat(self) -> Timer:
        return self.manager.clock.call_at(self.manager.clock.now() + BEAT, self._beat)

    def _poll(self) -> None:
        with self._lock:
            self._connection.look()
            if self._stopping is not None:
                self._go_on_stopping(self._stopping)
            if self._unlatching is not None:
                self._go_on_unlatching(*self._unlatching)
        # Without the lock: a listener may wait for a device that waits for us.
        for watcher in tuple(self._watchers):
            watcher(self._connection.state)

    def _go_on_stopping(self, cause: Cause) -> None:
        heard = (cause, replace(cause, said=None), NO_SUPERVISOR)
        if self.state.is_latched and self.state.reason in heard:
            self._stopping = None
        else:
            self._connection.say(Trip(cause))

    def _go_on_unlatching(self, cause: Cause, end: float) -> None:
        """Release what was latched when someone asked for it, and nothing that came later."""
        now, state = self.manager.clock.now(), self.state
        if state.reason != cause or not state.is_latched or now > end:
            self._unlatching = None
        elif self.age(now) <= STALE and not self._connection.is_mute:
            self._unlatching = None
            self._connection.say(Release(state.time, cause))


def refuse_wrong_limits(description: Description) -> None:
    """Raise AuthoringError for a limit that cannot be."""
    for name in LIMITS:
        _number(description, name, 1.0)


def _number(description: Description, name: str, default: float) -> float:
    least, most = _LEAST.get(name, 0.01), _MOST.get(name, 20.0)
    return description.number_within(name, default, least, most)
