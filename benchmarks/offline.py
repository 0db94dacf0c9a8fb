"""What everyday commands send, look up, and write where they should not: nothing.

Each runs for a while in a sandbox with only the loopback network and an empty home folder; one that
ends sooner is run again until then. Some telemetry is sent only after a minute, or by a later run.
"""

from __future__ import annotations

import os
import shlex
import tempfile
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from benchmarks.progress import progress
from benchmarks.sandbox import STOPPED, Tried, require_sandbox, run
from hri.bench.figures import machine
from hri.core import paths
from hri.core.clock import RealClock

SECONDS = 65.0
"""For each command."""
ANSWERED = (0, 1)
"""Exit statuses; 1 says that something is missing or wrong in what was looked at."""
RECORDED = "{house}/tests/recorded"
COMMANDS = (
    "hri companion",
    "hri companion --headless --keep",
    "hri companion --demo --headless --record out",
    "hri companion --demo --fast --seed 7 --headless --record out",
    f"hri companion --audio {RECORDED}/speech/goforward.flac --camera none --headless",
    "hri companion --config create2 --headless",
    "hri companion --headless --fleet anna",
    "hri mcp --config simulated --http 0",
    "hri companion --config typed --headless",
    "hri studio --config simulated --port 0",
    "hri studio {house}/config/networks/follow.xml --port 0",
    "hri doctor --seconds 2",
    "hri devices",
    "hri voices",
    'hri say "Hello there. It is a quarter past nine, and 3 km to go." --wav said.wav',
    'hri say "Good evening." --voice en-gb --emotion joy --wav said.wav',
    'hri say "Hello." --face-video hello.mp4 --visemes hello.json',
    "hri face render --expression happy --out happy.png",
    "hri face animate {house}/docs/samples/face/hello.toml --out hello.mp4",
    f"hri face lips {RECORDED}/speech/goforward.flac --text 'go forward' --out lips.mp4",
    "hri grammar check companion",
    'hri grammar parse companion "go forward ten meters"',
    f"hri grammar listen companion --wav {RECORDED}/speech/goforward.flac",
    "hri emotion check",
    "hri network draw companion --out companion.svg",
    "behave networks/wander --duration 65",
    "hri watch --simulated --seconds 65 --out seen.mp4",
    "hri gesture --simulated --seconds 65",
    f"hri object learn cup --images {RECORDED}/pictures/coffee.jpg",
    f"hri color learn ball --images {RECORDED}/pictures/coffee.jpg --box 50,50,60,60",
    "hri drive replay 7 --out room.png",
    "hri models",
    "hri memory export people.json",
    "hri forget --yes",
    "test_camera",
    "python {house}/docs/samples/short/say_and_ask.py",
)


def measure(seconds: float = SECONDS) -> dict[str, Any]:
    """Run all commands, one on each processor. Raises NotAvailable where there is no sandbox."""
    require_sandbox()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tried = pool.map(lambda command: tries(command, seconds), COMMANDS)
        rows = list(progress(tried, len(COMMANDS), "commands"))
    counts = {what: sum(len(row[what]) for row in rows) for what in ("sent", "written", "left")}
    failed = [row["command"] for row in rows if row["failed"]]
    return {
        "commands": len(rows), "seconds": seconds, **counts, "failed": failed, "rows": rows,
        "machine": machine(),
    }  # fmt: skip


def tries(command: str, seconds: float) -> dict[str, Any]:
    """A command, run until the time is over, and all that it tried."""
    with tempfile.TemporaryDirectory() as folder:
        runs = list(_runs(command, Path(folder).resolve(), seconds))
    return {
        "command": command,
        "runs": len(runs),
        "sent": _all(run.sent for run in runs),
        "written": _all(run.written for run in runs),
        "left": _all(run.left for run in runs),
        "failed": [run.output[-500:] for run in runs if has_failed(run)][:1],
    }


def _runs(command: str, folder: Path, seconds: float) -> Iterator[Tried]:
    clock = RealClock()
    end = clock.now() + seconds
    while (rest := end - clock.now()) > 0:
        yield run(words(command), folder, rest)


def words(command: str) -> list[str]:
    """The words of a command of the list."""
    return shlex.split(command.format(house=paths.house()))


def has_failed(tried: Tried) -> bool:
    """Whether a command ended without doing what it should."""
    if tried.status == STOPPED:
        return False
    return tried.status not in ANSWERED or "Traceback" in tried.output


def _all(found: Iterable[Iterable[str]]) -> list[str]:
    return sorted(set().union(*found))
