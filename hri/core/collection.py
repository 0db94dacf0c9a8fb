"""Holds garbage collection off while much is built that stays."""

from __future__ import annotations

import contextlib
import gc
import threading
from collections.abc import Iterator

_lock = threading.Lock()
_builders = 0
_was_on = False


@contextlib.contextmanager
def without_collection() -> Iterator[None]:
    """Collect nothing meanwhile, in no thread.

    For what makes hundreds of thousands of containers without cycles: each collection looks at
    all of them again and finds nothing, which takes half of the time. Where collection was off
    already, it stays off.
    """
    global _builders, _was_on
    with _lock:
        if _builders == 0:
            _was_on = gc.isenabled()
        _builders += 1
        gc.disable()
    try:
        yield
    finally:
        with _lock:
            _builders -= 1
            if _builders == 0 and _was_on:
                gc.enable()
