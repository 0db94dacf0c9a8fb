"""Which addresses are this machine's own, that no other machine can reach."""

from __future__ import annotations

import ipaddress
import socket


def is_loopback(host: str) -> bool:
    """Whether a host, by name or address, is this machine and only this machine.

    False for a name that stands for nothing.
    """
    try:
        found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM) if host else []
    except (OSError, ValueError):  # a name that cannot be one is a ValueError
        return False
    return bool(found) and all(_is_own(str(entry[4][0])) for entry in found)


def is_from_loopback(connection: socket.socket) -> bool:
    """Whether the other end of a connection is on this machine."""
    if connection.family not in (socket.AF_INET, socket.AF_INET6):
        return True  # the families that do not leave the machine
    return _is_own(str(connection.getpeername()[0]))


def _is_own(address: str) -> bool:
    parsed = ipaddress.ip_address(address.partition("%")[0])
    mapped = getattr(parsed, "ipv4_mapped", None)
    return (mapped or parsed).is_loopback
