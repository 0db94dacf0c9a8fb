"""Visits: what the simulated person does and when, read from a file.

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
seconds. `delay` seconds lie between the event, or the time, and what is done.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hri.core.clock import Clock, Timer
from hri.core.errors import did_you_mean
from hri.core.events import EventBus, Subscription, matches
from hri.core.signals import Event
from hri.core.toml import REQUIRED, Table, load_toml
from hri.simulation.world import SimulatedWorld

LONGEST = 24 * 3600.0
"""Seconds."""
MOST_STEPS = 2000
MOST_LETTERS = 300
_ENDING = 5.0
"""Seconds that a visit lasts after its last step when the file gives no duration."""

Value = str | float | bool
Deed = Callable[[SimulatedWorld, Value, float], object]

DEEDS: dict[str, Deed] = {
    "say": lambda world, text, now: world.say(str(text), now),
    "nod": lambda world, _, now: world.person.nod(now),
    "shake": lambda world, _, now: world.person.shake(now),
    "look_aside": lambda world, _, now: world.person.look_aside(now),
    "enter": lambda world, _, now: world.person.enter(now),
    "leave": lambda world, _, now: world.person.leave(now),
    "bump": lambda world, _, now: world.bump(now),
    "battery": lambda world, level, now: world.set_battery(float(level), now),
}
"""What a step can do, by its key in the file."""
TIMES = ("at", "after", "within", "delay")


@dataclass(frozen=True, slots=True)
class Step:
    """One thing that the person does."""

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


@dataclass(frozen=True)
class Visit:
    """All steps of a visit in the order of the file."""

    steps: tuple[Step, ...]
    duration: float
    """Seconds."""

    def start(self, world: SimulatedWorld, clock: Clock, events: EventBus) -> VisitRun:
        """Let the visit begin now."""
        return VisitRun(self, world, clock, events)


class VisitRun:
    """A visit that goes on; every step that is done is told as the event `visitor.acted`."""

    def __init__(self, visit: Visit, world: SimulatedWorld, clock: Clock, events: EventBus) -> None:
        self._world, self._clock, self._events = world, clock, events
        self._start = clock.now()
        self._waiting = [step for step in visit.steps if step.after]
        self._timers: list[Timer] = []
        self._subscription: Subscription = events.subscribe("*", self._hear)
        world.person.rehearse(str(step.value) for step in visit.steps if step.deed == "say")
        walks = [step.deed for step in visit.steps if step.deed in ("enter", "leave")]
        world.person.starts_present = walks[:1] != ["enter"]
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
        DEEDS[step.deed](self._world, step.value, self._clock.now())
        self._events.raise_event("visitor.acted", deed=step.deed, value=step.value)


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
    """The one key that says what is done."""
    for name in table.data:
        if name not in (*TIMES, *DEEDS, "wait"):
            raise table.error(name, f'unknown key "{name}"', did_you_mean(name, (*DEEDS, *TIMES)))
    found = [name for name in table.data if name not in TIMES]
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
    )


def _value(table: Table, deed: str) -> Value:
    if deed == "battery":
        return float(table.number(deed, minimum=0.0, maximum=1.0))
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
