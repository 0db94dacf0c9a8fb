"""Visits: what the simulated people do and when, read from a file.

    [[step]]
    at = 3
    say = "hello robot"

    [[step]]
    after = "question.asked"
    delay = 1.2
    nod = true

Each step does one thing. `at` is in seconds from the start of the visit; a step without it comes
with the step above, and `wait = 2` lets two seconds pass before the steps below. A step with
`after` waits, from its time on, for an event of that name; each event sets off one step, the first
in the file that waits for it. It is left out when the event does not come `within` that many
seconds. `delay` seconds lie between the event, or the time, and the action. Where the world
has several people, `who = "anna"` names the one; else it is the first.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hri.core.clock import Clock, Timer
from hri.core.errors import did_you_mean
from hri.core.event_bus import EventBus, Subscription, matches
from hri.core.signals import Event
from hri.core.toml import REQUIRED, Table, load_toml
from hri.simulation.people.body_motion import MOTIONS
from hri.simulation.people.person import SimulatedPerson
from hri.simulation.world import SimulatedWorld

LONGEST = 24 * 3600.0
"""Seconds."""
MOST_STEPS = 2000
MOST_LETTERS = 300
_ENDING = 5.0
"""Seconds that a visit lasts after its last step when the file gives no duration."""

Value = str | float | bool
Deed = Callable[[SimulatedWorld, SimulatedPerson, Value, float], object]


def _moves(name: str) -> Deed:
    return lambda world, person, _, now: person.move(name, now)


DEEDS: dict[str, Deed] = {
    "say": lambda world, person, text, now: world.say(str(text), now, person),
    **{name: _moves(name) for name in MOTIONS if name != "still"},
    "enter": lambda world, person, _, now: person.enter(now),
    "leave": lambda world, person, _, now: person.leave(now),
    "approach": lambda world, person, meters, now: world.stand_at(person, float(meters), now),
    "move_away": lambda world, person, meters, now: world.stand_at(person, float(meters), now),
    "bump": lambda world, person, _, now: world.bump(now),
    "press": lambda world, person, button, now: world.press(str(button), now),
    "battery": lambda world, person, level, now: world.set_battery(float(level), now),
}
"""What a step can do, by its key in the file."""
NUMBERS = {"battery": (0.0, 1.0), "approach": (0.5, 20.0), "move_away": (0.5, 20.0)}
"""Least and most of those that take a number: a level; meters from the robot to stand at then."""
MODIFIERS = ("at", "after", "within", "delay", "who")
"""What a step can say besides."""


@dataclass(frozen=True, slots=True)
class Step:
    """One thing that someone does."""

    at: float
    """Seconds from the start: when it is done, or from when on its event counts."""
    deed: str
    """A key of `DEEDS`."""
    value: Value
    after: str = ""
    """Name of the event it waits for; may hold `*`."""
    within: float = math.inf
    """Seconds from `at` in which the event must come."""
    delay: float = 0.0
    """Seconds."""
    who: str = ""
    """Name of who does it; empty for the first."""


@dataclass(frozen=True)
class Visit:
    """All steps of a visit in the order of the file."""

    steps: tuple[Step, ...]
    duration: float
    """Seconds."""

    def start(self, world: SimulatedWorld, clock: Clock, events: EventBus) -> VisitRun:
        """Let the visit begin now. Raises HriError when it names someone the world has not."""
        return VisitRun(self, world, clock, events)


class VisitRun:
    """A running visit; every step raises the event `visitor.acted`."""

    def __init__(self, visit: Visit, world: SimulatedWorld, clock: Clock, events: EventBus) -> None:
        self._world, self._clock, self._events = world, clock, events
        self._start = clock.now()
        self._waiting = [step for step in visit.steps if step.after]
        self._timers: list[Timer] = []
        doers = {step.who: world.find_person(step.who) for step in visit.steps}
        for person in world.people:
            own = [step for step in visit.steps if doers[step.who] is person]
            person.rehearse(str(step.value) for step in own if step.deed == "say")
            walks = [step.deed for step in own if step.deed in ("enter", "leave")]
            person.starts_present = walks[:1] != ["enter"]
        self._subscription: Subscription = events.subscribe("*", self._hear)
        for step in visit.steps:
            if not step.after:
                self._schedule(step, self._start + step.at)

    def cancel(self) -> None:
        """Let nothing more happen; a second call does nothing."""
        self._subscription.cancel()
        for timer in self._timers:
            timer.cancel()

    def _hear(self, event: Event) -> None:
        """Set off the first step that waits for this event."""
        elapsed = event.time - self._start
        self._waiting = [step for step in self._waiting if elapsed <= step.at + step.within]
        for step in self._waiting:
            if step.at <= elapsed and matches(step.after, event.name):
                self._waiting.remove(step)
                self._schedule(step, event.time)
                return

    def _schedule(self, step: Step, trigger: float) -> None:
        timer = self._clock.call_at(trigger + step.delay, lambda: self._do(step))
        self._timers.append(timer)

    def _do(self, step: Step) -> None:
        person = self._world.find_person(step.who)
        DEEDS[step.deed](self._world, person, step.value, self._clock.now())
        told = {"who": step.who} if step.who else {}
        self._events.raise_event("visitor.acted", deed=step.deed, value=step.value, **told)


def load_visit(path: Path) -> Visit:
    """Read a visit. Raises AuthoringError with the place of what is wrong."""
    root = load_toml(path, "visit")
    root.string("about", "")
    tables = root.array("step")
    if len(tables) > MOST_STEPS:
        raise root.error("step", f"{len(tables)} steps", f"write at most {MOST_STEPS}")
    steps = _steps(tables)
    end = max((step.at + step.delay for step in steps), default=0.0) + _ENDING
    duration = float(root.number("duration", end, minimum=1.0, maximum=LONGEST))
    root.finish()
    return Visit(tuple(steps), duration)


def _steps(tables: list[Table]) -> list[Step]:
    now = 0.0
    steps = []
    for table in tables:
        deed = _deed(table)
        now = _time(table, now)
        if deed == "wait":
            now += _seconds(table, "wait")
        else:
            steps.append(_step(table, deed, now))
        table.finish()
    return steps


def _deed(table: Table) -> str:
    """The one key that names the action."""
    for name in table.data:
        if name not in (*MODIFIERS, *DEEDS, "wait"):
            raise table.error(
                name, f'unknown key "{name}"', did_you_mean(name, (*DEEDS, *MODIFIERS))
            )
    found = [name for name in table.data if name not in MODIFIERS]
    if not found:
        raise table.error(None, "this step does nothing", f"add one of {', '.join(DEEDS)}, wait")
    if len(found) > 1:
        what = f"{found[0]} and {found[1]} in one step"
        raise table.error(found[1], what, "write a [[step]] for each")
    return found[0]


def _time(table: Table, previous: float) -> float:
    at = _seconds(table, "at", previous)
    if at < previous:
        what = f"at is {at:g}, before the {previous:g} s of the steps above"
        raise table.error("at", what, "put the steps in the order of time")
    return at


def _step(table: Table, deed: str, at: float) -> Step:
    after = str(table.string("after", ""))
    if "within" in table and not after:
        raise table.error("within", "within has no event to wait for", "add after, or drop it")
    return Step(
        at=at,
        deed=deed,
        value=_value(table, deed),
        after=after,
        within=_seconds(table, "within", math.inf),
        delay=_seconds(table, "delay", 0.0),
        who=str(table.string("who", "")),
    )


def _value(table: Table, deed: str) -> Value:
    if deed in NUMBERS:
        least, most = NUMBERS[deed]
        return float(table.number(deed, minimum=least, maximum=most))
    if deed == "say":
        return _sentence(table)
    if not table.flag(deed):
        raise table.error(deed, f"{deed} = false does nothing", f"write {deed} = true")
    return True


def _sentence(table: Table) -> str:
    text = str(table.string("say"))
    if not text.strip() or len(text) > MOST_LETTERS:
        what = f"a sentence of {len(text.strip())} letters"
        raise table.error("say", what, f"write 1 to {MOST_LETTERS} letters")
    return text


def _seconds(table: Table, name: str, default: float = REQUIRED) -> float:
    return float(table.number(name, default, minimum=0.0, maximum=LONGEST))
