import threading
from pathlib import Path

import pytest

from hri.core.token import VARIABLE
from hri.net import client, connection
from hri.net.client import Client
from hri.net.malleable import BIND
from hri.net.malleable_protocol import Item, Message, encode
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


@pytest.fixture(autouse=True)
def patience(monkeypatch: pytest.MonkeyPatch) -> None:
    """A robot on a busy machine answers in time."""
    for module in (client, connection):
        monkeypatch.setattr(module, "TO_CHALLENGE", WITHIN)


def introduction(token: str) -> bytes:
    """The line with the token itself, as a program may send it that cannot prove it."""
    return encode(Message("hri", (Item("token", token, None),)))


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

    def client(port, proves_token=False, **limits):
        opened.append(Client("127.0.0.1", port, PeerLimits(**limits), proves_token=proves_token))
        return opened[-1]

    yield server, client
    for link in opened:
        link.close()
        assert not link._thread.is_alive()
