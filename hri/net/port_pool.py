"""Ports that the behaviors of this process share: the first opens one, the last closes it.

Behaviors on one port distinguish their messages by `tag_name`.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

from hri.net.client import Client
from hri.net.server import Server
from hri.net.tcp_port import TcpPort


@dataclass
class _Shared:
    """What is open, and how many use it."""

    lock: threading.Lock = field(default_factory=threading.Lock)
    links: dict[tuple[type[TcpPort], str, int], TcpPort] = field(default_factory=dict)
    users: dict[TcpPort, int] = field(default_factory=dict)


_shared = _Shared()


def borrow(kind: type[Client] | type[Server], host: str, port: int, **options: bool) -> TcpPort:
    """The link of this process to a port; give it back. Raises HriError when it cannot be had.

    `options` are for the one who opens it.

    A server on port 0 gets a free port, which is shared with nobody.
    """
    with _shared.lock:
        key = (kind, host, port)
        link = _shared.links.get(key)
        if link is None:
            link = kind(host, port, **options)  # type: ignore[arg-type]
            _shared.links[(kind, host, link.port)] = link
        _shared.users[link] = _shared.users.get(link, 0) + 1
        return link


def give_back(link: TcpPort) -> None:
    """End one use of a link; with the last it is closed."""
    with _shared.lock:
        _shared.users[link] -= 1
        if _shared.users[link]:
            return
        del _shared.users[link]
        del _shared.links[(type(link), link.host, link.port)]
        link.close()
