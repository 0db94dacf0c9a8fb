"""The whole companion in real time: memory, start, CPU, and frames, as a user would see them.

The companion runs as a separate process, with its default devices or their stand-ins; its
memory and CPU are those of all its processes, read from the system every quarter of a second.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
import time
from typing import Any

import psutil

from hri.bench.figures import machine, summary
from hri.core import child
from hri.core.errors import HriError

SECONDS = 30.0
SETTLED = 5.0
"""Seconds after the first frame from which CPU counts: the models have been loaded by then."""


def measure(seconds: float = SECONDS) -> dict[str, Any]:
    """Run the companion's demo for some seconds of real time."""
    begun = time.perf_counter()
    command = child.command("-m", "hri.cli.main", "companion", "--headless", "--demo")
    with tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen(
            [*command, "--duration", str(seconds)],
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            env=child.environment(),
        )
        first_frame = _wait_for_first_frame(process, begun)
        samples, output = _watch(process)
        errors.seek(0)
        if process.returncode:
            raise HriError(f"the companion failed: {errors.read().strip()[-500:]} - run it by hand")
    settled = [sample for sample in samples if sample[0] > SETTLED] or samples
    return {
        "bench": "companion",
        "machine": machine(),
        "seconds": seconds,
        "first_frame_s": round(first_frame, 3),
        "memory_mb": summary([memory for _, memory, _ in samples], 1),
        "memory_peak_mb": round(max(memory for _, memory, _ in samples), 1),
        "cpu_cores": summary([cpu for _, _, cpu in settled]),
        "frames_per_second": _frames_per_second(output),
    }


def _wait_for_first_frame(process: subprocess.Popen[str], begun: float) -> float:
    """Seconds from the start of the process to the line it prints when its face is up."""
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith("ready"):
            return time.perf_counter() - begun
    raise HriError("the companion ended before its first frame - run `hri companion`")


def _watch(process: subprocess.Popen[str]) -> tuple[list[tuple[float, float, float]], str]:
    """(seconds, MB, cores) until the process ends, over it and its children; and its output."""
    root = psutil.Process(process.pid)
    begun = time.perf_counter()
    before, spent = begun, _cpu_time(root)
    samples: list[tuple[float, float, float]] = []
    while True:
        try:
            output, _ = process.communicate(timeout=0.25)
            return samples, output
        except subprocess.TimeoutExpired:
            now, used = time.perf_counter(), _cpu_time(root)
            samples.append((now - begun, _memory(root), (used - spent) / (now - before)))
            before, spent = now, used


def _family(root: psutil.Process) -> list[psutil.Process]:
    try:
        return [root, *root.children(recursive=True)]
    except psutil.NoSuchProcess:
        return []


def _cpu_time(root: psutil.Process) -> float:
    total = 0.0
    for process in _family(root):
        try:
            times = process.cpu_times()
            total += times.user + times.system
        except psutil.Error:
            continue
    return total


def _memory(root: psutil.Process) -> float:
    total = 0.0
    for process in _family(root):
        try:
            total += process.memory_info().rss / 1e6
        except psutil.Error:
            continue
    return total


def _frames_per_second(output: str) -> float | None:
    found = re.search(r"([\d.]+) frames a second", output)
    return float(found.group(1)) if found else None
