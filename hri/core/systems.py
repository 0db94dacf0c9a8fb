"""Which parts need a system with POSIX: on Windows, WSL is one."""

from __future__ import annotations

import sys

from hri.core.errors import NotAvailable

REMEDY = "run it in WSL (`wsl --install`)"


def is_windows() -> bool:
    """Whether this is Windows itself, and not Linux in WSL."""
    return sys.platform == "win32"


def require_posix(what: str) -> None:
    """Raise NotAvailable on Windows."""
    if is_windows():
        raise NotAvailable(
            f"{what} does not run on Windows - {REMEDY}; faces and grammars work here"
        )
