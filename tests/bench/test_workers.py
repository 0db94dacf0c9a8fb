"""Processes beside a bench."""

import subprocess
import sys

BENCH = """\
from hri.bench.workers import busy_processes
with busy_processes(2):
    print("busy", flush=True)
    input()
"""


def test_busy_processes_end_with_a_bench_that_is_killed():
    command = [sys.executable, "-c", BENCH]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True) as bench:
        assert bench.stdout.readline() == "busy\n"
        bench.kill()
        # They have its output, too, which ends when the last of them has.
        assert bench.communicate(timeout=60) == ("", None)
