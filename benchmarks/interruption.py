"""Runs a function in a separate process and kills it at any of its system calls.

The kernel stops a traced process at the beginning and at the end of each system call; its parent
counts the stops and kills it at one of them.
"""

from __future__ import annotations

import ctypes
import os
import signal
from collections.abc import Callable
from typing import NoReturn

from hri.core.errors import HriError

_TRACE_ME, _STEP, _SET_OPTIONS = 0, 24, 0x4200
"""Requests of ptrace(2): PTRACE_TRACEME, PTRACE_SYSCALL, PTRACE_SETOPTIONS."""
_OPTIONS = 0x1 | 0x100000
"""PTRACE_O_TRACESYSGOOD and PTRACE_O_EXITKILL: calls are distinguished from signals, and the
process does not outlive us."""
_CALL = signal.SIGTRAP | 0x80
"""What a traced process stops with at a system call."""

_libc = ctypes.CDLL(None, use_errno=True)


def run_interrupted(function: Callable[[], object], at: int | None = None) -> int:
    """Run a function in a separate process, killed at its stop number `at`; the stops it made.

    A system call makes two stops, the first is number 1; without `at` it runs to its end. Raises
    HriError when processes cannot be traced here.
    """
    child = os.fork()
    if not child:
        _be_traced(function)
    os.waitpid(child, 0)
    if _trace(_SET_OPTIONS, child, _OPTIONS) < 0:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        raise HriError("processes cannot be traced here - run it outside of the container")
    stops, passed_on = 0, 0
    while True:
        if stops == at:
            os.kill(child, signal.SIGKILL)
        _trace(_STEP, child, passed_on)
        _, status = os.waitpid(child, 0)
        if not os.WIFSTOPPED(status):
            return stops
        is_call = os.WSTOPSIG(status) == _CALL
        stops += is_call
        passed_on = 0 if is_call else os.WSTOPSIG(status)


def _be_traced(function: Callable[[], object]) -> NoReturn:
    """The life of the process; it ends without what Python does at an end."""
    status = 1
    try:
        _trace(_TRACE_ME, 0, 0)
        os.kill(os.getpid(), signal.SIGSTOP)
        function()
        status = 0
    finally:
        os._exit(status)


def _trace(request: int, process: int, data: int) -> int:
    return int(_libc.ptrace(request, process, None, ctypes.c_void_p(data)))
