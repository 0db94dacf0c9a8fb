"""A client proves that it knows the token, and whoever listens learns nothing that helps."""

import os
import re
import socket
import threading
import time
from contextlib import suppress

import pytest

from hri.core.token import Challenge, new_nonce, new_token, own_token, proof
from hri.net import client, connection, control, handshake
from hri.net.connection import Connection
from hri.net.malleable_protocol import decode
from hri.net.other_end import ends_of_client, ends_of_server
from hri.net.server import Server
from tests.net.conftest import WITHIN, Taken

VALUE = b"<t><x>1</x></t>\n"
LINES = {
    "silent": lambda hello: b"",
    "echo": lambda hello: hello,
    "nonsense": lambda hello: b"<hri><challenge>\xff</challenge></hri>\n",
    "nothing": lambda hello: b"<hri><challenge></challenge></hri>\n",
    "no proof": lambda hello: control.challenge(Challenge(hello, new_nonce(), ENDS), ""),
    "a guess": lambda hello: control.challenge(
        made := Challenge(nonce_of(hello), new_nonce(), ENDS), proof("x" * 43, "server", made)
    ),
    "a long nonce": lambda hello: control.challenge(Challenge("", "n" * 60_000, ENDS), "0" * 64),
    "not ASCII": lambda hello: control.challenge(Challenge("", new_nonce(), ENDS), "\u00fc" * 64),
    "an old robot": lambda hello: control.refusal("t.x moves the robot: takes no value"),
}
"""What a listener answers to a hello."""


def wait_until(holds):
    """Wait for the thread of a port, which has no bell for this."""
    end = time.perf_counter() + WITHIN
    while not holds():
        assert time.perf_counter() < end
        os.sched_yield()


ENDS = "127.0.0.1 1 127.0.0.1 2"


def nonce_of(hello):
    return control.said(decode(hello), control.HELLO)


class Stranger:
    """A program of someone else that got the port first, and keeps all that it is sent."""

    def __init__(self, answer, port=0):
        self._answer = answer
        self._listening = socket.create_server(("127.0.0.1", port))
        self.port = self._listening.getsockname()[1]
        self.heard = b""
        self.has_answered = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        peer, _ = self._listening.accept()
        self._listening.close()
        with peer, peer.makefile("rb") as lines, suppress(ConnectionError):
            self.heard = lines.readline()
            peer.sendall(self._answer(self.heard))
            self.has_answered.set()
            for line in lines:
                self.heard += line

    def all_heard(self):
        """What it was sent, once the connection has ended."""
        self._thread.join(WITHIN)
        assert not self._thread.is_alive()
        return self.heard


@pytest.fixture
def impatient(monkeypatch):
    for module in (client, connection):
        monkeypatch.setattr(module, "TO_CHALLENGE", 0.01)


@pytest.fixture(params=LINES)
def stranger(request):
    return Stranger(LINES[request.param])


HELLO = rb"<hri><hello>[\w-]{22}</hello></hri>\n"


@pytest.mark.usefixtures("impatient")
def test_a_stranger_gets_nothing_of_a_script(stranger):
    token = own_token()
    with Connection(port=stranger.port, timeout=WITHIN) as here:
        here.send(VALUE.decode().strip())
    heard = stranger.all_heard()
    assert re.fullmatch(HELLO + VALUE, heard)
    assert token.encode() not in heard


@pytest.mark.usefixtures("impatient")
def test_a_stranger_gets_nothing_of_a_network(stranger, links):
    token = own_token()
    _, connect = links
    there = connect(stranger.port, proves_token=True)
    assert stranger.has_answered.wait(WITHIN)
    there.send(VALUE)
    there.close()
    heard = stranger.all_heard()
    assert re.fullmatch(HELLO + b"(" + VALUE + b")?", heard)
    assert token.encode() not in heard


class Robot:
    """The real one, and who was allowed to do more than a stranger."""

    def __init__(self, port=0, host="127.0.0.1"):
        self.server = Server(host, port)
        self.port = self.server.port
        self.taken = Taken()
        self.server.subscribe("t", self.taken)
        self._asked = 0

    def is_known(self):
        """Whether who has sent the next value is authorized."""
        self._asked += 1
        return self.taken.wait_for(self._asked)[self._asked - 1].sender.is_authorized


@pytest.fixture
def robot():
    made = []

    def start(port=0, host="127.0.0.1"):
        made.append(Robot(port, host))
        return made[-1]

    yield start
    for one in made:
        one.server.close()


def proves(robot, port=None):
    """Whether a script that connects there is known to the robot afterwards."""
    with Connection(port=port or robot.port, timeout=WITHIN) as here:
        here.send(VALUE.decode().strip())
        return robot.is_known()


def test_who_knows_the_token_is_known_and_does_not_send_it(robot, monkeypatch):
    token, here, sent = own_token(), robot(), []
    send = Connection._send
    monkeypatch.setattr(Connection, "_send", lambda c, data: (sent.append(data), send(c, data)))
    assert proves(here)
    assert token.encode() not in b"".join(sent)
    assert b"<proof>" in b"".join(sent)


class Relay:
    """Passes everything on, in both directions, between whoever comes and the robot."""

    def __init__(self, to, listening=None):
        self._listening = listening or socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self._to = to
        self.passed = [b"", b""]
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        client, _ = self._listening.accept()
        self._listening.close()
        with client, socket.create_connection(("127.0.0.1", self._to())) as robot:
            back = threading.Thread(target=self._pass, args=(robot, client, 1))
            back.start()
            self._pass(client, robot, 0)
            back.join(WITHIN)

    def _pass(self, source, target, which):
        while data := source.recv(65_536):
            self.passed[which] += data
            target.sendall(data)
        target.shutdown(socket.SHUT_WR)


@pytest.mark.parametrize(
    ("bind", "dialed"),
    [("::1", "::1"), ("0.0.0.0", "127.0.0.2"), ("127.0.0.1", "localhost")],
)
def test_both_sides_mean_the_same_ends_by_whatever_address(bind, dialed, robot):
    if bind == "::1" and not has_ipv6():
        pytest.skip("no IPv6 here")
    own_token()
    here = robot(host=bind)
    with Connection(dialed, here.port, WITHIN) as script:
        script.send(VALUE.decode().strip())
        assert here.is_known()


def has_ipv6():
    try:
        socket.create_server(("::1", 0), family=socket.AF_INET6).close()
    except OSError:
        return False
    return True


@pytest.mark.skipif(not socket.has_dualstack_ipv6(), reason="no IPv6 here")
def test_an_address_inside_ipv6_is_written_as_it_is_seen_there():
    listening = socket.create_server(("::", 0), family=socket.AF_INET6, dualstack_ipv6=True)
    here = socket.create_connection(("127.0.0.1", listening.getsockname()[1]), WITHIN)
    with listening, here, listening.accept()[0] as there:
        assert there.getpeername()[0] == "::ffff:127.0.0.1"
        assert ends_of_server(there) == ends_of_client(here)


@pytest.mark.usefixtures("impatient")
def test_a_challenge_that_comes_late_is_answered_by_who_reads(caplog):
    token, may_answer = own_token(), threading.Event()
    ends = []

    def answer(hello):
        assert may_answer.wait(WITHIN)
        made = Challenge(nonce_of(hello), new_nonce(), *ends)
        return control.challenge(made, proof(token, "server", made)) + VALUE

    stranger = Stranger(answer)  # who knows the token, and so is none
    with Connection(port=stranger.port, timeout=WITHIN) as script:
        ends.append(ends_of_client(script._socket))
        may_answer.set()
        assert script.read() == VALUE.decode().strip(), "and not the challenge"
    assert b"<proof>" in stranger.all_heard()
    assert "asks for no proof" in caplog.text


def test_a_stranger_between_gets_no_proof(robot, monkeypatch, caplog):
    monkeypatch.setattr(handshake, "is_program_of_this_user", lambda connection: False)
    own_token()
    here = robot()
    relay = Relay(lambda: here.port)
    assert not proves(here, relay.port)
    assert b"<challenge>" in relay.passed[1], "of the real robot"
    assert re.fullmatch(HELLO + VALUE, relay.passed[0])
    (told,) = caplog.messages
    assert "another program stands between this one and the robot" in told


def test_a_stranger_who_gives_the_robot_its_port_back_gets_no_proof(robot, monkeypatch):
    """The address is right then, but the connection is another one."""
    monkeypatch.setattr(handshake, "is_program_of_this_user", lambda connection: False)
    own_token()
    listening = socket.create_server(("127.0.0.1", 0))
    port = listening.getsockname()[1]
    here = []

    def give_back():
        here.append(robot(port))
        return port

    relay = Relay(give_back, listening)
    with Connection(port=port, timeout=WITHIN) as script:
        script.send(VALUE.decode().strip())
        assert not here[0].is_known()
    assert b"<proof>" in relay.passed[1]
    assert b"<proof>" not in relay.passed[0]


def test_a_tunnel_of_ones_own_leads_to_the_robot(robot):
    own_token()
    here = robot()
    assert proves(here, Relay(lambda: here.port).port)


class Raw:
    """A peer that says what it wants."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), WITHIN)
        self.lines = self.socket.makefile("rb")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.lines.close()
        self.socket.close()

    def say(self, line):
        self.socket.sendall(line)

    def read(self, what):
        return control.said(decode(self.lines.readline()), what)

    def challenge(self, nonce):
        self.say(control.hello(nonce))
        asked = decode(self.lines.readline())
        shown, server, ends = (control.said(asked, n) for n in ("proof", "challenge", "ends"))
        return Challenge(nonce, server, ends), shown


def is_refused(peer):
    """Whether a peer gets a refusal and loses its connection."""
    why = peer.read(control.REFUSED)
    return "this does not prove the token" in why and peer.lines.readline() == b""


def test_the_server_proves_first_and_states_both_ends(robot):
    token, here = own_token(), robot()
    with Raw(here.port) as peer:
        asked, shown = peer.challenge(nonce := new_nonce())
        port = peer.socket.getsockname()[1]
        assert asked.client == nonce
        assert asked.ends == f"127.0.0.1 {port} 127.0.0.1 {here.port}"
        assert shown == proof(token, "server", asked)
        peer.say(control.proven(proof(token, "client", asked)) + VALUE)
        assert here.is_known()


def test_no_proof_can_be_used_again(robot):
    token, here, nonce = own_token(), robot(), new_nonce()
    with Raw(here.port) as peer, Raw(here.port) as later:
        asked, _ = peer.challenge(nonce)
        shown = control.proven(proof(token, "client", asked))
        peer.say(shown + VALUE)
        assert here.is_known()
        peer.say(shown)
        assert is_refused(peer)
        later.challenge(nonce)
        later.say(shown)
        assert is_refused(later)


def test_the_servers_own_proof_is_not_the_clients(robot):
    own_token()
    with Raw(robot().port) as peer:
        _, shown = peer.challenge(new_nonce())
        peer.say(control.proven(shown))
        assert is_refused(peer)


def test_the_challenge_of_one_connection_is_worth_nothing_on_another(robot):
    token, here = own_token(), robot()
    with Raw(here.port) as peer, Raw(here.port) as other:
        asked, _ = peer.challenge(new_nonce())
        other.challenge(asked.client)
        other.say(control.proven(proof(token, "client", asked)))
        assert is_refused(other)


@pytest.mark.parametrize("shown", ["", "0" * 64, "\u00fc", "x" * 60_000])
def test_a_wrong_proof_costs_the_connection(robot, shown):
    own_token()
    here = robot()
    with Raw(here.port) as peer, Raw(here.port) as unasked:
        peer.challenge(new_nonce())
        for one in (peer, unasked):
            one.say(control.proven(shown))
            assert is_refused(one)


def test_a_proof_of_the_token_before_costs_the_connection(robot):
    old, here = own_token(), robot()
    with Raw(here.port) as peer:
        asked, _ = peer.challenge(new_nonce())
        new_token()
        peer.say(control.proven(proof(old, "client", asked)))
        assert is_refused(peer)


@pytest.mark.parametrize("nonce", ["", "short", "n" * 65, "with space " * 2, "\u00fc" * 20])
def test_a_hello_without_a_nonce_costs_the_connection(robot, nonce):
    own_token()
    with Raw(robot().port) as peer:
        peer.say(control.hello(nonce))
        assert peer.lines.readline() == b""


def test_a_peer_has_one_challenge_at_a_time(robot):
    own_token()
    with Raw(robot().port) as peer:
        peer.challenge(new_nonce())
        peer.say(control.hello(new_nonce()))
        assert peer.lines.readline() == b""


def test_a_robot_without_a_token_proves_nothing_and_knows_nobody(robot, caplog):
    here = robot()
    with Raw(here.port) as peer:
        asked, shown = peer.challenge(new_nonce())
        assert shown == ""
        peer.say(control.proven(proof("", "client", asked)))
        assert is_refused(peer)
    with Connection(port=here.port, timeout=WITHIN, token="x" * 43) as other:
        other.send(VALUE.decode().strip())
        assert not here.is_known()
    assert "does not know the token" in caplog.text


def test_a_wrong_token_is_told_and_the_connection_stays_a_strangers(robot, caplog):
    own_token()
    here = robot()
    with Connection(port=here.port, timeout=WITHIN, token="x" * 43) as other:
        other.send(VALUE.decode().strip())
        assert not here.is_known()
    (told,) = [line for line in caplog.messages if "proof" in line]
    assert "does not know the token" in told
    assert "both sides need the same hri token" in told


# --- a network's client ---


def test_what_a_network_sends_meanwhile_waits_for_the_proof(robot, links):
    """Before it, a value would be refused."""
    own_token()
    answered = threading.Event()

    def answer(hello):
        assert answered.wait(WITHIN)
        return b"<hri><challenge></challenge></hri>\n"

    stranger = Stranger(answer)
    _, connect = links
    there = connect(stranger.port, proves_token=True)
    assert there.wait_for_peers(1, WITHIN)
    there.send(VALUE)
    there.send(VALUE.replace(b"1", b"2"))
    assert there._held is not None
    answered.set()
    wait_until(lambda: there._held is None)
    there.send(VALUE.replace(b"1", b"3"))
    there.close()
    numbers = re.findall(rb"<x>(.)</x>", stranger.all_heard())
    assert numbers == [b"1", b"2", b"3"]


def test_the_first_value_of_a_network_is_taken(robot, links):
    own_token()
    here = robot()
    _, connect = links
    there = connect(here.port, proves_token=True)
    assert there.wait_for_peers(1, WITHIN)
    there.send(VALUE)
    assert here.is_known()


def test_a_server_that_does_not_answer_is_waited_for_once(links, monkeypatch):
    own_token()
    stranger = Stranger(LINES["silent"])
    monkeypatch.setattr(client, "TO_CHALLENGE", 0.0)
    _, connect = links
    there = connect(stranger.port, proves_token=True)
    wait_until(lambda: there._is_silent and there._held is None)
    there.close()
    stranger.all_heard()


def test_an_older_robot_gets_no_token_and_the_log_says_so_once(links, caplog):
    own_token()
    line = control.refusal("t.x moves the robot and takes no value without the token")
    stranger = Stranger(lambda hello: line + line)
    _, connect = links
    there = connect(stranger.port, proves_token=True)
    wait_until(lambda: len(caplog.records) == 3)
    there.close()
    stranger.all_heard()
    (told,) = [text for text in caplog.messages if "asks for no proof of the token" in text]
    assert "update it, or start it with --trusted" in told


@pytest.mark.usefixtures("impatient")
def test_a_script_says_so_too(caplog):
    own_token()
    stranger = Stranger(LINES["silent"])
    with Connection(port=stranger.port, timeout=WITHIN):
        pass
    stranger.all_heard()
    (told,) = caplog.messages
    assert "asks for no proof of the token, so it gets none - update the hri there" in told
