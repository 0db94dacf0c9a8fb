import threading
from pathlib import Path

import pytest

from hri.core.token import VARIABLE
from hri.net.client import Client
from hri.net.malleable import BIND
from hri.net.peer import PeerLimits
from hri.net.server import Server

WITHIN = 60.0
"""Seconds after which a test that waits for a socket has failed."""


@pytest.fixture(autouse=True)
def own_token(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No test shows the token that another one, or the user, has made, or binds as they say."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    for name in (VARIABLE, BIND):
        monkeypatch.delenv(name, raising=False)


class Taken:
    """A listener that keeps what comes and lets a test wait for it."""

    def __init__(self):
        self.messages = []
        self.changed = threading.Condition()

    def __call__(self, message):
        with self.changed:
            self.messages.append(message)
            self.changed.notify_all()

    def wait_for(self, count):
        with self.changed:
            assert self.changed.wait_for(lambda: len(self.messages) >= count, WITHIN)
        return self.messages


@pytest.fixture
def links():
    """Opens servers on a free port of loopback, and clients; closes them all."""
    opened = []

    def server(**limits):
        opened.append(Server("127.0.0.1", 0, PeerLimits(**limits)))
        return opened[-1]

    def client(port, **limits):
        opened.append(Client("127.0.0.1", port, PeerLimits(**limits)))
        return opened[-1]

    yield server, client
    for link in opened:
        link.close()
        assert not link._thread.is_alive()
