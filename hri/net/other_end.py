"""The two ends of a connection, and whose program is at the other one."""

from __future__ import annotations

import ipaddress
import socket
from contextlib import suppress

import psutil


def ends_of_client(connection: socket.socket) -> str:
    """Both ends, the client's first, of a connection that was made here."""
    return f"{_written(connection.getsockname())} {_written(connection.getpeername())}"


def ends_of_server(connection: socket.socket) -> str:
    """Both ends, the client's first, of a connection that was accepted here."""
    return f"{_written(connection.getpeername())} {_written(connection.getsockname())}"


def is_program_of_this_user(connection: socket.socket) -> bool:
    """Whether a program of this user, on this machine, has the other end and has accepted it.

    False where the system does not say, as on macOS. Asking takes tens of milliseconds.
    """
    with suppress(psutil.Error, OSError):
        here, there = connection.getsockname()[:2], connection.getpeername()[:2]
        for one in psutil.net_connections("tcp"):
            if one.pid and one.laddr == there and one.raddr == here:
                return bool(psutil.Process(one.pid).username() == psutil.Process().username())
    return False


def _written(address: tuple[object, ...]) -> str:
    """An address of a socket, the same on both sides of a connection."""
    found = ipaddress.ip_address(str(address[0]).partition("%")[0])
    return f"{getattr(found, 'ipv4_mapped', None) or found} {address[1]}"
