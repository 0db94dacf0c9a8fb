"""What a port can reach, found over links, networks and the board."""

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.drive_command import DriveCommand
from hri.behavior.effects import ANYTHING, NOTHING, Effect
from hri.behavior.library.arithmetic import Addition
from hri.behavior.library.callback import CallbackBehavior
from hri.behavior.library.constant import Constant
from hri.behavior.library.printing import InputCollector
from hri.behavior.library.sharing import Share, Shared
from hri.behavior.library.timing import Delay
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.reach import Reach
from hri.behavior.runner import Runner
from hri.drive.behaviors import COMMAND, CommandGate
from hri.speech.behaviors import SpeakOn
from hri.testing import context

MOVES, SPEAKS = frozenset({Effect.MOVES}), frozenset({Effect.SPEAKS})


class Source(Behavior):
    """Sends a number, a truth and a twist."""

    number = Output[float]("double", "any")
    truth = Output[bool]("boolean", "any")
    twist = Output[object]("twist", "any")


class Custom(Behavior):
    """Takes something from the robot and says nothing of what it does with it."""

    number = Input[float]("double", "any")

    def start(self, context):
        """Who knows."""


class Harmless(Custom):
    """Says that it does nothing."""

    may_do = NOTHING


class Further(Harmless):
    """Has a start of its own again."""

    def start(self, context):
        """Who knows."""


def network(name, *behaviors, links=()):
    made = Network(name, 0.1)
    for behavior in behaviors:
        made.add(behavior)
    for source, target in links:
        made.connect(source, target)
    return made


def reach(*networks, port="number", has_tasks=False):
    lent = context()
    found = Reach([Runner(one, lent) for one in networks], has_tasks)
    return found.of(networks[0]["source"], port)


def pair(behavior, input, output="number"):
    behavior.id = "target"
    return network(
        "one", Source("source"), behavior, links=[(f"source.{output}", f"target.{input}")]
    )


@pytest.mark.parametrize(
    ("behavior", "input", "output", "effects"),
    [
        (InputCollector(), "input", "number", NOTHING),
        (Addition(), "input", "number", NOTHING),
        (Delay(), "input", "number", NOTHING),
        (DriveCommand(), "linear_velocity", "number", MOVES),
        (CommandGate(), "speed", "number", NOTHING),
        (SpeakOn(), "trigger", "truth", SPEAKS),
        (CallbackBehavior(), "input", "number", ANYTHING),
        (Custom(), "number", "number", ANYTHING),
        (Harmless(), "number", "number", NOTHING),
        (Further(), "number", "number", ANYTHING),
    ],
    ids=lambda value: type(value).__name__ if isinstance(value, Behavior) else "",
)
def test_a_link_reaches_what_its_target_does(behavior, input, output, effects):
    assert reach(pair(behavior, input, output), port=output) == effects


def test_a_port_without_a_link_reaches_nothing():
    assert reach(network("one", Source("source"), DriveCommand("drive"))) == NOTHING


@given(st.integers(0, 8))
def test_any_number_of_behaviors_in_between_changes_nothing(count):
    between = [Addition(f"sum{number}") for number in range(count)]
    chain = ["source.number"]
    for one in between:
        chain += [f"{one.id}.input", f"{one.id}.sum"]
    chain.append("drive.linear_velocity")
    links = list(zip(chain[::2], chain[1::2], strict=True))
    made = network("one", Source("source"), *between, DriveCommand("drive"), links=links)
    assert reach(made) == MOVES


def shares(slot):
    return network(
        "one",
        Source("source"),
        Share("share", slot=slot),
        links=[("source.number", "share.number")],
    )


def takes(slot, target, port):
    return network(
        "two", Shared("shared", slot=slot), target, links=[("shared.number", f"{target.id}.{port}")]
    )


def test_the_board_is_followed_from_network_to_network():
    drives = takes("speed", DriveCommand("drive"), "linear_velocity")
    assert reach(shares("speed"), drives) == MOVES
    assert reach(shares("other"), drives) == NOTHING
    assert reach(shares("speed"), takes("speed", InputCollector("show"), "input")) == NOTHING


def test_the_board_leads_to_the_gate_that_reads_the_commands_of_tasks():
    gated = network(
        "two",
        CommandGate("gate"),
        DriveCommand("drive"),
        links=[("gate.velocity", "drive.velocity")],
    )
    made = network(
        "one",
        Source("source"),
        Share("share", slot=COMMAND),
        links=[("source.twist", "share.twist")],
    )
    assert reach(made, gated, port="twist") == MOVES


def test_whoever_may_read_the_board_by_code_is_reached_over_it():
    assert reach(shares("speed"), has_tasks=True) == ANYTHING
    assert reach(shares("speed"), network("two", Custom("custom"))) == ANYTHING
    assert reach(shares("speed"), network("two", Constant("constant"))) == NOTHING


def test_a_circle_over_the_board_ends():
    made = network(
        "one",
        Source("source"),
        Shared("shared", slot="round"),
        Addition("sum"),
        Share("share", slot="round"),
        links=[
            ("source.number", "sum.input"),
            ("shared.number", "sum.input"),
            ("sum.sum", "share.number"),
        ],
    )
    assert reach(made) == NOTHING


def test_what_code_watches_may_do_anything():
    made, lent = pair(InputCollector(), "input"), context()
    runner = Runner(made, lent)
    watch = runner.watch("source", "number", print)
    assert Reach([runner], False).of(made["source"], "number") == ANYTHING
    watch.cancel()
    assert Reach([runner], False).of(made["source"], "number") == NOTHING
