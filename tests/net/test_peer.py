import math
import select
import socket
from contextlib import closing, contextmanager

import pytest
from hypothesis import given, settings, strategies as st

from hri.net.peer import Peer, PeerError, PeerLimits
from tests.net.conftest import WITHIN


@contextmanager
def peer_and_end(**limits):
    with socket.create_server(("127.0.0.1", 0)) as listening:
        here = socket.create_connection(listening.getsockname())
        end = listening.accept()[0]
    with end, closing(Peer(here, "p", PeerLimits(**limits), 0.0)) as peer:
        yield peer, end


def take(peer, now):
    """Receive as soon as something is there."""
    assert select.select([peer.connection], [], [], WITHIN)[0]
    return peer.receive(now)


@settings(deadline=None)  # sockets take the time they take
@given(st.lists(st.binary(max_size=20).filter(lambda line: b"\n" not in line)), st.data())
def test_lines_come_whole_however_they_are_cut(lines, data):
    with peer_and_end() as (peer, end):
        stream = b"".join(line + b"\n" for line in lines)
        received = []
        while stream:
            cut = data.draw(st.integers(1, len(stream)))
            end.sendall(stream[:cut])
            received += take(peer, 0.0)
            stream = stream[cut:]
    assert received == lines


def test_who_sends_too_fast_is_not_read_until_the_debt_is_paid():
    with peer_and_end(rate=10) as (peer, end):
        end.sendall(b"\n" * 10)
        take(peer, 0.0)
        assert peer.held_until == -math.inf
        end.sendall(b"\n" * 5)
        take(peer, 0.0)
        assert peer.held_until == pytest.approx(0.5)
        end.sendall(b"\n")
        take(peer, 1.0)
        assert peer.held_until == pytest.approx(0.5), "no new hold after a second's credit"


def test_a_line_is_unfinished_from_its_first_byte_to_its_end():
    with peer_and_end() as (peer, end):
        for sent, now, since in [(b"a", 1, 1), (b"b", 2, 1), (b"\nc", 3, 3), (b"\n", 4, math.inf)]:
            end.sendall(sent)
            take(peer, now)
            assert peer.unfinished_since == since


def test_what_a_peer_does_not_read_waits_in_order_and_is_bounded():
    with peer_and_end(backlog=10_000_000) as (peer, end):
        sent = b""
        while not peer.send(frame := len(sent).to_bytes(8, "big") * 1000):
            sent += frame
        sent += frame
        assert peer.backlog > 0
        received = b""
        while len(received) < len(sent):
            received += end.recv(1_000_000)
            peer.flush()
        assert received == sent
        assert peer.backlog == 0
        while not peer.fault:
            peer.send(b"x" * 1_000_000)
        assert "it has to read faster" in peer.fault
        assert not peer.send(b"x")


def test_who_hangs_up_is_gone():
    with peer_and_end() as (peer, end):
        end.close()
        with pytest.raises(PeerError):
            take(peer, 0.0)
