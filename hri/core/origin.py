"""Who causes what happens: the robot itself, or someone outside of it.

In a recording, requests from the studio, the keyboard or another program must not look like the
robot's own doing. While a request from outside is carried out, each event that is raised has its
origin; what is only begun meanwhile, such as a sentence, keeps the origin until it is told.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

STUDIO = "studio"
"""Someone at the page of the studio, or a script that uses its interface."""
KEYBOARD = "keyboard"
"""Someone who types, or presses keys of the window."""
BRIDGE = "bridge"
"""Another program, over TCP."""
FLEET = "fleet"
"""Another robot, or a program that asks robots of a fleet."""
MCP = "mcp"
"""An assistant, by the Model Context Protocol."""
OUTSIDE = "outside"
"""A value that a network passes on from outside of it: of another program, or of a joystick."""

_origin: ContextVar[str] = ContextVar("origin", default="")


def origin() -> str:
    """Who causes what happens now; empty for the robot itself."""
    return _origin.get()


@contextmanager
def caused_by(who: str) -> Iterator[None]:
    """All that happens in the block is caused by them; empty for the robot itself."""
    token = _origin.set(who)
    try:
        yield
    finally:
        _origin.reset(token)
