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

The devices are the same for every base. A new base is a protocol, a bus of two lines like those at
the end of this file, and its entry point. With the port "simulated" the base is an emulated one in
the simulated world.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, ClassVar

from hri.core.clock import Timer
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.events import EventBus
from hri.core.geometry import along_arc
from hri.core.signals import Pose2D, RangeReading, Twist
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import Create2
from hri.drive.bases.protocol import BaseProtocol, BaseReport, Note
from hri.drive.supervisor.cause import NO_SUPERVISOR, Cause
from hri.drive.supervisor.connection import BEAT, Connection, Inline, Remote
from hri.drive.supervisor.controller import Controller
from hri.drive.supervisor.governor import Body
from hri.drive.supervisor.limiter import Cap, Limits, within_hardware
from hri.drive.supervisor.line import BaseLine
from hri.drive.supervisor.link import (
    LONGEST_WORDS,
    Ask,
    Brake,
    Dock,
    Lamps,
    Order,
    Person,
    Release,
    Song,
    State,
    Trip,
)
from hri.drive.supervisor.multiplexer import Level
from hri.drive.supervisor.process import Settings, rules
from hri.drive.supervisor.supervisor import Supervisor
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import Odometry
from hri.hal.motion import REST, SlowDown, Steering, Way
from hri.hal.moving_base import MovingBase
from hri.hal.pending import Pending
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description, Resource

if TYPE_CHECKING:
    from hri.hal.manager import ResourceManager

log = logging.getLogger("hri.drive")

SIMULATED = "simulated"
"""The port of a base that is emulated in the simulated world."""
STALE = 0.5
"""Seconds after which a report tells the program's sensors nothing."""
UNLATCHING = 5.0
"""Seconds that a release waits for a base that does not report yet."""
_LIMITS = {limit.name: float(getattr(Limits(), limit.name)) for limit in fields(Limits)}
_BODY = {side.name: float(getattr(Body(), side.name)) for side in fields(Body)}
_LEAST, _MOST = {"clearance": 0.0}, {"jerk": 100.0, "angular_jerk": 500.0}

Watcher = Callable[[State], object]


class BaseBus(Resource):
    """A base on a serial port, with its supervisor; the devices of the base sit on this bus.

    Parameters: `port`, those of the protocol, the fields of `Limits` and of `Body` (SI units and
    radians; without them the body is the box that the configuration gives as dimensions).

    After it was opened, and after a lost port, the base does not move until `unlatch`.
    """

    protocol: ClassVar[type[BaseProtocol]]
    """What the base speaks."""
    line: ClassVar[str]
    """Type of the resource that emulates this base."""
    parameters: ClassVar[tuple[str, ...]] = ("port", *_LIMITS, *_BODY)

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.parameters = (*BaseBus.parameters, *cls.protocol.parameters)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        cls.protocol.described(description)
        for name in (*_LIMITS, *_BODY):
            _number(description, name, 1.0)
        if not description.text("port"):
            raise description.error("port", "no port is given", "name one, such as /dev/ttyUSB0")

    def __init__(self, description: Description, manager: ResourceManager) -> None:
        super().__init__(description, manager)
        self._watchers: list[Watcher] = []
        self._unlatching: tuple[Cause, float] | None = None
        self._stopping: Cause | None = None
        """Why it must stop; said until the supervisor has heard it."""
        self._timer: Timer | None = None

    # --- for people and programs ---

    @property
    def state(self) -> State:
        """What the supervisor said last."""
        return self._connection.state

    def stop_latched(self, because: str) -> None:
        """The emergency stop, until `unlatch`; `because` ends the sentence "I stopped because"."""
        self._unlatching = None
        self._stopping = Cause("e-stop", because[:LONGEST_WORDS])
        self._poll()

    def unlatch(self) -> None:
        """Somebody says that the base may move: never call this by yourself.

        A base that does not report yet is released as soon as it does, within UNLATCHING seconds.
        """
        self._stopping = None
        self._unlatching = self.state.reason, self.manager.clock.now() + UNLATCHING
        self._poll()

    def teleop(self, twist: Twist) -> None:
        """Drive by hand: goes before networks and tasks; to be repeated within 0.3 s."""
        self.ask(Level.TELEOP, twist)

    def hear_person(self, distance: float) -> None:
        """How far the nearest person is, meters; infinity when surely nobody is about.

        To be repeated every second, otherwise somebody may be near.
        """
        self._say(Person(distance, self.state.time))

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
        """What to answer to "why did you stop?"."""
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

    @property
    def limits(self) -> Limits:
        """What the configuration allows this base."""
        return Limits(**{n: _number(self.description, n, d) for n, d in _LIMITS.items()})

    @property
    def fastest(self) -> Twist:
        """What the hardware can do."""
        return self._protocol().limits

    # --- for the devices ---

    def ask(self, source: Level, twist: Twist | None) -> None:
        """A velocity; None takes back what this source asked for. Raises NotAvailable."""
        if self._stopping is not None:
            twist = None
        self._order(Ask(source, twist, self.state.time))

    def brake(self) -> None:
        """Stand still at once. Raises NotAvailable."""
        self._order(Brake(self.state.time))

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

    # --- opening and closing ---

    def _open(self) -> None:
        self._watchers.clear()
        self._unlatching = self._stopping = None
        self._connection = self._connected(self.description.text("port"))
        self._beat()

    def _close(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._connection.close()

    def _connected(self, port: str) -> Connection:
        clock = self.manager.clock
        limits, body, mounts = self.limits, self._body(), self._mounts()
        if port == SIMULATED:
            supervisor = Supervisor(rules(self._protocol(), limits, body, mounts))
            return Inline(clock, Controller(self._protocol, self._line().connect(), supervisor))
        if clock.is_fake:
            raise self.not_available("a serial port needs real time", "use its stand-in")
        kind = f"{self.protocol.__module__}:{self.protocol.__qualname__}"
        settings = Settings(
            kind, port, -1, self.id, self.description.parameters, limits, body, mounts
        )
        try:
            return Remote(clock, settings)
        except NotAvailable as error:
            raise NotAvailable(f"{self.id}: {error}") from error

    def _protocol(self) -> BaseProtocol:
        return self.protocol.described(self.description)

    def _line(self) -> BaseLine:
        id = f"{self.id}_line"
        given = self.description.parameters
        parameters = {n: given[n] for n in self.protocol.parameters if n in given}
        self.manager.declare(Description(id, self.line, parameters, bus=self.description.bus))
        return self.use(id, BaseLine)

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
        for id in self.manager.ids(BaseRangeSensor):
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
            raise self.not_available("its supervisor does not answer", "open the base again")

    def _beat(self) -> None:
        self._poll()
        self._timer = self.manager.clock.call_at(self.manager.clock.now() + BEAT, self._beat)

    def _poll(self) -> None:
        with self._lock:
            self._connection.look()
            if self._stopping is not None:
                self._go_on_stopping(self._stopping)
            if self._unlatching is not None:
                self._go_on_unlatching(*self._unlatching)
        # Without the lock: who is told may wait for a device that waits for us.
        for watcher in tuple(self._watchers):
            watcher(self._connection.state)

    def _go_on_stopping(self, cause: Cause) -> None:
        if self.state.is_latched and self.state.reason in (cause, NO_SUPERVISOR):
            self._stopping = None
        else:
            self._connection.say(Trip(cause))

    def _go_on_unlatching(self, cause: Cause, end: float) -> None:
        """Release what was latched when somebody asked for it, and nothing that came later."""
        now, state = self.manager.clock.now(), self.state
        if state.reason != cause or not state.is_latched or now > end:
            self._unlatching = None
        elif self.age(now) <= STALE:
            self._unlatching = None
            self._connection.say(Release(state.time, cause))


def _number(description: Description, name: str, default: float) -> float:
    least, most = _LEAST.get(name, 0.01), _MOST.get(name, 20.0)
    return description.number_within(name, default, least, most)


def announce(bus: BaseBus, events: EventBus) -> Watcher:
    """Raise an event, and write a line to the log, for each thing that people should know.

    It goes on until the watcher that it returns is given to `unwatch`, or the bus is closed.

    `drive.stopped` (reason, words) unless somebody asked it to stop, `drive.refused` (words) for a
    command that made no sense, `drive.faulty` (words) for a sensor that cannot be believed.
    """
    told, faulty = 0, frozenset[str]()

    def tell(state: State) -> None:
        nonlocal told, faulty
        for news in state.news:
            if news.number > told:
                told = news.number
                _tell(news.cause)
        for words in sorted(frozenset(state.faults) - faulty):
            log.warning("%s: %s", bus.id, words)
            events.raise_event("drive.faulty", words=words)
        faulty = frozenset(state.faults)

    def _tell(cause: Cause) -> None:
        if cause.name == "refused":
            log.warning("%s: refused: %s", bus.id, cause.because)
            events.raise_event("drive.refused", words=cause.because)
        elif cause.name != "done":
            log.info("%s: %s", bus.id, cause.words)
            events.raise_event("drive.stopped", reason=cause.name, words=cause.words)

    bus.watch(tell)
    return tell


class OnBase(Resource):
    """A device of a base."""

    bus: BaseBus

    def _open(self) -> None:
        super()._open()
        self.bus = self.use(self.description.bus, BaseBus)


class OfSensor(OnBase):
    """One of several sensors of a kind, chosen by the parameter `sensor`."""

    parameters: ClassVar[tuple[str, ...]] = ("sensor",)
    kind: ClassVar[str]
    """The field of `Sensors` that names them."""

    def _open(self) -> None:
        super()._open()
        self.sensor = self.description.text("sensor")
        known = getattr(self.bus.protocol.described(self.bus.description).sensors, self.kind)
        if self.sensor not in known and not self._is_any():
            what = f'the base has no sensor "{self.sensor}" of that kind'
            raise self.description.error("sensor", what, did_you_mean(self.sensor, known))

    def _is_any(self) -> bool:
        """Whether it may stand for all of them."""
        return False


class BaseDrive(OnBase, MovingBase):
    """Asks the supervisor, which has the last word.

    Velocities of networks go before those of motions; when one takes the other's place, the other's
    last word is taken back.
    """

    # The supervisor limits the jerk, and the line takes its time: what is told shows 75 ms later.
    # The wheels of a Create 2 count 0.44 mm, and turn at whole mm/s.
    steering = Steering(gain=3.0, lead=0.075, near=Way(0.002, math.radians(0.4)))

    def _open(self) -> None:
        super()._open()
        self._source = Level.BEHAVIORS
        limits = self.bus.limits
        self.max_acceleration = min(limits.acceleration, limits.deceleration)
        self.max_angular_acceleration = min(
            limits.angular_acceleration, limits.angular_deceleration
        )
        self.max_linear, self.max_angular = self._slowest.forward, self._slowest.angular

    @property
    def _slowest(self) -> Cap:
        """What is allowed whoever comes near; a motion planned faster might lag behind and fail."""
        return within_hardware(self.bus.limits.cap(is_near=True), self.bus.fastest)

    def move_delta(self, distance: float, velocity: float, acceleration: float) -> Pending[None]:
        if distance < 0:
            velocity = min(velocity, self._slowest.backward)
        return super().move_delta(distance, velocity, acceleration)

    def _send(self, twist: Twist, now: float) -> None:
        run = self._run
        if run and self.bus.state.is_latched and not isinstance(run.motion, SlowDown):
            raise HriError(f"{self.bus.explain()} - unlatch the base first")
        source = Level.TASKS if run else Level.BEHAVIORS
        if source is not self._source:
            self.bus.ask(self._source, None)
            self._source = source
        self.bus.ask(source, twist)

    def _brake(self, now: float) -> None:
        self.bus.brake()

    def _set_power(self, percent: float, now: float) -> None:
        """Nothing: these bases hold their place as their firmware likes."""

    def _rolled(self, now: float) -> Way:
        return self.bus.report().rolled

    def _velocity(self, now: float) -> Twist:
        return self.bus.report().velocity or REST


class BaseOdometry(OnBase, Odometry):
    """Adds up what the wheels say they rolled; between two states the way counts as one arc."""

    parameters: ClassVar[tuple[str, ...]] = ("polling_interval",)

    def _open(self) -> None:
        super()._open()
        self._pose = Pose2D()
        self._rolled: Way | None = None
        self.bus.watch(self._follow)

    def _close(self) -> None:
        self.bus.unwatch(self._follow)
        super()._close()

    def pose(self, now: float) -> Pose2D:
        return self._pose

    def velocity(self, now: float) -> Twist:
        return self.bus.report().velocity or REST

    def _follow(self, state: State) -> None:
        if state.report is None:
            return
        rolled = state.report.rolled
        before, self._rolled = self._rolled or rolled, rolled
        linear, angular = rolled.linear - before.linear, rolled.angular - before.angular
        self._pose = along_arc(self._pose, linear, angular)


class BaseBumper(OfSensor, Bumper):
    """A switch of the base, or all of them without the parameter `sensor`."""

    kind = "bumps"

    def _is_any(self) -> bool:
        return not self.sensor

    def is_pressed(self, now: float) -> bool:
        report = self.bus.state.report
        if report is None or self.bus.age(now) > STALE:
            return True
        return report.bumps.get(self.sensor, True) if self.sensor else any(report.bumps.values())


class BaseCliffSensor(OfSensor, CliffSensor):
    """A cliff sensor of the base."""

    kind = "cliffs"

    def is_cliff(self, now: float) -> bool:
        report = self.bus.state.report
        return report is None or self.bus.age(now) > STALE or report.cliffs.get(self.sensor, True)


class BaseRangeSensor(OfSensor, RangeSensor):
    """A range sensor of the base; x, y (cm) and yaw say where it is, which governs the speed."""

    kind = "ranges"

    def read(self, now: float) -> RangeReading:
        report = self.bus.report()
        distance = report.ranges.get(self.sensor, 0.0)
        return RangeReading(self.id, distance, now - self.bus.age(now), 0)


class BaseBattery(OnBase, Battery):
    """The battery, as the base measures it."""

    def level(self, now: float) -> float:
        level = self.bus.report().battery
        if level is None:
            raise self.not_available("the base does not say how full it is", "measure the voltage")
        return level

    def voltage(self, now: float) -> float:
        voltage = self.bus.report().voltage
        if voltage is None:
            raise self.not_available("the base does not say its voltage", "ask for the level")
        return voltage


class Create2Bus(BaseBus):
    """An iRobot Create 2, or a Roomba of the 500 and 600 series."""

    protocol = Create2
    line = "Hri.EmulatedCreate2"


class ArduinoBus(BaseBus):
    """An Arduino or its like with the ROSArduinoBridge protocol."""

    protocol = ArduinoBridge
    line = "Hri.EmulatedArduino"
