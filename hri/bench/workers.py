"""Processes beside a bench: some share its work, some are measured, some keep the machine busy."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack, contextmanager
from multiprocessing import get_context

from hri.core import child


@contextmanager
def variables(**values: str) -> Iterator[None]:
    """While the body runs, the environment has these values."""
    before = dict(os.environ)
    os.environ.update(values)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


@contextmanager
def safe_start() -> Iterator[None]:
    """While the body runs, `multiprocessing` starts its children as `hri.core.child` does."""
    folders, sys.path[:] = sys.path[:], child.folders()
    try:
        with variables(**child.environment()):
            yield
    finally:
        sys.path[:] = folders


@contextmanager
def worker_pool(count: int) -> Iterator[ProcessPoolExecutor]:
    """A number of processes to which work can be submitted; they end with the body."""
    with safe_start(), ProcessPoolExecutor(count, mp_context=get_context("spawn")) as pool:
        yield pool


_END_WITH_PARENT = """\
import os, sys, threading
threading.Thread(target=lambda: (sys.stdin.read(), os._exit(0)), daemon=True).start()
"""
"""The parent's end of this pipe closes however the parent ends."""


@contextmanager
def running(code: str, stdout: int | None = None) -> Iterator[subprocess.Popen[str]]:
    """A process that runs this Python code; it ends with the block, and with this process."""
    command, environment = child.command("-c", _END_WITH_PARENT + code), child.environment()
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=stdout, text=True, env=environment
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@contextmanager
def busy_processes(count: int) -> Iterator[list[subprocess.Popen[str]]]:
    """Processes that do only keep processors busy while the block runs."""
    with ExitStack() as stack:
        yield [stack.enter_context(running("while True: pass")) for _ in range(count)]
