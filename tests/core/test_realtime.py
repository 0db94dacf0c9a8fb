"""A program that runs ahead of others: its own threads come along, its child processes do not."""

import json
import os
import subprocess
import sys

import pytest

PROGRAM = """
import json, os, subprocess, sys, threading
from hri.core.clock import RealClock
from hri.core.realtime import PRIORITY, become_realtime

def place():
    thread = threading.get_native_id()
    policy = os.sched_getscheduler(thread) & ~os.SCHED_RESET_ON_FORK
    return policy == os.SCHED_FIFO and os.sched_getparam(thread).sched_priority - PRIORITY

def asked(worker):
    worker.submit(place)
    while not (answers := worker.poll()):
        nothing.wait(0.001)  # spinning would starve the worker where there is one processor
    return answers[0]

nothing = threading.Event()
clock = RealClock()
before, after = clock.worker(0.0), clock.worker(0.0)
asked(before)
refusal = become_realtime()
code = "import os; print(os.sched_getscheduler(0) == os.SCHED_OTHER)"
child = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout
print(json.dumps([refusal, place(), asked(before), asked(after), child.strip()]))
"""


@pytest.mark.skipif(not hasattr(os, "sched_setscheduler"), reason="a system without SCHED_FIFO")
def test_the_threads_of_a_program_follow_its_loop_and_its_children_run_as_usual():
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True, timeout=60
    )
    refusal, loop, earlier, later, child = json.loads(done.stdout)
    if refusal:
        pytest.skip(refusal)
    assert (loop, earlier, later) == (0, -1, -1)
    assert child == "True"
