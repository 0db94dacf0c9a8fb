import math
import socket

import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.ports import Input, Output
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.errors import HriError
from hri.net.connection import Connection
from hri.net.malleable import MalleableBehavior
from hri.net.malleable_protocol import encode
from hri.testing import context
from tests.net.conftest import WITHIN, Taken


class Ear:
    """Waits for messages that reach a behavior: the next listener after its own."""

    def __init__(self, behavior):
        self.taken = Taken()
        behavior._link.subscribe(behavior.tag_name, self.taken)

    def wait_for(self, count):
        return self.taken.wait_for(count)


@pytest.fixture
def start():
    """Starts networks, and stops them."""
    lent = context()
    runners = []

    def started(network):
        network.check()
        runners.append(Runner(network, lent))
        runners[-1].start()
        return runners[-1]

    yield started
    for runner in runners:
        runner.stop()


@pytest.fixture
def server(start):
    network = load_network(paths.find("config", "networks/server.xml"))
    network["server"].set_parameter("tcp_port", 0)
    return start(network)


@pytest.fixture
def client(start, server):
    network = load_network(paths.find("config", "networks/client.xml"))
    network["client"].set_parameter("tcp_port", server.network["server"].port_in_use)
    runner = start(network)
    assert server.network["server"]._link.wait_for_peers(1, WITHIN)
    assert runner.network["client"]._link.wait_for_peers(1, WITHIN)
    return runner


SERVER_PRINTS = """\
Input array_received  DoubleArray.
0: 1
1: 2
2: 3
Input text_received  string: "text from client"
"""


@pytest.mark.proves("W01", "W02", "W03", "W07", "W12", "B28")
def test_the_two_networks_of_the_tutorial_print_what_the_guide_shows(server, client, capsys):
    heard, answered = Ear(server.network["server"]), Ear(client.network["client"])
    for tick in range(1, 4):
        client.tick(tick * 0.1)
        printed = capsys.readouterr().out
        assert printed == ("Input client_received  double: 5\n" if tick > 1 else "")
        heard.wait_for(tick)
        server.tick(tick * 0.1)
        assert capsys.readouterr().out == SERVER_PRINTS
        answered.wait_for(tick)


@pytest.mark.proves("W05", "W06", "W07", "W11", "W12", "E4")
def test_a_foreign_client_sees_the_bytes_of_the_guide_and_is_understood(server, capsys):
    behavior = server.network["server"]
    heard = Ear(behavior)
    with Connection("127.0.0.1", behavior.port_in_use, WITHIN) as connection:
        assert behavior._link.wait_for_peers(1, WITHIN)
        server.tick(0.0)
        assert connection.read() == '<tutorial><number count="1">5.000000</number></tutorial>'
        connection.send('<tutorial><text count="1">reply from client</text></tutorial>')
        heard.wait_for(1)
    server.tick(0.1)
    server.tick(0.2)
    assert capsys.readouterr().out == "Input text_received  string: reply from client\n"


@pytest.mark.proves("W04")
def test_a_server_sends_to_all_its_clients(server):
    behavior = server.network["server"]
    with (
        Connection("127.0.0.1", behavior.port_in_use, WITHIN) as one,
        Connection("127.0.0.1", behavior.port_in_use, WITHIN) as two,
    ):
        assert behavior._link.wait_for_peers(2, WITHIN)
        server.tick(0.0)
        assert one.read() == two.read()


class Talker(MalleableBehavior):
    """Sends and takes a text and a truth."""

    said = Input[str]("string", "to send")
    so = Input[bool]("boolean", "to send")
    heard = Output[str]("string", "taken")
    truth = Output[bool]("boolean", "taken")


class Watched(Behavior):
    """Keeps all it is sent."""

    text = Input[str]("string", "a text")

    def start(self, context):
        self.seen = []

    def compute(self, now, dt):
        self.seen += self.text.values


@pytest.mark.proves("W02")
def test_behaviors_on_one_port_are_told_apart_by_their_tag(start):
    network = Network("tags")
    network.add(Talker("a", tcp_port=0, tag_name="a"))
    first = start(network)
    port = network["a"].port_in_use
    others = Network("more")
    others.add(Talker("b", tcp_port=port, tag_name="b"))
    second = start(others)
    assert network["a"]._link is others["b"]._link
    ears = Ear(network["a"]), Ear(others["b"])
    with Connection("127.0.0.1", port, WITHIN) as connection:
        connection.send("<a><heard>for a</heard></a>\n<b><heard>for b</heard></b>")
        for ear in ears:
            ear.wait_for(1)
    first.tick(0.0)
    second.tick(0.0)
    assert network["a"].heard.value == "for a"
    assert others["b"].heard.value == "for b"


def test_every_value_of_every_link_is_sent_and_quotes_can_be_taken_off(start):
    here = Network("here")
    here.add(Talker("t", tcp_port=0, tag_name="t", keep_quotes=False))
    watched = here.add(Watched("w"))
    here.connect("t.heard", "w.text")
    runner = start(here)
    there = Network("there")
    port = here["t"].port_in_use
    there.add(Talker("t", tcp_host="localhost", tcp_port=port, tag_name="t"))
    sender = start(there)
    assert there["t"]._link.wait_for_peers(1, WITHIN)
    for text in ("one", "two"):
        sender.inject("t", "said", text)
    sender.inject("t", "so", True)
    ear = Ear(here["t"])
    sender.tick(0.0)
    (message,) = ear.wait_for(1)
    assert encode(message) == (
        b'<t><said count="1">&quot;one&quot;</said><said count="1">&quot;two&quot;</said>'
        b'<so count="1">true</so></t>\n'
    )
    sender.tick(0.1)
    with Connection("127.0.0.1", port, WITHIN) as connection:
        connection.send('<t><heard count="1">"one"</heard><heard count="1">two</heard></t>')
        ear.wait_for(2)
    for tick in range(3):
        runner.tick(tick * 0.1)
    assert watched.seen == ["one", "two"]


def test_a_peer_that_sends_what_a_port_cannot_take_is_dropped(server, caplog):
    behavior = server.network["server"]
    with Connection("127.0.0.1", behavior.port_in_use, WITHIN) as connection:
        connection.send("<tutorial><text>ok</text><array>1 two</array></tutorial>")
        with pytest.raises((EOFError, ConnectionResetError)):
            connection.read()
    assert '"1 two" is not a doublearray' in caplog.text
    server.tick(0.0)
    assert behavior.text.value is None


def test_what_cannot_travel_is_refused():
    class Eye(MalleableBehavior):
        """Would send pictures."""

        picture = Input[object]("image", "a picture")

    with pytest.raises(HriError, match=r"eye\.picture is image, which does not travel"):
        Eye("eye").check()
    with pytest.raises(HriError, match="names no tag or port"):
        Talker("t", tag_name="a b").check()


def test_servers_bind_to_loopback_unless_told_otherwise(start, monkeypatch):
    def where(**parameters):
        network = Network(f"n{len(parameters)}")
        network.add(Talker("t", tcp_port=0, **parameters))
        start(network)
        with socket.socket() as probe:
            probe.settimeout(WITHIN)
            return network["t"]._link.host

    assert where() == "127.0.0.1"
    assert where(bind="127.0.0.3") == "127.0.0.3"
    monkeypatch.setenv("HRI_BIND", "127.0.0.2")
    assert where() == "127.0.0.2"


@pytest.mark.proves("W01", "W02", "E7", "E8")
def test_a_schema_alone_makes_a_behavior(tmp_path, monkeypatch):
    folder = tmp_path / "behavior" / "MyBehaviors"
    folder.mkdir(parents=True)
    (folder / "SendNumbers.xml").write_text(
        '<BehaviorSchema type="MyBehaviors.SendNumbers" driver="Evolution.MalleableBehavior"'
        ' display_name="Send Some Numbers" library="libevobeutil" category="sample_code">'
        '<Parameter name="tcp_host" type="string" default="192.0.2.21"/>'
        '<Parameter name="tag_name" type="string" default="some_numbers"/>'
        '<Output><Port name="velocity" datatype="double" description="Incoming velocity."'
        ' semantic_type="Evolution.LinearVelocity"/></Output></BehaviorSchema>'
    )
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    cls = find_behavior("MyBehaviors.SendNumbers")
    assert issubclass(cls, MalleableBehavior)
    assert list(cls.outputs) == ["velocity"]
    made = cls("s")
    assert (made.tcp_host, made.tcp_port, made.tag_name) == ("192.0.2.21", 25000, "some_numbers")


@pytest.fixture
def pair(start):
    """A behavior that sends, the runner of it, and the ear of the one that takes."""
    here, there = Network("here"), Network("there")
    here.add(Talker("t", tcp_port=0, tag_name="t"))
    start(here)
    there.add(Talker("t", tcp_host="localhost", tcp_port=here["t"].port_in_use, tag_name="t"))
    sender = start(there)
    assert there["t"]._link.wait_for_peers(1, WITHIN)
    return sender, Ear(here["t"])


def test_what_is_too_much_for_a_line_goes_in_several(pair):
    sender, ear = pair
    texts = [f"Some.Longer.Event.Name.Number{number:05d}" for number in range(2000)]
    for text in texts:
        sender.inject("t", "said", text)
    sender.tick(0.0)
    assert sender.statistics.failures == 0
    messages = ear.wait_for(3)
    assert [item.text for m in messages for item in m.items] == [f'"{text}"' for text in texts]


def test_a_value_too_long_for_a_line_costs_only_itself(pair, caplog):
    sender, ear = pair
    for tick in range(3):
        for text in ("before", "x" * 70_000, "after"):
            sender.inject("t", "said", text)
        sender.tick(tick * 0.1)
    assert sender.statistics.failures == 0
    texts = [item.text for message in ear.wait_for(3) for item in message.items]
    assert texts == ['"before"', '"after"'] * 3
    assert caplog.text.count("t.said: a value of 70002 characters is not sent") == 1


class Gauge(MalleableBehavior):
    """Sends and takes measurements."""

    measured = Input[float]("double", "to send")
    row = Input[tuple[float, ...]]("doublearray", "to send")
    number = Output[float]("double", "taken")


def test_no_nan_goes_out_and_costs_the_connection(start, caplog):
    here, there = Network("here"), Network("there")
    here.add(Gauge("g", tcp_port=0))
    start(here)
    there.add(Gauge("g", tcp_host="localhost", tcp_port=here["g"].port_in_use))
    sender = start(there)
    assert there["g"]._link.wait_for_peers(1, WITHIN)
    ear = Ear(here["g"])
    sender.inject("g", "measured", math.nan)
    sender.inject("g", "row", (1.0, math.nan))
    sender.tick(0.0)
    for value in (math.nan, math.inf, 1.0):
        sender.inject("g", "measured", value)
    sender.inject("g", "row", (1.0, 2.0))
    sender.tick(0.1)
    (message,) = ear.wait_for(1)
    assert [item.text for item in message.items] == ["inf", "1.000000", "1.000000 2.000000"]
    assert not caplog.records
