"""Asks the system to run this program before others, so that ticks begin on time."""

from __future__ import annotations

import contextlib
import gc
import os
import threading

PRIORITY = 50
"""Of 1 to 99, among programs with SCHED_FIFO."""


def become_realtime() -> str:
    """Run the calling thread ahead of all that is not real time, and others of this program next.

    The others come along because the interpreter runs one thread at a time: a loop whose turn has
    come waits for whichever thread holds the interpreter, and that one must not wait for other
    programs meanwhile. Child processes run as usual, and so do threads that are started later,
    unless they call `join_realtime`. What is loaded so far is left out of garbage collection,
    whose pauses grow with it. Returns a sentence when the system does not allow the priority,
    else an empty text.
    """
    gc.collect()
    gc.freeze()
    if not hasattr(os, "sched_setscheduler"):
        return "no real-time priority on this system - it runs as usual"
    try:
        _raise(threading.get_native_id(), PRIORITY)
    except OSError as error:
        remedy = "run it as root, or allow it: ulimit -r 50 (rtprio in limits.conf)"
        return f"no real-time priority: {error.strerror} - {remedy}"
    for thread in threading.enumerate():
        if thread is not threading.current_thread() and thread.native_id is not None:
            _follow(thread.native_id)
    return ""


def join_realtime() -> None:
    """Let the calling thread follow the main thread, if that one runs ahead of other programs."""
    if hasattr(os, "sched_getscheduler"):
        policy = os.sched_getscheduler(os.getpid()) & ~os.SCHED_RESET_ON_FORK
        if policy == os.SCHED_FIFO:
            _follow(threading.get_native_id())


def _follow(thread: int) -> None:
    with contextlib.suppress(OSError):  # It has ended meanwhile, or may not any more.
        _raise(thread, PRIORITY - 1)


def _raise(thread: int, priority: int) -> None:
    policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
    os.sched_setscheduler(thread, policy, os.sched_param(priority))
