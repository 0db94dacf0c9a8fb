"""Why a port has its value: the way back, and what each behavior says of its own output."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from hri.behavior.behavior import Behavior, Context
from hri.behavior.explanation import MOST_STEPS, Step, why
from hri.behavior.library.coordination import Inhibit
from hri.behavior.network import Network
from hri.behavior.network_file import read_network
from hri.behavior.ports import Input, Output
from hri.behavior.reason import Arrived, Reason
from hri.behavior.runner import Runner
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.hal.resource_manager import ResourceManager

BEHAVIORS = """
<Behavior id="zero" type="Hri.Constant"><Parameter name="parsed_value" value="0.0"/></Behavior>
<Behavior id="half" type="Hri.Constant"><Parameter name="parsed_value" value="0.5"/></Behavior>
<Behavior id="yes" type="Hri.Constant"><Parameter name="parsed_value" value="true"/></Behavior>
<Behavior id="no" type="Hri.Constant"><Parameter name="parsed_value" value="false"/></Behavior>
<Behavior id="lone" type="Hri.Absolute"/>
"""


def started(network: Network) -> Runner:
    clock = FakeClock()
    runner = Runner(network, Context(clock, EventBus(clock), ResourceManager((), clock)))
    runner.start()
    return runner


def explained(parts: str, port: str, ticks: int = 1) -> list[Step]:
    """The way back from a port after some ticks."""
    text = f"<BehaviorNetwork>{BEHAVIORS}{parts}</BehaviorNetwork>"
    network = read_network(text, Path("test.xml"))
    runner = started(network)
    for number in range(ticks):
        runner.tick(number * 0.1)
    steps = why(network, port, runner.resting)
    runner.stop()
    return steps


def link(*links: str) -> str:
    ways = [one.split(" -> ") for one in links]
    return "".join(f'<Link from="{source}" to="{target}"/>' for source, target in ways)


def behavior(id: str, type: str) -> str:
    return f'<Behavior id="{id}" type="{type}"/>'


def ports(steps: Sequence[Step]) -> list[str]:
    return [step.port for step in steps]


LEAST = behavior("least", "Evolution.Minimum") + behavior("size", "Hri.Absolute")
LEAST += link("half.value -> least.input", "zero.value -> least.input")
LEAST += link("least.minimum -> size.input", "size.magnitude -> board.speed")


def test_the_way_back_goes_through_what_decided() -> None:
    steps = explained(LEAST, "size.magnitude")
    assert steps == [
        Step("size.magnitude", 0.0, "Hri.Absolute makes it of its inputs"),
        Step("least.minimum", 0.0, "the least of its inputs"),
        Step("zero.value", 0.0, "Hri.Constant makes it: parsed_value = 0.0"),
    ]
    assert explained(LEAST, "size.input") == steps[1:]
    on_the_board = explained(LEAST, "board.speed")
    assert on_the_board == [Step("board.speed", 0.0, "written by size.magnitude"), *steps]


@pytest.mark.parametrize(
    ("type", "links", "port", "words", "decided"),
    [
        ("Maximum", "half.value input, zero.value input", "maximum",
         "the greatest of its inputs", ["half.value"]),
        ("And", "yes.value input, no.value input", "result",
         "one of its inputs is false", ["no.value"]),
        ("And", "yes.value input", "result", "Hri.And makes it", ["yes.value"]),
        ("Or", "no.value input, yes.value input", "result",
         "one of its inputs is true", ["yes.value"]),
        ("PriorityArbiter", "lone.magnitude input, half.value input, zero.value input", "winner",
         "the first of its inputs that sent something wins", ["half.value"]),
        ("Select", "no.value choice, half.value when_true, zero.value when_false", "selected",
         "the choice is false", ["no.value", "zero.value"]),
        ("Select", "board.ready choice, half.value when_true", "selected",
         "nothing is chosen without a choice", ["board.ready"]),
        ("Inhibit", "half.value input, no.value inhibitor", "output", "nothing holds it back",
         ["half.value"]),
        ("Inhibit", "half.value input, yes.value inhibitor, zero.value replacement", "output",
         "it is held back by its inhibitor", ["yes.value", "zero.value"]),
        ("Division", "half.value dividend, zero.value divisor", "quotient",
         "nothing can be divided by 0", ["zero.value"]),
    ],
)  # fmt: skip
def test_each_behavior_says_which_inputs_decided(
    type: str, links: str, port: str, words: str, decided: list[str]
) -> None:
    ways = [one.split() for one in links.split(", ")]
    parts = behavior("it", f"Hri.{type}")
    parts += link(*(f"{source} -> it.{target}" for source, target in ways))
    first, *others = explained(parts, f"it.{port}")
    assert first.words.startswith(words)
    assert ports(others)[: len(decided)] == decided


def test_what_is_held_back_after_its_inhibitor_has_ended_says_so() -> None:
    inhibit = Inhibit("it")
    network = Network("test")
    number, holds = Given("number", 1.0), Given("holds", 2.0)
    for one in (number, holds, inhibit):
        network.add(one)
    network.connect("number.output", "it.input")
    network.connect("holds.output", "it.inhibitor")
    runner = started(network)
    runner.tick(0.0)
    holds.value = None
    runner.tick(0.1)
    step = why(network, "it.output")[0]
    assert (step.value, step.words) == (
        None,
        "it is held back still, for hold_s after its inhibitor ended",
    )


def test_what_is_empty_is_explained() -> None:
    divided = behavior("it", "Hri.Division") + link("lone.magnitude -> it.dividend")
    both = divided + link("half.value -> it.divisor")
    assert explained("", "lone.input") == [
        Step("lone.input", None, "nothing was sent: nothing reaches lone.input")
    ]
    assert explained("", "lone.magnitude")[0].words == (
        "nothing was sent: nothing reaches lone.input"
    )
    first, *others = explained(both, "it.quotient")
    assert first.words == "nothing was sent: nothing came to it.dividend"
    assert ports(others) == ["lone.magnitude"]
    assert explained(divided, "it.quotient")[0].words == (
        "nothing was sent: nothing came to it in this tick"
    )
    reads = behavior("it", "Hri.Absolute") + link("board.wish -> it.input")
    assert explained(reads, "board.wish")[0].words == (
        "read from the board: another network or a task writes it"
    )


class Given(Behavior):
    """A number, or nothing."""

    output = Output[float]("double", "it")
    value: float | None

    def __init__(self, id: str, value: float | None = None) -> None:
        super().__init__(id)
        self.value = value

    def compute(self, now: float, dt: float) -> None:
        if self.value is not None:
            self.output.send(self.value)


class Explaining(Behavior):
    """One of an author, which explains its output."""

    input = Input[float]("double", "numbers")
    output = Output[float]("double", "the last of them")

    def compute(self, now: float, dt: float) -> None:
        self.output.send(self.input.values[-1])

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        return Reason("the last one counts", arrived[-1:])


class Confused(Explaining):
    """One whose explanation fails."""

    def explain_output(self, output: str, value: Any, arrived: Sequence[Arrived]) -> Reason | None:
        raise RuntimeError("?")


class Failing(Explaining):
    """One that fails."""

    def compute(self, now: float, dt: float) -> None:
        raise RuntimeError("no")


@pytest.mark.parametrize(
    ("kind", "words", "decided"),
    [
        (Explaining, "the last one counts", ["b.output"]),
        (Confused, "Confused makes it of its inputs", ["a.output", "b.output"]),
        (Failing, "it rests after an error - the log says which", []),
    ],
)
def test_an_author_explains_an_output_in_one_method(
    kind: type[Behavior], words: str, decided: list[str]
) -> None:
    network = Network("test")
    for one in (Given("a", 1.0), Given("b", 2.0), kind("it")):
        network.add(one)
    network.connect("a.output", "it.input")
    network.connect("b.output", "it.input")
    runner = started(network)
    runner.tick(0.0)
    first, *others = why(network, "it.output", runner.resting)
    assert first.words == words
    assert ports(others) == decided


def test_a_long_way_back_ends_and_a_wrong_port_is_refused() -> None:
    chain = "".join(behavior(f"n{number}", "Hri.Absolute") for number in range(60))
    chain += link(*(f"n{n}.magnitude -> n{n + 1}.input" for n in range(59)))
    steps = explained(chain + link("half.value -> n0.input"), "n59.magnitude")
    assert len(steps) == MOST_STEPS
    with pytest.raises(HriError, match="has no port"):
        explained("", "it.nothing")
