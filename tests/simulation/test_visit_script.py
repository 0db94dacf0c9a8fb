from collections.abc import Callable
from pathlib import Path

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.core.event_bus import EventBus
from hri.core.paths import house
from hri.simulation.visit_script import Visit, VisitRun, load_visit
from hri.simulation.world import SimulatedWorld

Write = Callable[[str], Path]
Done = list[tuple[float, str, object]]


class Stage:
    """A visit that runs, and what was done when."""

    def __init__(self, visit: Visit, world: SimulatedWorld, clock: FakeClock) -> None:
        self.clock, self.events = clock, EventBus(clock)
        self.done: Done = []
        self.events.subscribe("visitor.acted", self._note)
        self.run: VisitRun = visit.start(world, clock, self.events)

    def _note(self, event: object) -> None:
        time, properties = event.time, event.properties  # type: ignore[attr-defined]
        self.done.append((round(time, 6), properties["deed"], properties["value"]))

    def raise_at(self, time: float, name: str) -> None:
        self.clock.call_at(time, lambda: self.events.raise_event(name))


@pytest.fixture
def stage(write: Write, world: SimulatedWorld, clock: FakeClock) -> Callable[[str], Stage]:
    return lambda text: Stage(load_visit(write(text)), world, clock)


def test_steps_happen_at_their_times(stage: Callable[[str], Stage]) -> None:
    play = stage(
        """
        [[step]]
        at = 1
        say = "hello"
        [[step]]
        nod = true
        delay = 0.5
        [[step]]
        wait = 2
        [[step]]
        bump = true
        [[step]]
        at = 7
        battery = 0.15
        """
    )
    play.clock.advance(10.0)
    assert play.done == [
        (1.0, "say", "hello"),
        (1.5, "nod", True),
        (3.0, "bump", True),
        (7.0, "battery", 0.15),
    ]


ANSWERS = """
[[step]]
after = "question.asked"
delay = 1.2
nod = true
[[step]]
after = "question.asked"
delay = 1.2
shake = true
"""


def test_each_event_sets_off_the_next_step_that_waits_for_it(
    stage: Callable[[str], Stage],
) -> None:
    play = stage(ANSWERS)
    for time in (2.0, 5.0, 8.0):
        play.raise_at(time, "question.asked")
    play.clock.advance(10.0)
    assert play.done == [(3.2, "nod", True), (6.2, "shake", True)]


def test_an_event_counts_only_in_its_time(stage: Callable[[str], Stage]) -> None:
    play = stage(
        """
        [[step]]
        at = 3
        after = "drive.*"
        within = 2
        say = "stop"
        [[step]]
        at = 6
        after = "drive.*"
        say = "now"
        """
    )
    for time in (1.0, 5.5, 7.0):
        play.raise_at(time, "drive.commanded")
    play.clock.advance(10.0)
    assert play.done == [(7.0, "say", "now")]


def test_a_cancelled_visit_does_nothing_more(stage: Callable[[str], Stage]) -> None:
    play = stage(ANSWERS + '[[step]]\nat = 1\nsay = "a"\n[[step]]\nat = 4\nsay = "b"\n')
    play.clock.advance(2.0)
    play.run.cancel()
    play.run.cancel()
    play.raise_at(3.0, "question.asked")
    play.clock.advance(5.0)
    assert play.done == [(1.0, "say", "a")]


def test_who_enters_was_not_there_before(
    stage: Callable[[str], Stage], world: SimulatedWorld
) -> None:
    stage("[[step]]\nat = 2\nenter = true\n[[step]]\nat = 9\nleave = true\n").clock.advance(20.0)
    assert [world.person.is_present(time) for time in (1.0, 5.0, 15.0)] == [False, True, False]


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("[[step]]\nat = 1\nsya = 'a'\n", 3, 'did you mean "say"'),
        ("[[step]]\nat = 1\n", 1, "does nothing - add one of say"),
        ("[[step]]\nsay = 'a'\nnod = true\n", 3, "say and nod in one step"),
        ("[[step]]\nat = 5\nnod = true\n[[step]]\nat = 3\nnod = true\n", 5, "order of time"),
        ("[[step]]\nat = -1\nnod = true\n", 2, "write a number from 0"),
        ("[[step]]\nwithin = 3\nnod = true\n", 2, "no event to wait for"),
        ("[[step]]\nnod = false\n", 2, "nod = true"),
        ("[[step]]\nnod = 1\n", 2, "write true or false"),
        ("[[step]]\nsay = ' '\n", 2, "write 1 to"),
        (f"[[step]]\nsay = '{'a' * 999}'\n", 2, "999 letters"),
        ("[[step]]\nbattery = 15\n", 2, "from 0 to 1"),
        ("duration = 0\n", 1, "from 1 to"),
        ("[[step]]\nat = = 1\n", 2, 'text goes in "quotes"'),
        ("[[step]]\nat = 1\nnod = true\n" * 2001, 1, "at most 2000"),
    ],
)
def test_a_wrong_file_is_refused_at_its_line(write: Write, text: str, line: int, said: str) -> None:
    with pytest.raises(AuthoringError) as caught:
        load_visit(write(text))
    assert said in str(caught.value)
    assert caught.value.place.line == line


def test_the_companions_demo_is_a_two_minute_visit() -> None:
    visit = load_visit(house() / "apps" / "companion" / "demo.toml")
    deeds = [step.deed for step in visit.steps]
    assert visit.duration == 120.0
    assert {"say", "nod", "shake", "enter", "leave", "bump", "battery"} <= set(deeds)
    assert max(step.at for step in visit.steps) < visit.duration
