"""A session of Zenoh for robots of one machine, or of several.

On one machine programs find each other by files in the state folder, and nothing leaves the
loopback network: Zenoh neither sends multicasts nor listens anywhere else. Other machines come in
with `allows_remote`; a file of Zenoh's own configuration may add TLS, access rules, and routers.
"""

from __future__ import annotations

import json
import os
import re
import socket
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.paths import state_folder
from hri.core.privacy import folder_for
from hri.core.reading import read_text
from hri.core.writing import PRIVATE, write_text

if TYPE_CHECKING:
    import zenoh

LOOPBACK = "127.0.0.1"
ROBOTS = "hri/robots"
"""Key under which the liveliness token of each robot is."""
_NAME = re.compile(r"[a-z][a-z0-9_-]{0,31}")
LONGEST_FILE = 1 << 20
"""Bytes of a configuration of Zenoh."""
QUEUE = 16
"""Batches that wait to be sent, before values are dropped: the most that Zenoh takes. With its 2,
one value of 1,000 was lost among 100 robots on a machine that was busy."""
TO_CONNECT = 1.0
"""Seconds for those who are known to be there."""
PATIENCE = 2.0
"""Seconds for an answer of all robots."""


@dataclass(frozen=True)
class FleetSettings:
    """How a program joins a fleet."""

    name: str = ""
    """Of the robot; empty for a program that only looks."""
    allows_remote: bool = False
    connect: tuple[str, ...] = ()
    """Where routers or robots of other machines listen: "tcp/192.168.1.5:7447"."""
    file: Path | None = None
    """Zenoh's own configuration, JSON5."""

    @property
    def listens_itself(self) -> bool:
        """Whether the place to listen is chosen here, and not by a file that may reach others."""
        return self.file is None or not self.allows_remote

    def __post_init__(self) -> None:
        """Raises HriError for a name that cannot be one, or what needs `allows_remote`."""
        if self.name and not is_name(self.name):
            what = f'"{self.name}" cannot name a robot of a fleet'
            raise HriError(f"{what} - take small letters, digits, - and _")
        if self.connect and not self.allows_remote:
            raise HriError("--connect reaches other machines - add --allow-remote")


def is_name(text: str) -> bool:
    """Whether this may be the name of a robot."""
    return _NAME.fullmatch(text) is not None


def check(settings: FleetSettings) -> None:
    """Raises HriError for a file that is not a configuration of Zenoh."""
    _configuration(settings, port=0, met=())


@contextmanager
def opened(settings: FleetSettings) -> Iterator[zenoh.Session]:
    """A session, until the block ends. Raises HriError where it cannot be had."""
    import zenoh

    zenoh.init_log_from_env_or("off")  # RUST_LOG turns it on
    port = free_port() if settings.listens_itself else 0
    # Announced before a look at the others: of two that come in at once, one sees the other.
    with _announced(port) if port else nullcontext():
        met = [one for one in _met() if one != port]
        configuration = _configuration(settings, port, met)
        try:
            session = zenoh.open(configuration)
        except zenoh.ZError as error:
            what = f"the fleet cannot be joined: {error}"
            raise HriError(f"{what} - check its configuration") from error
        try:
            _wait_for_peers(session, len(met))
            yield session
        finally:
            session.close()  # type: ignore[no-untyped-call]


def _configuration(settings: FleetSettings, port: int, met: Sequence[int]) -> zenoh.Config:
    import zenoh

    try:
        if settings.file is not None:
            text = read_text(settings.file, "configuration of Zenoh", LONGEST_FILE)
            config = zenoh.Config.from_json5(text)
        else:
            config = zenoh.Config()
            config.insert_json5("mode", '"peer"')
            config.insert_json5("transport/link/tx/queue/size/data", str(QUEUE))
        host = "0.0.0.0" if settings.allows_remote else LOOPBACK
        known = [] if settings.listens_itself else json.loads(config.get_json("connect/endpoints"))
        if not isinstance(known, list):
            raise HriError(f"{settings.file}: connect/endpoints is not a list - write one")
        here = [f"tcp/{LOOPBACK}:{one}" for one in met]
        own = {
            "connect/endpoints": [*known, *here, *settings.connect],
            "connect/exit_on_failure": False,
            "connect/timeout_ms": 1000,
        }
        if settings.listens_itself:
            own |= {
                "listen/endpoints": [f"tcp/{host}:{port}"],
                "scouting/multicast/enabled": settings.allows_remote,
                "adminspace/enabled": False,
            }
        for key, value in own.items():
            config.insert_json5(key, json.dumps(value))
    except zenoh.ZError as error:
        what = f"{settings.file}: {error}" if settings.file else str(error)
        raise HriError(f"{what} - see zenoh.io, DEFAULT_CONFIG.json5") from error
    return config


def _wait_for_peers(session: zenoh.Session, count: int) -> None:
    """Let those who are known to be there come in; for a while, since one may be gone."""
    clock, moment = RealClock(), threading.Event()
    while len(session.info.peers_zid()) < count and clock.now() < TO_CONNECT:
        moment.wait(0.005)


def free_port() -> int:
    """A port of the loopback network that no program listens on."""
    with socket.create_server((LOOPBACK, 0)) as found:
        port: int = found.getsockname()[1]
        return port


def _folder() -> Path:
    return state_folder() / "fleet"


@contextmanager
def _announced(port: int) -> Iterator[None]:
    """Let other programs of this user find a port, until the block ends."""
    path = _folder() / f"{os.getpid()}-{port}"
    folder_for(path)
    write_text(path, f"{port}\n", PRIVATE)
    try:
        yield
    finally:
        with suppress(OSError):
            path.unlink()


def _met() -> list[int]:
    """Where programs of this user listen; files of programs that have ended are taken away."""
    found = []
    folder = _folder()
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        pid, _, port = path.name.partition("-")
        if not (pid.isdigit() and port.isdigit()):
            continue
        if _lives(int(pid)):
            found.append(int(port))
        else:
            with suppress(OSError):
                path.unlink()
    return found


def _lives(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except PermissionError:
        return True
    except (OSError, OverflowError):
        return False
    return True
