"""Who has the port of the studio is shown the token only when it is a program of this user."""

import socket
import threading

import psutil
import pytest

from hri.core.token import own_token
from hri.studio import port as studio_port
from hri.studio.port import LONGEST_ANSWER, _page_of

WITHIN = 60.0
NOT_KNOWN = b"HTTP/1.1 401 Unauthorized\r\ncontent-length: 2\r\n\r\n{}"
HANGS_UP = NOT_KNOWN.replace(b"content", b"connection: close\r\ncontent")
LONG = NOT_KNOWN.replace(b": 2", b": %d" % (LONGEST_ANSWER + 1)) + b" " * LONGEST_ANSWER
OTHER = psutil.Process(1)


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


class Listener:
    """Answers each request on each connection with the same, and keeps what it is sent."""

    def __init__(self, answer):
        self._answer = answer
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self.heard = b""
        self.connections = 0
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        while True:
            try:
                peer, _ = self._listening.accept()
            except OSError:
                return
            self.connections += 1
            with peer:
                while data := peer.recv(65_536):
                    self.heard += data
                    peer.sendall(self._answer)
                    if self._answer == HANGS_UP:
                        break

    def close(self):
        self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()
        self._thread.join(WITHIN)


@pytest.fixture(params=[NOT_KNOWN, HANGS_UP, LONG, b"nonsense\r\n\r\n"], ids=str)
def listener(request):
    made = Listener(request.param)
    yield made
    made.close()


def test_a_program_of_someone_else_is_not_shown_it(listener, monkeypatch):
    monkeypatch.setattr(studio_port, "is_program_of_this_user", lambda connection: False)
    token = own_token()
    assert _page_of(OTHER, listener.port) == ""
    assert token.encode() not in listener.heard
    assert b"authorization" not in listener.heard.lower()


def test_it_is_shown_over_the_connection_whose_owner_is_known_or_not_at_all(listener, monkeypatch):
    owners = []
    monkeypatch.setattr(
        studio_port, "is_program_of_this_user", lambda connection: not owners.append(connection)
    )
    assert _page_of(OTHER, listener.port) == ""
    assert listener.connections == 1
    assert (own_token().encode() in listener.heard) == (listener._answer == NOT_KNOWN)
