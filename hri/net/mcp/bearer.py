"""The bearer: who shows it may use MCP over HTTP, and nothing else.

It is not the robot's token, which opens nothing here. `hri mcp token` makes it once, `--new`
replaces it, `--revoke` deletes it: then nobody may come until there is a new one.
"""

from __future__ import annotations

from contextlib import suppress

from hri.core.errors import HriError
from hri.core.token import TokenFile
from hri.core.writing import delete

REMEDY = "hri mcp token --new makes another one"
BEARER = TokenFile("mcp_token", REMEDY)


def revoke() -> bool:
    """Delete the bearer; whether there was one. Raises HriError."""
    was_there = BEARER.path.exists() or BEARER.path.is_symlink()
    delete(BEARER.path)
    return was_there


def is_shown(header: str) -> bool:
    """Whether an Authorization header shows the bearer that counts now."""
    kind, _, token = header.partition(" ")
    with suppress(HriError):  # one that cannot be used is nobody's
        return kind.lower() == "bearer" and BEARER.is_shown(token.strip())
    return False
