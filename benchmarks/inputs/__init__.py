"""Bad inputs for every reader: which end in anything but a result or a refusal in one line.

Each reader runs in a child process whose time and memory are watched. An input that makes it print
a traceback, crash, hang, take more than 5 seconds or 300 MB, or leave a part behind is a failure.
Each run draws other inputs, unless it is given the seed of an earlier one: they depend on the seed
and their number alone.
"""

from __future__ import annotations

import json
import os
import random
import selectors
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from pathlib import Path
from threading import Event, Lock
from typing import Any

from benchmarks.inputs.readers import READERS, bad_input
from hri.bench.figures import machine
from hri.core.child import command, environment
from hri.core.errors import HriError, did_you_mean
from hri.core.writing import write_bytes, write_text

MOST_SECONDS = 5.0
"""Seconds of processor time for one input."""
MOST_BYTES = 300_000_000
"""Bytes by which the memory of the process may grow for one input."""
PATIENCE = 120.0
"""Seconds without a word from a child that does not work, either; on a busy machine it waits."""
BATCH = 2000
"""Tries of one child, after which what was found is saved."""
MOST_KEPT = 20
"""Failures of one reader that are listed."""
SEEDS = 1_000_000
"""Seeds that are drawn from."""
PROGRESS = "progress.json"
_IN_MEMORY = Path("/dev/shm")
"""Where a file that is written again and again does not wait for a disk."""


@dataclass
class Tally:
    """What became of the inputs of one reader."""

    tries: int = 0
    taken: int = 0
    refused: int = 0
    slowest_s: float = 0.0
    slowest: int = 0
    """Number of the input."""
    largest_mb: float = 0.0
    largest: int = 0
    failures: list[dict[str, Any]] = field(default_factory=list)
    failed: int = 0

    def count(self, report: Mapping[str, Any]) -> str:
        """Take a report of the child; what was wrong, or nothing."""
        number, what, why = int(report["number"]), report["what"], report["why"]
        self.tries = number + 1
        seconds, megabytes = report["seconds"], report["bytes"] / 1e6
        if seconds > self.slowest_s:
            self.slowest_s, self.slowest = round(seconds, 3), number
        if megabytes > self.largest_mb:
            self.largest_mb, self.largest = round(megabytes, 1), number
        if what in ("taken", "refused"):
            self.taken += what == "taken"
            self.refused += what == "refused"
            if seconds > MOST_SECONDS:
                what, why = "slow", f"{seconds:.1f} s"
            elif report["bytes"] > MOST_BYTES:
                what, why = "large", f"{megabytes:.0f} MB"
            else:
                return ""
        self.failed += 1
        if len(self.failures) < MOST_KEPT:
            self.failures.append({"number": number, "what": what, "why": why})
        return str(what)


def measure(
    tries: int = 100_000,
    seed: int | None = None,
    keep: Path | None = None,
    only: str | None = None,
    jobs: int | None = None,
) -> dict[str, Any]:
    """Try `tries` inputs over all readers, or over one; what happened by reader.

    Without a seed, that of the folder `keep` is taken, or another one. `jobs` child processes run
    at once, by default one for each processor. In the folder `keep` are the inputs that failed, and
    how far it got: the same command goes on there. Raises HriError for an unknown reader or a
    folder of another seed.
    """
    if only is not None and only not in READERS:
        raise HriError(f'no reader "{only}" - {did_you_mean(only, READERS)}')
    names = list(READERS) if only is None else [only]
    run = _Run(seed, keep)
    with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
        shares = [tries // len(names) + (at < tries % len(names)) for at in range(len(names))]
        done = [pool.submit(run.go_on, *share) for share in zip(names, shares, strict=True)]
        try:
            for reader in done:
                reader.result()
        except BaseException:
            run.has_ended.set()
            pool.shutdown(cancel_futures=True)
            raise
    return _report({name: run.tallies[name] for name in names}, run.seed)


class _Run:
    """What became of the inputs so far; its readers are tried side by side."""

    def __init__(self, seed: int | None, keep: Path | None) -> None:
        self.keep = keep
        self.seed, self.tallies = _resumed(keep, seed)
        self.has_ended = Event()
        self._lock = Lock()

    def go_on(self, name: str, share: int) -> None:
        """Try the inputs of a reader up to its share."""
        with self._lock:
            tally = self.tallies.setdefault(name, Tally())
        while tally.tries < share and not self.has_ended.is_set():
            self._try(name, tally, min(tally.tries + BATCH, share))
            with self._lock:
                _save(self.keep, self.seed, self.tallies)
                _show(f"{name}: {tally.tries} of {share}, {tally.failed} failed")

    def _try(self, name: str, tally: Tally, last: int) -> None:
        """Go on until `last`; a child that crashes or hangs is replaced behind the input it had."""
        while tally.tries < last and not self.has_ended.is_set():
            with tempfile.TemporaryDirectory(dir=_folder()) as folder:
                for report in _child(name, self.seed, tally.tries, last, Path(folder)):
                    if tally.count(report):
                        _keep(self.keep, name, self.seed, int(report["number"]))
                    if self.has_ended.is_set():
                        return


def _report(tallies: Mapping[str, Tally], seed: int) -> dict[str, Any]:
    worst = max(tallies.items(), key=lambda item: item[1].slowest_s)
    largest = max(tallies.items(), key=lambda item: item[1].largest_mb)
    failed = sum(tally.failed for tally in tallies.values())
    return {
        "bench": "inputs",
        "machine": machine(),
        "seed": seed,
        "tries": sum(tally.tries for tally in tallies.values()),
        "failed": failed,
        "slowest": {"reader": worst[0], "seconds": worst[1].slowest_s},
        "largest": {"reader": largest[0], "megabytes": largest[1].largest_mb},
        "limits": {"seconds": MOST_SECONDS, "megabytes": MOST_BYTES / 1e6},
        "passed": failed == 0,
        "readers": {name: asdict(tally) for name, tally in tallies.items()},
    }


def _folder() -> Path | None:
    """Where the folders of the children are made."""
    return _IN_MEMORY if os.access(_IN_MEMORY, os.W_OK) else None


def _child(name: str, seed: int, first: int, last: int, folder: Path) -> Iterator[dict[str, Any]]:
    """The reports of a child process; when it ends too early, one about its end."""
    words = [name, str(seed), str(first), str(last), str(folder)]
    program = command("-m", "benchmarks.inputs.trial", *words)
    number = first
    with (
        tempfile.TemporaryFile() as told,
        subprocess.Popen(program, stdout=subprocess.PIPE, stderr=told, env=environment()) as child,
    ):
        assert child.stdout is not None
        try:
            for line in _lines(child.stdout.fileno(), child.pid):
                report = json.loads(line)
                number = report["number"] + 1
                yield report
            status = child.wait(PATIENCE)
            why = f"status {status}"
        except (TimeoutError, subprocess.TimeoutExpired):
            why = f"nothing for {PATIENCE:g} s"
        finally:
            child.kill()
        told.seek(0)
        last_words = told.read()[-300:].decode(errors="replace")
    if number < last:
        why = f"{why}: {last_words.strip()}"
        yield {"number": number, "seconds": 0.0, "bytes": 0, "what": "ended", "why": why}


def _lines(pipe: int, child: int) -> Iterator[bytes]:
    """The lines that come through a pipe from a process. Raises TimeoutError when it hangs."""
    rest, worked = b"", 0.0
    with selectors.DefaultSelector() as selector:
        selector.register(pipe, selectors.EVENT_READ)
        while True:
            while not selector.select(PATIENCE):
                before, worked = worked, _processor_time(child)
                if worked <= before:
                    raise TimeoutError
            if not (some := os.read(pipe, 1 << 16)):
                return
            *lines, rest = (rest + some).split(b"\n")
            yield from lines


def _processor_time(process: int) -> float:
    """Seconds that a process worked so far."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _keep(keep: Path | None, name: str, seed: int, number: int) -> None:
    """Write the input that failed into the folder of the user."""
    if keep is not None:
        plain, suffix = name.replace(" ", "-").replace(",", ""), Path(READERS[name].file).suffix
        write_bytes(keep / f"{plain}-{number}{suffix}", bad_input(name, seed, number))


def _resumed(keep: Path | None, seed: int | None) -> tuple[int, dict[str, Tally]]:
    """The seed, and how far an earlier run with this folder got."""
    drawn = random.SystemRandom().randrange(SEEDS) if seed is None else seed
    if keep is None:
        return drawn, {}
    keep.mkdir(parents=True, exist_ok=True)
    file = keep / PROGRESS
    if not file.is_file():
        return drawn, {}
    known = json.loads(file.read_text())
    if seed not in (None, known["seed"]):
        raise HriError(
            f"{keep} has inputs of seed {known['seed']} - give that seed, or another folder"
        )
    return known["seed"], {name: Tally(**fields) for name, fields in known["readers"].items()}


def _save(keep: Path | None, seed: int, tallies: Mapping[str, Tally]) -> None:
    if keep is not None:
        readers = {name: asdict(tally) for name, tally in tallies.items()}
        write_text(keep / PROGRESS, json.dumps({"seed": seed, "readers": readers}, indent=1))


def _show(line: str) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{line}\x1b[K")
        sys.stderr.flush()
