"""Keeps libraries written in C from writing what would hide our one clear line."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_STDERR = threading.Lock()
"""Held while the standard error is away; several threads may want it away at once."""


@contextmanager
def silenced_libraries() -> Iterator[None]:
    """Send the standard error of the whole process nowhere; for moments only."""
    with _STDERR:
        kept = os.dup(2)
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 2)
        try:
            yield
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            os.close(nowhere)
