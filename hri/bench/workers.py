"""Processes that share the work of a bench."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from hri.core import child


@contextmanager
def safe_start() -> Iterator[None]:
    """While the body runs, `multiprocessing` starts its children as `hri.core.child` does."""
    folders, variables = sys.path[:], dict(os.environ)
    sys.path[:] = child.folders()
    os.environ.update(child.environment())
    try:
        yield
    finally:
        sys.path[:] = folders
        os.environ.clear()
        os.environ.update(variables)


@contextmanager
def worker_pool(count: int) -> Iterator[ProcessPoolExecutor]:
    """So many processes to which work can be submitted; they end with the body."""
    with safe_start(), ProcessPoolExecutor(count, mp_context=get_context("spawn")) as pool:
        yield pool
