"""Connects a base to the robot: stop commands, and the exchange with its supervisor."""

from __future__ import annotations

import logging
import math

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import Effect
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import HriError, did_you_mean
from hri.core.event_bus import Subscription
from hri.core.signals import Event, People
from hri.drive.behaviors import COMMAND, LIFT, MOTION
from hri.drive.supervisor.announcement import announced
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.supervisor.base_drive import BaseDrive
from hri.hal.emergency_stop import EmergencyStop

TELL_EVERY = 0.5
"""Seconds between two words about the nearest person; the supervisor believes each for longer."""
SEEN = 1.0
"""Seconds for which what was seen says where people are."""

SAID = "someone said stop"
MET = {"bumper.pressed": "something touched me", "cliff.found": "I am at an edge"}
"""Why a base that stands for a spoken stop then stands for more than that, by event."""

log = logging.getLogger("hri.drive")


class SupervisorRelay(Behavior):
    """Latches the emergency stop of a base when someone says stop, and reports why it stopped.

    "Stop" is a rule of that name that was heard, the event `drive.halt` (its `because` says why),
    or a call of `halt`. Only `release` lets the base move again: it is for something that a person
    did, never for a program to go on by itself. A stop that was heard is lifted also by the next
    order to move that is heard, unless the base meets something meanwhile: see `lift`.

    It also says who is near, and what the supervisor reports becomes the events `drive.stopped`,
    `drive.refused`, and `drive.faulty`. Without any base the guard does nothing.
    """

    category = "drive"

    may_do = frozenset({Effect.MOVES})  # it drives slowly only near people
    base_id = Param(
        "", "id of the base: its bus, or its drive where it has none; the first one, without it"
    )

    people = Input[People]("people", "everyone who is seen: near them it drives slowly")
    is_latched = Output[bool]("boolean", "true while the base must not move until it is released")

    def start(self, context: Context) -> None:
        self._resources, self._board = context.resources, context.board
        self._base = self._found(context)
        self._bus = _bus_of(self._base)
        self._events = context.events
        self._board.slot(LIFT).set(self.lift, context.clock.now())
        self._told = self._seen = -math.inf
        self._nearest = math.nan
        self._subscriptions: list[Subscription] = []
        if self._bus is not None:
            self._announcer = announced(self._bus, context)
        if self._base is not None:
            subscribe = context.events.subscribe
            self._subscriptions = [
                subscribe("speech.heard", self._hear),
                subscribe("drive.halt", self._halt),
                *(subscribe(event, self._meet) for event in MET),
            ]

    def compute(self, now: float, dt: float) -> None:
        if (people := self.people.value) is not None:
            self._seen = people.time
            self._nearest = nearest(people)
        if self._base is not None:
            self.is_latched.send(self.must_wait)
        if self._bus is not None:
            self._tell_who_is_near(self._bus, now)

    def _tell_who_is_near(self, bus: BaseBus, now: float) -> None:
        # Who sees nobody because it sees nothing says nothing: someone may be near.
        if now - self._told >= TELL_EVERY and now - self._seen <= SEEN:
            self._told = now
            if not math.isnan(self._nearest):
                bus.hear_person(self._nearest)

    def stop(self) -> None:
        for subscription in self._subscriptions:
            subscription.cancel()
        self._subscriptions.clear()
        self._board.slot(LIFT).set(None, 0.0)
        if self._bus is not None:
            self._announcer.stop()
        if self._base is not None:
            self._resources.release(self._base)
        self._base = self._bus = None

    @property
    def must_wait(self) -> bool:
        """Whether the base does not move until it is released."""
        return self._base is not None and self._base.is_latched

    def halt(self, because: str = SAID) -> None:
        """The emergency stop; `because` ends the sentence "I stopped because".

        It ends the motion of any task: after a release nothing goes on by itself.
        """
        self._latch(because)

    def _latch(self, because: str, said: float | None = None) -> None:
        if self._base is None:
            return
        for slot in (COMMAND, MOTION):
            self._board.slot(slot).clear()
        if said is None:
            self._base.stop_latched(because)
        else:
            self._base.stop_spoken(because, said)

    def release(self) -> None:
        """Let the base move again, because a person wants it."""
        if self._base is not None:
            self._base.unlatch()

    def lift(self, said: float) -> bool:
        """Whether the base may move for an order that a person began to say then, in seconds.

        That lifts a stop that was said before it, where nothing else has stopped the base since
        it could move; all else needs `release`. This is the one place where that is decided.
        """
        return not self.must_wait or (self._base is not None and self._base.unlatch_spoken(said))

    def explain(self) -> str:
        """Why it stopped last, as a sentence; empty without a base."""
        return self._base.explain() if self._base is not None else ""

    def _found(self, context: Context) -> EmergencyStop | None:
        """The base with a supervisor, else the first drive that is there.

        Raises HriError for an id that is not a base, and where several have a supervisor.
        """
        buses = context.resources.ids(BaseBus)
        bases = [*buses, *(id for id in context.resources.ids(EmergencyStop) if id not in buses)]
        if self.base_id and self.base_id not in bases:
            raise HriError(f'"{self.base_id}" is not a base - {did_you_mean(self.base_id, bases)}')
        if not self.base_id and len(buses) > 1:
            raise HriError(f"several bases: {', '.join(buses)} - name one in base_id")
        for id in [self.base_id] if self.base_id else bases:
            try:
                return context.resources.obtain(id, EmergencyStop)
            except HriError as error:  # it is not there, whatever stands in for it
                log.info("%s - nothing to guard", error)
        return None

    def _hear(self, event: Event) -> None:
        if event.properties.get("rule") == "stop":
            self._latch(SAID, float(event.properties.get("end", event.time)))

    def _meet(self, event: Event) -> None:
        if self._base is not None and self._base.is_spoken:
            self.halt(MET[event.name])

    def _halt(self, event: Event) -> None:
        self.halt(str(event.properties.get("because", "I was told to")))


def _bus_of(base: EmergencyStop | None) -> BaseBus | None:
    """The base itself; a drive has its own."""
    if base is None or isinstance(base, BaseBus):
        return base
    return base.bus if isinstance(base, BaseDrive) else None


def nearest(people: People) -> float:
    """Meters to the nearest person who is there; infinite with nobody, NaN when it is unknown."""
    distances = [person.distance for person in people.persons]
    if any(map(math.isnan, distances)):
        return math.nan
    return min(distances, default=math.inf)
