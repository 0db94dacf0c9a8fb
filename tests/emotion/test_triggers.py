from collections.abc import Mapping
from typing import Any

import pytest

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import Network
from hri.behavior.ports import Output
from hri.behavior.running import Networks
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event
from hri.emotion.formula import parse_formula
from hri.emotion.stimulus import StimulusSpec
from hri.emotion.triggers import Triggers
from hri.hal.resource_manager import ResourceManager


class Gauge(Behavior):
    """Sends a number that a test sets."""

    level = Output[float]("double", "the number")
    reads = 0.0

    def compute(self, now: float, dt: float) -> None:
        self.level.send(self.reads)


class Touched:
    """Stimuli with triggers on a robot with a gauge; what was felt is kept."""

    def __init__(self, *stimuli: StimulusSpec) -> None:
        self.clock = FakeClock()
        self.context = Context(self.clock, EventBus(self.clock), ResourceManager([], self.clock))
        self.networks = Networks(self.context)
        self.felt: list[tuple[str, float, str | None]] = []
        self.refused: list[Event] = []
        self.context.events.subscribe("stimulus.refused", self.refused.append)
        self.triggers = Triggers(stimuli, self.context, lambda *felt: self.felt.append(felt))
        self.gauge = Gauge("battery")

    def start_gauge(self) -> None:
        runner = self.networks.start(Network("moving", 0.1, [self.gauge]))
        self.triggers.connect()
        self.tick = runner.tick

    def read(self, *values: float) -> None:
        for value in values:
            self.gauge.reads = value
            self.tick(0.0)

    def happens(self, name: str, **properties: Any) -> None:
        self.context.events.raise_event(name, **properties)


def stimulus(
    name: str, trigger: str, intensity: str = "1", emotions: Mapping[str, float] | None = None,
    person: str = "",
) -> StimulusSpec:  # fmt: skip
    formula = parse_formula(intensity)
    return StimulusSpec(name, name, emotions or {}, trigger=trigger, formula=formula, person=person)


def test_an_event_is_felt_as_strongly_as_the_formula_says() -> None:
    robot = Touched(stimulus("bump", "drive.bumped", "clip(speed / 2, 0, 1)", person="Bob"))
    robot.happens("drive.bumped", speed=1.0)
    robot.happens("drive.bumped", speed=9.0, person="Ann")
    robot.happens("drive.bumped", speed=0.0)
    robot.happens("drive.moved", speed=1.0)
    assert robot.felt == [("bump", 0.5, "Bob"), ("bump", 1.0, "Ann")]


def test_one_event_may_bring_several_stimuli() -> None:
    robot = Touched(
        stimulus("praise", "speech.heard", 'rule == "praise"'),
        stimulus("scold", "speech.heard", 'rule == "scold"'),
    )
    robot.happens("speech.heard", rule="scold")
    robot.happens("speech.heard", rule="hello")
    assert robot.felt == [("scold", 1.0, None)]


def test_a_port_is_felt_each_time_it_rises_above_nothing() -> None:
    robot = Touched(stimulus("hungry", "battery.level", "(value < 0.2) * (1 - value)"))
    robot.start_gauge()
    robot.read(0.5, 0.1, 0.1, 0.05, 0.5, 0.0, 0.0)
    assert robot.felt == [("hungry", 0.9, None), ("hungry", 1.0, None)]


def test_a_port_of_a_network_that_comes_later_is_found_also_by_its_full_name() -> None:
    robot = Touched(stimulus("hungry", "moving.battery.level", "value < 0.2"))
    robot.triggers.connect()
    robot.start_gauge()
    robot.read(0.1)
    assert robot.felt == [("hungry", 1.0, None)]


def test_triggers_that_take_the_place_of_others_feel_nothing_twice() -> None:
    hungry = stimulus("hungry", "battery.level", "value < 0.2")
    robot = Touched(hungry)
    robot.start_gauge()
    robot.read(0.1)
    robot.triggers.close()
    feel, levels = robot.felt.append, robot.triggers.levels
    robot.triggers = Triggers([hungry], robot.context, lambda *felt: feel(felt), levels)
    robot.triggers.connect()
    robot.read(0.1, 0.5, 0.1)
    assert robot.felt == [("hungry", 1.0, None), ("hungry", 1.0, None)]


def test_a_port_is_felt_after_its_network_was_swapped_or_started_anew() -> None:
    robot = Touched(stimulus("hungry", "battery.level", "value < 0.2"))
    robot.start_gauge()
    robot.read(0.1, 0.5)
    robot.gauge = Gauge("battery")
    networks = robot.networks
    robot.tick = networks.swap("moving", Network("moving", 0.1, [robot.gauge])).tick
    robot.triggers.connect()
    robot.read(0.1, 0.5)
    assert len(robot.felt) == 2
    networks.stop("moving")
    robot.triggers.connect()
    robot.gauge = Gauge("battery")
    robot.start_gauge()
    robot.triggers.connect()
    robot.read(0.1, 0.1)
    assert len(robot.felt) == 3


def test_what_the_formula_cannot_tell_is_refused_once() -> None:
    robot = Touched(stimulus("bump", "drive.bumped", "speed"))
    for _ in range(3):
        robot.happens("drive.bumped", sped=1.0)
    assert robot.felt == []
    (event,) = robot.refused
    assert event.properties["reason"] == 'bump: no field "speed" - did you mean "sped"?'


@pytest.mark.parametrize("trigger", ["drive.bumped", "battery.level"])
def test_after_the_end_nothing_is_felt(trigger: str) -> None:
    robot = Touched(stimulus("bump", trigger))
    robot.start_gauge()
    robot.triggers.close()
    robot.triggers.close()
    robot.happens("drive.bumped")
    robot.read(1.0)
    assert robot.felt == []
