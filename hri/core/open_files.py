"""How files are opened and locked by the system, on Windows, too, which knows less of it."""

from __future__ import annotations

import errno
import os

BINARY = getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
"""For every file: child processes do not get it, and its bytes are as they are."""
AT_ONCE = getattr(os, "O_NONBLOCK", 0)
"""A pipe that nobody writes to is not waited for."""
NO_LINK = getattr(os, "O_NOFOLLOW", 0)
"""A link is refused."""
MAY_RENAME_OPEN = os.name == "posix"
"""Whether a file may get another name, or be deleted, while it is open."""


def lock(handle: int, *, is_shared: bool = False) -> None:
    """Lock an open file, and do not wait for it.

    Raises BlockingIOError when another program has it, OSError where files have no locks.
    """
    try:
        import fcntl
    except ImportError as error:  # Windows
        raise OSError(errno.ENOTSUP, "no locks on this system") from error
    fcntl.flock(handle, (fcntl.LOCK_SH if is_shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
