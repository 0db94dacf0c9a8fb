"""A peer that steers a base over the bridge: the base stops when the peer falls silent."""

import pytest
from hypothesis import given, settings, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.device_behaviors import JoystickSticks
from hri.behavior.doors import Doors
from hri.behavior.drive_command import DriveCommand
from hri.behavior.library.arithmetic import Addition, Multiplication
from hri.behavior.library.constant import Constant
from hri.behavior.library.sharing import Share, Shared
from hri.behavior.network import Network
from hri.behavior.ports import LINEAR_VELOCITY, Input, Output
from hri.behavior.runner import Runner
from hri.core.signals import Twist
from hri.drive.behaviors import CommandGate
from hri.drive.goal_behaviors import Beeline
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import PATIENCE, DriveSystem
from hri.hal.joystick import Joystick
from hri.hal.resource import Description
from hri.net.malleable import MalleableBehavior
from hri.net.malleable_protocol import Item, Message, Sender, encode
from hri.simulation.world import SimulatedWorld
from hri.testing import context
from hri.vision.point_and_go import PointAndGo
from tests.net.conftest import WITHIN, Taken

TICK = 0.05


class Steering(MalleableBehavior):
    """Takes a velocity and a text from a peer."""

    velocity = Output[float]("double", "cm/s", LINEAR_VELOCITY)
    speed = Output[float]("double", "a factor")
    text = Output[str]("string", "a text")


class Kept(Behavior):
    """Keeps the texts it is sent."""

    text = Input[str]("string", "a text")

    def start(self, context):
        self.seen = []

    def compute(self, now, dt):
        self.seen += self.text.values


class Commander(Behavior):
    """Sends the velocity that a number asks for."""

    number = Input[float]("double", "m/s")
    twist = Output[Twist]("twist", "the velocity")

    def compute(self, now, dt):
        if (number := self.number.value) is not None:
            self.twist.send(Twist(number))


class Stage:
    """A simulated base, and networks that are ticked on the fake clock."""

    def __init__(self, *networks, lent=()):
        self.lent = context(
            *lent,
            Description("world", "Hri.SimulatedWorld"),
            Description("drive", "Hri.SimulatedDrive", bus="world"),
            Description("joystick", "Hri.MemoryJoystick"),
        )
        self.lent.doors = Doors(trusted=("malleable",))
        self.clock = self.lent.clock
        self.world = self.lent.resources.obtain("world", SimulatedWorld)
        self.lent.resources.obtain("drive", DriveSystem)
        self.runners = [Runner(network, self.lent) for network in networks]
        for runner in self.runners:
            runner.network.sort()
            runner.start()

    def tick(self, times=1, interval=TICK):
        for _ in range(times):
            self.clock.advance(interval)
            for runner in self.runners:
                runner.tick(self.clock.now())

    @property
    def speed(self):
        self.world.base.advance(self.clock.now())
        return self.world.base.velocity.linear

    @property
    def goal(self):
        """The velocity that the wheels are led to, m/s."""
        (base,) = self.lent.resources.opened(BaseBus)
        return base.state.target.linear

    def close(self):
        for runner in self.runners:
            runner.stop()
        self.lent.resources.close()


@pytest.fixture
def stage():
    stages = []

    def made(*networks, lent=()):
        stages.append(Stage(*networks, lent=lent))
        return stages[-1]

    yield made
    for one in stages:
        one.close()


def network(behaviors, *links, name="test"):
    made = Network(name)
    for id, behavior in behaviors.items():
        behavior.id = id
        made.add(behavior)
    for source, target in links:
        made.connect(source, target)
    return made


def steered():
    """A peer steers the drive directly; a text beside it goes elsewhere."""
    return network(
        {"peer": Steering(tcp_port=0), "drive": DriveCommand(), "kept": Kept()},
        ("peer.velocity", "drive.linear_velocity"),
        ("peer.text", "kept.text"),
    )


def say(stage, sender, **values):
    """What a peer sends, without a count: at every tick until another value comes."""
    items = tuple(Item(port, str(value), None) for port, value in values.items())
    stage.runners[0].network["peer"]._receive(Message("malleable", items, sender))


def test_a_base_follows_a_peer_and_stops_when_the_peer_falls_silent(stage):
    here, peer = stage(steered()), Sender()
    for _ in range(40):
        say(here, peer, velocity=20, text="hello")
        here.tick()
    assert here.speed == pytest.approx(0.2)
    here.tick(2)
    assert here.goal == pytest.approx(0.2), "0.2 s are not over yet"
    here.tick(3)
    assert here.goal == 0
    here.tick(40)
    assert here.speed == 0
    assert here.runners[0].network["kept"].seen[-1] == "hello", "what moves nothing stays"


def test_it_stops_between_the_ticks_of_a_slow_network(stage):
    here, peer = stage(steered()), Sender()
    here.tick(interval=1.0)
    say(here, peer, velocity=20)
    here.tick(interval=0.1)
    assert here.goal == pytest.approx(0.2)
    here.clock.advance(PATIENCE - 0.13)
    assert here.goal == pytest.approx(0.2)
    here.clock.advance(0.04)
    assert here.goal == 0


def test_a_message_of_any_kind_shows_that_the_peer_lives(stage):
    here, peer = stage(steered()), Sender()
    say(here, peer, velocity=20)
    for _ in range(60):
        say(here, peer, text="still here")
        here.tick()
    assert here.speed == pytest.approx(0.2)


def test_a_peer_that_has_hung_up_moves_nothing(stage):
    here, peer = stage(steered()), Sender()
    say(here, peer, velocity=20)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    peer.is_gone = True
    here.tick(interval=0.001)
    assert here.goal == 0


def test_one_peer_does_not_speak_for_another(stage):
    here, gone, other = stage(steered()), Sender(), Sender()
    say(here, gone, velocity=20)
    for _ in range(10):
        say(here, other, text="I am here")
        here.tick()
    assert here.goal == 0


def test_what_is_computed_from_the_word_of_a_peer_ends_with_it_too(stage):
    here = stage(
        network(
            {
                "peer": Steering(tcp_port=0),
                "base": Constant(parsed_value="10"),
                "sum": Addition(),
                "drive": DriveCommand(),
            },
            ("peer.velocity", "sum.input"),
            ("base.value", "sum.input"),
            ("sum.sum", "drive.linear_velocity"),
        )
    )
    peer = Sender()
    say(here, peer, velocity=10)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    here.tick(5)
    assert here.goal == 0


def test_the_word_of_a_peer_ages_on_the_board_between_two_networks(stage):
    hearing = network(
        {"peer": Steering(tcp_port=0), "share": Share(slot="wish")},
        ("peer.velocity", "share.number"),
    )
    driving = network(
        {"wish": Shared(slot="wish"), "drive": DriveCommand()},
        ("wish.number", "drive.linear_velocity"),
    )
    here, peer = stage(hearing, driving), Sender()
    say(here, peer, velocity=20)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    here.tick(5)
    assert here.goal == 0
    say(here, peer, velocity=20)
    here.tick()
    assert here.goal == pytest.approx(0.2)


def test_what_a_network_shared_ends_with_the_network(stage):
    giving = network(
        {"constant": Constant(parsed_value="20"), "share": Share(slot="wish")},
        ("constant.value", "share.number"),
    )
    driving = network(
        {"wish": Shared(slot="wish"), "drive": DriveCommand()},
        ("wish.number", "drive.linear_velocity"),
    )
    here = stage(giving, driving)
    here.tick(10)
    assert here.goal == pytest.approx(0.2)
    here.runners.pop(0).stop()
    here.tick()
    assert here.goal == 0


@pytest.mark.parametrize("port", ["number", "speed"])
def test_the_gate_stands_at_once_when_a_peer_falls_silent(stage, port):
    """`number`: the peer steers; `speed`: it only says how fast may be driven."""
    links = {
        "number": [("peer.speed", "commander.number")],
        "speed": [("peer.speed", "gate.speed"), ("one.value", "commander.number")],
    }
    here = stage(
        network(
            {
                "peer": Steering(tcp_port=0),
                "one": Constant(parsed_value="0.3"),
                "commander": Commander(),
                "gate": CommandGate(),
                "drive": DriveCommand(),
            },
            *links[port],
            ("commander.twist", "gate.twist"),
            ("gate.velocity", "drive.velocity"),
        )
    )
    peer = Sender()
    for _ in range(40):
        say(here, peer, speed=0.5)
        here.tick()
    assert here.goal > 0.1
    here.tick(5)
    assert here.goal == 0


def test_a_joystick_that_falls_silent_moves_nothing(stage):
    here = stage(
        network(
            {"sticks": JoystickSticks(max_linear=0.3), "drive": DriveCommand()},
            ("sticks.velocity", "drive.velocity"),
        )
    )
    stick = here.lent.resources.obtain("joystick", Joystick)
    stick.hold((0.0, -1.0))
    here.tick(40)
    assert here.goal == pytest.approx(0.3)
    stick.fall_silent(here.clock.now())
    here.tick(3)
    assert here.goal == pytest.approx(0.3)
    here.tick(2)
    assert here.goal == 0
    stick.hold((0.0, -1.0))
    here.tick()
    assert here.goal == pytest.approx(0.3)


class Keeper(Behavior):
    """Sends what it was told last, as one does that drives to a goal."""

    wish = Input[float]("double", "cm/s")
    other = Input[float]("double", "what comes in every tick")
    kept = Output[float]("double", "cm/s", LINEAR_VELOCITY)
    _wish: float | None = None

    def compute(self, now, dt):
        if self.wish.value is not None:
            self._wish = self.wish.value
        if self._wish is not None:
            self.kept.send(self._wish)


class HarmlessKeeper(Keeper):
    """The same; its author says that its output asks for no motion."""

    keeps_inputs = False


def kept_by(keeper):
    return network(
        {
            "peer": Steering(tcp_port=0),
            "own": Constant(parsed_value="5"),
            "keeper": keeper,
            "drive": DriveCommand(),
        },
        ("peer.velocity", "keeper.wish"),
        ("own.value", "keeper.other"),
        ("keeper.kept", "drive.linear_velocity"),
    )


def say_once(stage, sender, velocity):
    items = (Item("velocity", str(velocity), 1),)
    stage.runners[0].network["peer"]._receive(Message("malleable", items, sender))


def test_what_a_behavior_keeps_ends_with_the_word_of_the_peer(stage):
    here, peer = stage(kept_by(Keeper())), Sender()
    say_once(here, peer, 20)
    here.tick(3)
    assert here.goal == pytest.approx(0.2)
    here.tick(3)
    assert here.goal == 0
    say_once(here, peer, 30)
    here.tick()
    assert here.goal == pytest.approx(0.3), "a new word counts again"
    peer.is_gone = True
    here.tick(6)
    assert here.goal == 0


def test_what_is_kept_goes_on_where_its_author_says_that_it_is_harmless(stage):
    here = stage(kept_by(HarmlessKeeper()))
    say_once(here, Sender(), 20)
    here.tick(20)
    assert here.goal == pytest.approx(0.2)


def test_a_word_of_its_own_takes_the_place_of_a_word_of_the_peer(stage):
    made = kept_by(Keeper())
    made.connect("own.value", "keeper.wish")
    here = stage(made)
    say_once(here, Sender(), 20)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    here.tick(20)
    assert here.goal == pytest.approx(0.05)


class Pointing(MalleableBehavior):
    """Takes a pixel from a peer."""

    x = Output[float]("double", "column")
    y = Output[float]("double", "row")


def test_a_place_that_a_peer_points_at_is_driven_to_while_the_peer_repeats_it(stage):
    """The goal stays in `Hri.PointAndGo`; the wheels stand all the same."""
    lent = [
        Description("camera", "Hri.SimulatedCamera", {"z": "40", "pitch": "0.5"}, "world"),
        Description("odometry", "Hri.SimulatedOdometry", bus="world"),
    ]
    made = network(
        {
            "peer": Pointing(tcp_port=0),
            "point": PointAndGo(),
            "go": Beeline(),
            "drive": DriveCommand(),
        },
        ("peer.x", "point.x"),
        ("peer.y", "point.y"),
        ("point.goal", "go.goal"),
        ("go.linear_velocity", "drive.linear_velocity"),
    )
    here, peer = stage(made, lent=lent), Sender()
    for _ in range(20):
        items = (Item("x", "160", 1), Item("y", "200", 1))
        made["peer"]._receive(Message("malleable", items, peer))
        here.tick()
    assert here.goal > 0
    here.tick(6)
    assert made["point"].goal.value is not None
    assert here.goal == 0


@settings(max_examples=25)
@given(st.lists(st.floats(0, 1.9), min_size=1, max_size=4))
def test_a_value_has_the_age_of_the_oldest_word_it_rests_on(times):
    """Peers that spoke at these times, and something of our own, multiplied with each other."""
    here = None
    try:
        peers = {f"peer{at}": Steering(tcp_port=0) for at in range(len(times))}
        here = Stage(
            network(
                {**peers, "own": Constant(parsed_value="1"), "product": Multiplication()},
                *[(f"{id}.speed", "product.input") for id in peers],
                ("own.value", "product.input"),
            )
        )
        made = here.runners[0].network
        for id, time in sorted(zip(peers, times, strict=True), key=lambda pair: pair[1]):
            here.clock.advance(time - here.clock.now())
            made[id]._receive(Message("malleable", (Item("speed", "1", None),), Sender()))
        here.clock.advance(2.0 - here.clock.now())
        here.runners[0].tick(2.0)
        assert made["product"].product.spoken == pytest.approx(min(times))
        assert made["own"].value.spoken is None
    finally:
        if here is not None:
            here.close()


def test_over_a_real_connection_the_hanging_up_of_a_peer_is_the_end_of_its_word(stage, links):
    here = stage(steered())
    peer_behavior = here.runners[0].network["peer"]
    heard = Taken()
    peer_behavior._link.subscribe("malleable", heard)  # after its own listener
    _, client = links
    there = client(peer_behavior.port_in_use)
    assert there.wait_for_peers(1, WITHIN)
    there.send(encode(Message("malleable", (Item("velocity", "20", None),))))
    heard.wait_for(1)
    here.tick(interval=0.001)
    assert here.goal == pytest.approx(0.2)
    there.close()
    assert peer_behavior._link.wait_for_peers(0, WITHIN)
    here.tick(interval=0.001)
    assert here.goal == 0
