"""What the default engine takes before it can hear: time and memory."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from hri.bench.speech.listening import ONE_CORE
from hri.bench.speech.samples import ROBOT, Clip, write_wav
from hri.bench.table import Row, amount, at_most, skipped
from hri.core import child
from hri.core.errors import HriError

STARTS = 5
PROGRAM = Path(__file__).with_name("start_process.py")


def rows(clips: Sequence[Clip]) -> Iterator[Row]:
    """Start of the default engine, and its memory after it has heard the clips."""
    with tempfile.TemporaryDirectory() as folder:
        wavs = [Path(folder) / f"{number}.wav" for number in range(len(clips))]
        for wav, clip in zip(wavs, clips, strict=True):
            write_wav(wav, clip)
        starts = [_start(wavs) for _ in range(STARTS)]
    ready = float(np.median([start["ready_s"] for start in starts]))
    yield amount("start of the engine to ready", ready, "s", at_most(0.4), starts=STARTS)
    what = "memory of the engine"
    at_start, at_work = (
        max(start[name] for start in starts) / 1e6 for name in ("ready_bytes", "hearing_bytes")
    )
    if at_work:
        yield amount(what, at_work, "MB", at_most(80.0), when_ready=round(at_start, 1))
    else:
        yield skipped(what, "this system does not tell the memory of a process")


def _start(wavs: Sequence[Path]) -> dict[str, float]:
    command = child.command(PROGRAM, ROBOT, *wavs)
    environment = child.environment(**ONE_CORE)
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode:
        words = " ".join(command[:4])
        raise HriError(f"{words} failed: {done.stderr[-500:].strip()} - run it by hand")
    figures: dict[str, float] = json.loads(done.stdout)
    return figures
