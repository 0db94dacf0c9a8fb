"""Over the bridge nothing moves, speaks or releases without the token; all else is as in 2003."""

import os
import re
import socket
import time

import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.doors import Doors
from hri.behavior.drive_command import DriveCommand
from hri.behavior.library.constant import Constant
from hri.behavior.library.printing import InputCollector
from hri.behavior.library.sharing import Share, Shared
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.runner import Runner
from hri.core.errors import HriError
from hri.core.token import VARIABLE, new_token, own_token, token_file
from hri.drive.behaviors import CommandGate
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import DriveSystem
from hri.hal.resource import Description
from hri.net.connection import Connection
from hri.net.loopback import is_loopback
from hri.net.malleable import BIND, MalleableBehavior
from hri.net.malleable_protocol import decode
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import SpeakOn
from hri.testing import context
from tests.net.conftest import WITHIN, Taken, introduction

VELOCITY = "<bridge><velocity>20</velocity></bridge>"
TICK = 0.05


class Bridge(MalleableBehavior):
    """Takes a velocity, a truth and a text, and sends a number."""

    velocity = Output[float]("double", "cm/s")
    truth = Output[bool]("boolean", "any")
    text = Output[str]("string", "any")
    number = Input[float]("double", "any")


class Sender(MalleableBehavior):
    """Sends a velocity."""

    velocity = Input[float]("double", "cm/s")


class Custom(Behavior):
    """May do anything."""

    number = Input[float]("double", "any")

    def start(self, context):
        """Who knows."""

    def compute(self, now, dt):
        self.got = self.number.values


class Robot:
    """Networks on a fake clock, a simulated base, and whoever connects with the bridge."""

    def __init__(self, doors):
        self.lent = context(
            Description("world", "Hri.SimulatedWorld"),
            Description("drive", "Hri.SimulatedDrive", bus="world"),
        )
        self.lent.doors = doors
        self.world = self.lent.resources.obtain("world", SimulatedWorld)
        self.lent.resources.obtain("drive", DriveSystem)
        self.runners = []
        self.peers = []
        self.bridge = Bridge("bridge", tcp_port=0, tag_name="bridge")
        self.heard = Taken()

    def run(self, *behaviors, links=(), name="one"):
        network = Network(name, TICK)
        for behavior in behaviors:
            network.add(behavior)
        for source, target in links:
            network.connect(source, target)
        network.sort()
        self.runners.append(Runner(network, self.lent))
        self.runners[-1].start()
        if self.bridge in behaviors:
            self.bridge._link.subscribe("bridge", self.heard)  # after the bridge's own listener
            self.bridge._link.subscribe("hri", self.heard)
        self.tick()

    def tick(self, times=1):
        for _ in range(times):
            self.lent.clock.advance(TICK)
            for runner in self.runners:
                runner.tick(self.lent.clock.now())

    def connect(self, token=""):
        self.peers.append(Connection(port=self.bridge.port_in_use, timeout=WITHIN, token=token))
        return self.peers[-1]

    def send(self, peer, *lines):
        """Send lines and wait until they have been heard."""
        count = len(self.heard.messages)
        for line in lines:
            peer.send(line)
        self.heard.wait_for(count + len(lines))

    @staticmethod
    def wait_until(holds):
        """Wait for the thread of a port, which has no bell for this."""
        end = time.perf_counter() + WITHIN
        while not holds():
            assert time.perf_counter() < end
            os.sched_yield()

    @property
    def goal(self):
        """The velocity that the wheels are led to, m/s."""
        (base,) = self.lent.resources.opened(BaseBus)
        return base.state.target.linear

    def close(self):
        for peer in self.peers:
            peer.close()
        for runner in self.runners:
            runner.stop()
        self.lent.resources.close()


@pytest.fixture
def robot():
    made = []

    def start(**doors):
        made.append(Robot(Doors(**doors)))
        return made[-1]

    yield start
    for one in made:
        one.close()


def steered(robot):
    robot.run(robot.bridge, DriveCommand("drive"), links=[DIRECTLY])
    return robot


DIRECTLY = ("bridge.velocity", "drive.linear_velocity")


# --- the base ---


def test_nobody_moves_the_base_without_the_token(robot, caplog):
    here = steered(robot())
    peer = here.connect()
    here.send(peer, VELOCITY)
    here.tick()
    assert here.goal == 0
    (told,) = decode(peer.read().encode()).items
    assert (told.port, "bridge.velocity moves the robot" in told.text) == ("refused", True)
    (line,) = [r.getMessage() for r in caplog.records if r.levelname == "WARNING"]
    assert "hri token" in line
    assert "--trusted bridge.velocity" in line


def test_who_shows_it_drives(robot):
    here = steered(robot())
    here.send(here.connect(own_token()), VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)


def test_the_client_classes_show_it_by_themselves(robot, links):
    here = steered(robot())
    here.send(here.connect(token=None), VELOCITY)  # as a script does that gives none
    here.tick()
    assert here.goal == pytest.approx(0.2)


@pytest.mark.parametrize("shown", ["x" * 43, " ", "\u00fc" * 20])
def test_a_wrong_token_costs_the_connection(robot, shown):
    here = steered(robot())
    peer = here.connect()
    peer.send(introduction(shown).decode().strip())
    assert "this is not the token" in peer.read()
    with pytest.raises(EOFError):
        peer.read()


def test_one_that_was_sent_by_hand_counts_as_before(robot):
    here = steered(robot())
    peer = here.connect()
    peer.send(introduction(own_token()).decode().strip())
    here.send(peer, VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)


def test_a_client_that_came_before_the_token_was_made_shows_it_later(robot, caplog):
    """The board is followed only when both networks run; until then nothing needs a token."""
    here, there = robot(), robot()
    here.run(here.bridge, Share("share", slot="wish"), links=[("bridge.velocity", "share.number")])
    there.bridge = Sender("peer", tcp_host="127.0.0.1", tcp_port=here.bridge.port_in_use)
    there.bridge.set_parameter("tag_name", "bridge")
    speed = Constant("speed", parsed_value="20")
    there.run(speed, there.bridge, links=[("speed.value", "peer.velocity")])
    # A client looks for a token when it connects, which is later than it is let in.
    assert here.bridge._link.wait_for_peers(1, WITHIN)
    assert there.bridge._link.wait_for_peers(1, WITHIN)
    takes = [Shared("shared", slot="wish"), DriveCommand("drive")]
    here.run(*takes, links=[("shared.number", "drive.linear_velocity")], name="two")
    here.tick()
    assert token_file().exists()
    there.tick()
    (peer,) = here.bridge._link._peers
    there.wait_until(lambda: peer.is_authorized)
    assert "takes no value without the token" in caplog.text
    count = len(here.heard.messages)
    there.tick()
    here.heard.wait_for(count + 1)
    here.tick()
    assert here.goal == pytest.approx(0.2)


def test_a_token_that_was_replaced_is_a_wrong_one(robot):
    here = steered(robot())
    old = own_token()
    new_token()
    peer = here.connect()
    peer.send(introduction(old).decode().strip())
    assert "this is not the token" in peer.read()


def test_a_connection_loses_what_a_token_gave_it_when_that_is_replaced(robot):
    here = steered(robot())
    peer = here.connect(own_token())
    here.send(peer, VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    new_token()
    here.send(peer, VELOCITY)
    here.tick(5)
    assert here.goal == 0
    (told,) = decode(peer.read().encode()).items
    assert "takes no value without the token" in told.text
    peer.send(introduction(own_token()).decode().strip())
    here.send(peer, VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)


def test_what_was_said_before_the_token_was_replaced_goes_on_no_more(robot):
    """A value without a count is repeated, whether its sender says anything or not."""
    here = robot()
    here.run(here.bridge)
    seen = []
    here.runners[0].watch("bridge", "text", lambda text, now: seen.append(text))
    here.tick()
    here.send(here.connect(own_token()), "<bridge><text>hello</text></bridge>")
    here.tick(2)
    assert seen == ["hello", "hello"]
    new_token()
    here.tick(2)
    assert seen == ["hello", "hello"]


def test_a_peer_that_was_refused_before_it_had_the_token_hears_of_a_new_one(robot):
    here = steered(robot())
    peer = here.connect()
    here.send(peer, VELOCITY)
    assert "without the token" in peer.read()
    peer.send(introduction(own_token()).decode().strip())
    here.send(peer, VELOCITY)
    new_token()
    here.send(peer, VELOCITY)
    assert "without the token" in peer.read()


def test_a_client_of_ours_shows_the_new_one_by_itself(robot):
    here, there = steered(robot()), robot()
    there.bridge = Sender("peer", tcp_host="127.0.0.1", tcp_port=here.bridge.port_in_use)
    there.bridge.set_parameter("tag_name", "bridge")
    speed = Constant("speed", parsed_value="20")
    there.run(speed, there.bridge, links=[("speed.value", "peer.velocity")])
    assert here.bridge._link.wait_for_peers(1, WITHIN)
    (peer,) = here.bridge._link._peers
    there.wait_until(lambda: peer.is_authorized)
    new_token()
    assert not peer.is_authorized
    there.tick()
    there.wait_until(lambda: peer.is_authorized)


def test_the_one_of_the_environment_counts_on_both_sides(robot, monkeypatch):
    monkeypatch.setenv(VARIABLE, "chosen-by-the-user")
    here = steered(robot())
    here.send(here.connect(token=None), VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    assert not token_file().exists()


def test_where_a_port_needs_it_it_is_made_when_the_network_starts(robot):
    assert not token_file().exists()
    steered(robot())
    assert token_file().exists()


def test_where_tasks_run_it_is_made_before_anybody_can_connect(robot):
    """A task may begin to watch a port at any time; who connected before would have no token."""
    here = robot()
    here.lent.has_tasks = True
    here.bridge.start(here.lent)
    try:
        assert token_file().exists()
    finally:
        here.bridge.stop()


def test_without_a_port_that_needs_it_none_is_made(robot):
    here = robot()
    here.run(here.bridge, InputCollector("show"), links=[("bridge.velocity", "show.input")])
    assert not token_file().exists()


def test_a_value_of_a_stranger_pushes_out_none_of_who_may_drive(robot):
    here = steered(robot())
    driver, stranger = here.connect(own_token()), here.connect()
    here.send(driver, VELOCITY)
    here.send(stranger, *["<bridge><velocity>-50</velocity></bridge>"] * 20)
    here.tick()
    assert here.goal == pytest.approx(0.2)


# --- what else needs it, and what does not ---


def test_the_wire_of_2003_stays_as_it_is_for_what_does_nothing(robot, capsys):
    here = robot()
    here.run(here.bridge, InputCollector("show"), links=[("bridge.velocity", "show.input")])
    peer = here.connect()
    here.send(peer, VELOCITY)
    here.tick()
    assert "Input show  double: 20" in capsys.readouterr().out
    with pytest.raises(TimeoutError):
        peer.read(0.01)


@pytest.mark.parametrize(
    ("target", "line", "link"),
    [
        (CommandGate("gate"), None, None),
        (SpeakOn("voice"), "<bridge><truth>true</truth></bridge>", "bridge.truth voice.trigger"),
        (Custom("custom"), VELOCITY, "bridge.velocity custom.number"),
    ],
    ids=["nothing", "speaks", "anything"],
)
def test_speaking_and_whatever_is_not_known_need_it_too(robot, target, line, link):
    here = robot()
    network = Network("one", TICK)
    for behavior in (here.bridge, target):
        network.add(behavior)
    if link is not None:
        network.connect(*link.split())
    runner = Runner(network, here.lent)
    here.lent.runners.append(runner)  # its links count, its voice is not needed
    here.bridge.start(here.lent)
    here.bridge.compute(0.0, 0.0)
    here.bridge._link.subscribe("bridge", here.heard)
    try:
        peer = here.connect()
        here.send(peer, line or VELOCITY)
        if link is None:
            with pytest.raises(TimeoutError):
                peer.read(0.01)
        else:
            assert "takes no value without the token" in peer.read()
    finally:
        here.bridge.stop()


def test_the_board_is_no_way_around(robot):
    here = robot()
    shares = [here.bridge, Share("share", slot="wish")]
    here.run(*shares, links=[("bridge.velocity", "share.number")])
    takes = [Shared("shared", slot="wish"), DriveCommand("drive")]
    here.run(*takes, links=[("shared.number", "drive.linear_velocity")], name="two")
    here.tick(2)
    here.send(here.connect(), VELOCITY)
    here.tick(3)
    assert here.goal == 0
    here.send(here.connect(own_token()), VELOCITY)
    here.tick(2)
    assert here.goal == pytest.approx(0.2)


def test_a_value_that_came_before_the_port_reached_the_base_moves_nothing(robot):
    here = robot()
    here.run(here.bridge, Share("share", slot="wish"), links=[("bridge.velocity", "share.number")])
    peer = here.connect()
    here.send(peer, VELOCITY)
    here.tick()
    takes = [Shared("shared", slot="wish"), DriveCommand("drive")]
    here.run(*takes, links=[("shared.number", "drive.linear_velocity")], name="two")
    here.send(peer, "<bridge><text>still here</text></bridge>")
    here.tick(3)
    assert here.goal == 0


def test_what_code_watches_needs_it(robot):
    here = robot()
    here.run(here.bridge)
    here.runners[0].watch("bridge", "text", print)
    here.tick()
    peer = here.connect()
    here.send(peer, "<bridge><text>hello</text></bridge>")
    assert "bridge.text may do anything" in peer.read()


def test_what_is_watched_in_place_of_something_else_needs_it_too(robot):
    here = robot()
    here.run(here.bridge)
    watch = here.runners[0].watch("bridge", "truth", print)
    here.tick()
    watch.cancel()
    here.runners[0].watch("bridge", "text", print)
    here.tick()
    peer = here.connect()
    here.send(peer, "<bridge><truth>true</truth></bridge>", "<bridge><text>hello</text></bridge>")
    assert "bridge.text may do anything" in peer.read()


@pytest.mark.parametrize("trusted", ["bridge", "bridge.velocity", "b*", "*.velocity"])
def test_who_starts_it_may_trust_everybody(robot, trusted):
    here = steered(robot(trusted=(trusted,)))
    here.send(here.connect(), VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)


@pytest.mark.parametrize("trusted", ["other", "bridge.text", "velocity", ""])
def test_trusting_something_else_does_not_help(robot, trusted):
    here = steered(robot(trusted=(trusted,)))
    here.send(here.connect(), VELOCITY)
    here.tick()
    assert here.goal == 0


def test_a_client_takes_nothing_of_a_server_that_moves_the_robot(robot, links):
    """It shows the token; a server shows none, and may be anybody."""
    server, _ = links
    there, here = server(), robot()
    here.bridge = Bridge("bridge", tcp_host="127.0.0.1", tcp_port=there.port, tag_name="bridge")
    steered(here)
    assert there.wait_for_peers(1, WITHIN)
    there.send(VELOCITY.encode() + b"\n")
    here.heard.wait_for(1)
    here.tick()
    assert here.goal == 0


# --- stop ---


def test_anybody_on_this_machine_stops_it_and_who_drives_must_let_go(robot, caplog):
    here = steered(robot())
    driver, other = here.connect(own_token()), here.connect()
    here.send(driver, VELOCITY)
    here.tick()
    assert here.goal == pytest.approx(0.2)
    for _ in range(2):
        here.send(other, "<hri><stop/></hri>")
        here.tick()
    assert here.goal == 0
    (told,) = (line for line in caplog.messages if "drive stops" in line)
    assert "over the network - who steers is heard again after a velocity of 0" in told
    here.send(driver, VELOCITY)
    here.tick()
    assert here.goal == 0
    here.send(driver, "<bridge><velocity>0</velocity></bridge>")
    here.tick()
    here.send(driver, VELOCITY)
    here.tick(2)
    assert here.goal == pytest.approx(0.2)


def test_it_stops_a_gate_as_well(robot):
    here = robot()
    here.run(here.bridge, CommandGate("gate"), DriveCommand("drive"), links=[GATED])
    gate = here.runners[0].network["gate"]
    halted = []
    here.lent.events.subscribe("drive.halt", halted.append)
    here.send(here.connect(), "<hri><stop/></hri>")
    here.tick()
    assert [event.origin for event in halted] == ["bridge"]
    assert not gate.is_moving


GATED = ("gate.velocity", "drive.velocity")


def test_from_another_machine_a_stop_needs_the_token(robot):
    here = steered(robot())
    peer = here.connect()
    here.send(peer, "<bridge><text>here</text></bridge>")
    (there,) = here.bridge._link._peers
    there.is_local = False
    peer.send("<hri><stop/></hri>")
    assert "it takes the token" in peer.read()
    peer.send(introduction(own_token()).decode().strip())
    here.send(peer, "<hri><stop/></hri>")
    assert here.bridge._is_told_to_stop


# --- other machines ---


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "10.1.2.3", "example.invalid", "127.0.0.1.x"])
@pytest.mark.parametrize("where", ["bind", BIND])
def test_nothing_but_loopback_is_bound_unless_it_is_allowed(host, where, monkeypatch):
    behavior = Bridge("bridge", tcp_port=0)
    if where == BIND:
        monkeypatch.setenv(BIND, host)
    else:
        behavior.set_parameter("bind", host)
    with pytest.raises(HriError, match=f"{where} .*lets other machines in - .*--allow-remote"):
        behavior.start(context())


def test_it_is_bound_when_the_command_line_allows_it():
    behavior, lent = Bridge("bridge", tcp_port=0, bind="0.0.0.0"), context()
    lent.doors = Doors(allows_remote=True)
    behavior.start(lent)
    try:
        # Nobody listens at this address of the machine who listens at 127.0.0.1 alone.
        with Connection("127.0.0.2", behavior.port_in_use, timeout=WITHIN) as connection:
            connection.send("<tag><x>1</x></tag>")
    finally:
        behavior.stop()


@pytest.mark.parametrize(
    "host", ["127.0.0.1", "127.8.9.10", "::1", "localhost", "::ffff:127.0.0.1"]
)
def test_what_is_loopback(host):
    assert is_loopback(host)


def test_another_machine_is_shown_no_token_of_the_file(monkeypatch):
    """Whoever listens there would have it."""
    own_token()
    with socket.create_server(("127.0.0.1", 0)) as listening:
        port = listening.getsockname()[1]
        monkeypatch.setattr("hri.net.connection.is_loopback", lambda host: False)
        with Connection(port=port, timeout=WITHIN) as connection:
            connection.send("first")
            other = listening.accept()[0]
            with other:
                other.settimeout(WITHIN)
                assert other.recv(100) == b"first\n"


def test_a_network_file_cannot_open_a_door(tmp_path):
    """Trust is said by who starts the program."""
    from hri.behavior.network_file import load_network

    for name in ("trusted", "allow_remote", "token"):
        file = tmp_path / "network.xml"
        file.write_text(
            '<BehaviorNetwork name="n"><Behavior id="s" type="Examples.TutorialServer">'
            f'<Parameter name="{name}" value="1"/></Behavior></BehaviorNetwork>'
        )
        with pytest.raises(HriError, match=re.escape(f'no parameter "{name}"')):
            load_network(file)
