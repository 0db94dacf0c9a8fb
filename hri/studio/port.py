"""The port of the page: taken by this robot, or who has it, and where the page of that one is."""

from __future__ import annotations

import http.client
import json
import os
import socket
from contextlib import closing, suppress

import psutil

from hri.core.errors import HriError
from hri.core.quoting import message_line
from hri.core.token import own_token
from hri.net.other_end import is_program_of_this_user

SERVER = "hri.studio.server"
"""The module that a robot starts for its studio, and that has the port as well."""
LONGEST_NAME = 80
"""Letters of the program that has the port."""
PATIENCE = 2.0
"""Seconds in which another studio has to answer."""
LONGEST_ANSWER = 10_000
"""Bytes."""


class PortTaken(HriError):
    """Someone else listens there."""

    def __init__(self, message: str, page: str) -> None:
        super().__init__(message)
        self.page = page
        """Where its page is, with a code, if it is a studio; else empty."""


def listening(port: int, allows_remote: bool) -> socket.socket:
    """A socket that listens there, 0 for any free port. Raises HriError, or PortTaken."""
    host = "0.0.0.0" if allows_remote else "127.0.0.1"
    try:
        return socket.create_server((host, port), backlog=64)
    except (OSError, OverflowError) as error:
        what = f"cannot listen on {host}:{port}"
        other = "choose another --port (0 takes any that is free)"
        if (holder := _holder(port)) is None:
            code = getattr(error, "errno", None)
            reason = os.strerror(code) if code else str(error)
            raise HriError(f"{what}: {reason} - {other}") from error
        words = message_line(" ".join(holder.cmdline()))[:LONGEST_NAME]
        page = _page_of(holder, port)
        remedy = f"its page is {page}; end it, or {other}" if page else f"end it, or {other}"
        message = f"{what}: process {holder.pid} has it: {words} - {remedy}"
        raise PortTaken(message, page) from error


def _holder(port: int) -> psutil.Process | None:
    """Which program listens on a port, of a studio the robot; None where no one says."""
    with suppress(psutil.Error, OSError):
        for one in psutil.net_connections("tcp"):
            if one.status == psutil.CONN_LISTEN and one.laddr.port == port and one.pid:
                found = psutil.Process(one.pid)
                return (SERVER in found.cmdline() and found.parent()) or found
    return None


def _page_of(holder: psutil.Process, port: int) -> str:
    """The page of a studio that this user runs, with another code; empty for any other program."""
    # This process itself would wait for its own answer.
    if holder.pid == os.getpid():
        return ""
    with (
        suppress(OSError, ValueError, LookupError, HriError, http.client.HTTPException),
        closing(http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)) as asked,
    ):
        # The first answer shows that this connection was accepted, so that it is known by whom: who
        # had the port before does not matter. The token must not get to another user.
        _answer(asked, "GET", "/api/v1/state")
        if asked.sock is None or not is_program_of_this_user(asked.sock):
            return ""
        shown = {"Authorization": f"Bearer {own_token()}"}
        asked.auto_open = 0  # never shown on another connection
        page = str(json.loads(_answer(asked, "POST", "/api/v1/codes", shown))["result"])
        return page if page.startswith(f"http://127.0.0.1:{port}/?code=") else ""
    return ""


def _answer(
    asked: http.client.HTTPConnection, method: str, path: str, headers: dict[str, str] | None = None
) -> bytes:
    """What the other end says. Raises HTTPException for more than LONGEST_ANSWER."""
    asked.request(method, path, headers=headers or {})
    answer = asked.getresponse().read(LONGEST_ANSWER + 1)
    if len(answer) > LONGEST_ANSWER:
        raise http.client.HTTPException("a long answer")
    return answer
