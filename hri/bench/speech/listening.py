"""Runs `hri grammar listen --wav`, as a user would, and reads what it says."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from hri.bench.speech.samples import Clip, write_wav
from hri.core import child
from hri.core.errors import HriError

ONE_CORE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""Environment of a process whose arithmetic keeps to one thread."""


@dataclass(frozen=True, slots=True)
class Heard:
    """What was made of one piece of speech."""

    is_accepted: bool
    text: str
    rule: str
    tags: Mapping[str, Any]
    confidence: float
    reason: str
    latency_s: float
    start_s: float = 0.0
    end_s: float = 0.0
    """From the beginning of the recording."""

    def told(self) -> str:
        """For people: the words and what became of them."""
        verdict = "accepted" if self.is_accepted else self.reason
        return f'"{self.text}" {verdict} {self.confidence:.2f}'


@dataclass(frozen=True, slots=True)
class Hearing:
    """What was made of a list of clips."""

    heard: list[list[Heard]]
    """For each clip, its pieces of speech."""
    cpu_s: float
    """Processor time, with what the program takes to start; of no use when several run at once."""


class Listen(Protocol):
    """Hears clips with a grammar."""

    def __call__(self, grammar: Path, clips: Sequence[Clip], engine: str = "") -> Hearing: ...


def listen(grammar: Path, clips: Sequence[Clip], engine: str = "") -> Hearing:
    """Recognize clips in a separate process, on one core; the default engine when none is named.

    Raises HriError when the program fails.
    """
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.wav" for number in range(len(clips))]
        for path, clip in zip(paths, clips, strict=True):
            write_wav(path, clip)
        command = child.command("-m", "hri.cli.main", "grammar", "listen", grammar)
        command += ["--json", *(["--engine", engine] if engine else [])]
        lines, cpu_s = _run([*command, "--wav", *map(str, paths)])
    by_file: dict[str, list[Heard]] = {str(path): [] for path in paths}
    for line in lines:
        said = json.loads(line)
        by_file[said["file"]].append(_heard(said))
    return Hearing([by_file[str(path)] for path in paths], cpu_s)


def _run(command: Sequence[str]) -> tuple[list[str], float]:
    """Lines of a program's output, and its processor time; 0 where the system does not tell."""
    before = _of_children()
    environment = child.environment(**ONE_CORE)
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    # Status 1: something was not accepted.
    if done.returncode not in (0, 1):
        words = " ".join(command[:7])
        raise HriError(f"{words} failed: {done.stderr[-500:].strip()} - run it by hand")
    return done.stdout.splitlines(), _of_children() - before


def _of_children() -> float:
    """Processor seconds of all programs that were started and have ended."""
    times = os.times()
    return times.children_user + times.children_system


def _heard(said: Mapping[str, Any]) -> Heard:
    return Heard(
        is_accepted=said["accepted"],
        text=said["text"],
        rule=said["rule"],
        tags=said["tags"] or {},
        confidence=said["confidence"] or 0.0,
        reason=said["reason"] or "",
        latency_s=said["latency_s"] or 0.0,
        start_s=said["start_s"],
        end_s=said["end_s"],
    )
