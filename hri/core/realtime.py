"""Asks the system to run this program before others, so that ticks begin on time."""

from __future__ import annotations

import gc
import os

PRIORITY = 50
"""Of 1 to 99, among programs with SCHED_FIFO."""


def become_realtime() -> str:
    """Run the calling thread ahead of all that is not real time.

    What is loaded so far is left out of garbage collection, whose pauses grow with it. Processes
    and threads that are started by this one run as usual. Returns a sentence when the system does
    not allow the priority, else an empty text.
    """
    gc.collect()
    gc.freeze()
    if not hasattr(os, "sched_setscheduler"):
        return "no real-time priority on this system - it runs as usual"
    policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK
    try:
        os.sched_setscheduler(0, policy, os.sched_param(PRIORITY))
    except OSError as error:
        remedy = "run it as root, or allow it: ulimit -r 50 (rtprio in limits.conf)"
        return f"no real-time priority: {error.strerror} - {remedy}"
    return ""
