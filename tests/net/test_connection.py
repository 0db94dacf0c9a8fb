import socket
import struct
import threading

import pytest

from hri.core.errors import HriError
from hri.net.connection import Connection, Disconnected
from tests.net.conftest import WITHIN


@pytest.fixture
def pair():
    """A connection and the socket at its other end."""
    with socket.create_server(("127.0.0.1", 0)) as listening:
        connection = Connection("127.0.0.1", listening.getsockname()[1], WITHIN)
        other = listening.accept()[0]
        other.settimeout(WITHIN)
        with other, connection:
            yield connection, other


@pytest.mark.proves("W11")
def test_lines_are_sent_and_read(pair):
    connection, other = pair
    connection.send("hello")
    assert other.recv(100) == b"hello\n"
    other.sendall(b"one\r\ntw")
    assert connection.read() == "one"
    other.sendall(b"o\nthree\n")
    other.shutdown(socket.SHUT_WR)
    assert list(connection) == ["two", "three"]
    with pytest.raises(EOFError):
        connection.read()


@pytest.mark.proves("W11")
def test_a_callback_takes_the_lines_while_others_are_sent(pair):
    connection, other = pair
    lines, enough = [], threading.Event()

    def take(line):
        lines.append(line)
        if len(lines) == 2:
            enough.set()

    connection.on_read(take)
    connection.send("to you")
    other.sendall(b"a\nb\n")
    assert enough.wait(WITHIN)
    assert lines == ["a", "b"]
    with pytest.raises(RuntimeError, match="called before"):
        connection.on_read(take)
    connection.close()
    connection.close()
    assert other.recv(100) == b"to you\n"
    assert other.recv(100) == b""


def test_nothing_in_time_is_told(pair):
    connection, _ = pair
    with pytest.raises(TimeoutError):
        connection.read(0.01)


def test_a_line_without_an_end_is_told(pair):
    connection, other = pair
    sender = threading.Thread(target=other.sendall, args=(b"x" * 70_000,))
    sender.start()
    with pytest.raises(HriError, match="a line of more than 65536 bytes"):
        connection.read()
    sender.join(WITHIN)


def test_nobody_there_is_told():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        port = listening.getsockname()[1]
    with pytest.raises(HriError, match="start the server, or check host and port"):
        Connection("127.0.0.1", port)


def test_what_is_sent_or_read_after_the_end_is_one_error_in_one_line(pair):
    connection, _ = pair
    connection.close()
    for use in (lambda: connection.send("late"), connection.read, lambda: next(iter(connection))):
        with pytest.raises(Disconnected, match=r"127\.0\.0\.1:\d+: it was closed - connect again"):
            use()
    assert issubclass(Disconnected, HriError)
    assert issubclass(Disconnected, OSError), "as it was documented before"


def test_a_peer_that_is_gone_is_the_same_error(pair):
    connection, other = pair
    other.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    other.close()
    with pytest.raises(Disconnected, match=r"reset by peer - connect again"):
        connection.read()
