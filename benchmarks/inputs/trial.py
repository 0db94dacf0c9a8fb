"""The child process of `hri bench inputs`: gives bad inputs to one reader and reports of each.

    python -m benchmarks.inputs.trial READER SEED FIRST LAST FOLDER

It prints a line of JSON for each input: its number, the seconds of processor time it took, how many
bytes the memory grew by at most, and what became of it: "taken", "refused" in one line, or what
went wrong. The input that is read at the moment is in FOLDER, for the parent to look at when this
process crashes or hangs.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys
import time
import unicodedata
import warnings
from pathlib import Path

from benchmarks.inputs.readers import READERS, Reader, bad_input, seeds
from hri.core.errors import AuthoringErrors, HriError

HEADROOM = 1_500_000_000
"""Bytes of address space beyond what the process has at its start; more ends in a MemoryError."""
LONGEST = 20.0
"""Seconds of processor time after which an input ends the process."""
_PLAIN = ("Cc", "Cf", "Cs", "Zl", "Zp")


def main(words: list[str]) -> None:
    """Run the tries FIRST to LAST of a reader."""
    name, seed, first, last, folder = words
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends this process
    reader = READERS[name]
    place = Path(folder)
    os.environ["HRI_PATH"] = folder
    for variable in ("XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"):
        os.environ[variable] = str(place / "home")
    path = place / reader.file
    path.parent.mkdir(parents=True, exist_ok=True)
    for good in seeds(name):  # loads what is loaded once, and shows that the seeds are good
        path.write_bytes(good)
        reader.read(path)
    os.chdir(place)
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (_pages(0) + HEADROOM, hard))
    for number in range(int(first), int(last)):
        path.write_bytes(bad_input(name, int(seed), number))
        print(json.dumps(_tried(reader, path, number)), flush=True)


def _tried(reader: Reader, path: Path, number: int) -> dict[str, object]:
    held = _pages(1)
    Path("/proc/self/clear_refs").write_text("5")  # the peak begins again
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    began = time.process_time()
    what, why = _outcome(reader, path)
    seconds = time.process_time() - began
    grown = max(0, _peak() - held)
    return {"number": number, "seconds": seconds, "bytes": grown, "what": what, "why": why}


def _outcome(reader: Reader, path: Path) -> tuple[str, str]:
    """What became of an input, and why; a warning is for programmers, nobody else should see it."""
    with warnings.catch_warnings(record=True) as warned:
        what, why = _ending(reader, path)
    if warned and what in ("taken", "refused"):
        return "warning", ascii(str(warned[0].message))[:200]
    return what, why


def _ending(reader: Reader, path: Path) -> tuple[str, str]:
    try:
        reader.read(path)
    except AuthoringErrors as refusal:
        return _judged("\n".join(map(str, refusal.errors)), len(refusal.errors))
    except HriError as refusal:
        return _judged(str(refusal), 1)
    except BaseException as error:
        where = error.__traceback__
        while where is not None and where.tb_next is not None:
            where = where.tb_next
        line = f"{where.tb_frame.f_code.co_filename}:{where.tb_lineno}" if where else ""
        return "traceback", f"{type(error).__name__}: {str(error)[:200]} ({line})"
    return "taken", ""


def _judged(text: str, lines: int) -> tuple[str, str]:
    """A refusal is good when each of its mistakes is one plain line."""
    if text.count("\n") + 1 > lines or any(
        unicodedata.category(c) in _PLAIN for c in text if c != "\n"
    ):
        return "not a line", ascii(text[:300])
    return "refused", ""


def _pages(column: int) -> int:
    """Bytes of address space (0) or of memory (1) that the process has."""
    return int(Path("/proc/self/statm").read_text().split()[column]) * resource.getpagesize()


def _peak() -> int:
    """The most bytes of memory since the peak began again."""
    status = Path("/proc/self/status").read_text()
    return int(status.partition("VmHWM:")[2].split()[0]) * 1024


if __name__ == "__main__":
    main(sys.argv[1:])
