"""`hri bench NAME`: figures as JSON, and JSON only; some of them need a checkout."""

from __future__ import annotations

import argparse
import importlib
import json
from pathlib import Path
from types import ModuleType
from typing import Any

from hri.bench.checkout import missing, research
from hri.core.errors import HriError

BENCHES = (
    "behavior", "companion", "drive", "emotion", "face", "inputs", "net", "people",
    "speech", "vision", "writes",
)  # fmt: skip
"""Each is a module of `hri.bench`, or of `benchmarks` in a checkout, with `measure() -> dict`."""
RESEARCH = ("inputs", "people", "writes")
"""Those of `benchmarks`."""
OPTIONS = ("seconds", "quick", "only", "recordings", "draw", "tries", "seed", "keep", "jobs")
TAKES = {
    "behavior": ("seconds",),
    "companion": ("seconds",),
    "drive": ("quick", "only"),
    "face": ("quick",),
    "inputs": ("tries", "seed", "keep", "only", "jobs"),
    "people": ("quick",),
    "speech": ("quick", "recordings", "draw"),
    "vision": ("quick", "only"),
    "writes": ("quick",),
}
"""The options that the `measure` of some of them takes."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", choices=BENCHES, help="what to measure")
    about = "how long each case runs (behavior, companion)"
    parser.add_argument("--seconds", type=_seconds, metavar="S", help=about)
    about = (
        "take every sixth sentence and recording (speech),"
        " a tenth (drive, face, people, vision, writes)"
    )
    parser.add_argument("--quick", action="store_true", default=None, help=about)
    about = "run only this part, such as rooms (drive) or nods (vision), or this reader (inputs);"
    about += " a wrong name lists them all"
    parser.add_argument("--only", metavar="PART", help=about)
    about = "recordings of people, a folder with a manifest.tsv (speech)"
    parser.add_argument("--recordings", type=Path, metavar="DIR", help=about)
    about = "another babble of the same people, a number (speech)"
    parser.add_argument("--draw", type=_draw, metavar="N", help=about)
    about = "how many inputs to try over all readers, 100000 by default (inputs)"
    parser.add_argument("--tries", type=_tries, metavar="N", help=about)
    about = "seed of the random inputs, a number (inputs)"
    parser.add_argument("--seed", type=_draw, metavar="N", help=about)
    about = "keep what failed in this folder; the same command continues there (inputs)"
    parser.add_argument("--keep", type=Path, metavar="DIR", help=about)
    about = "how many child processes run at once, one for each processor by default (inputs)"
    parser.add_argument("--jobs", type=_jobs, metavar="N", help=about)


def _tries(text: str) -> int:
    if not text.isdecimal() or not 1 <= len(text) <= 9 or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text} - write how many, such as 100000")
    return int(text)


def _jobs(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text[:4]) <= 64:
        raise argparse.ArgumentTypeError(f"{text} - write a number from 1 to 64")
    return int(text)


def _seconds(text: str) -> float:
    value = float(text)
    if not 1 <= value <= 3600:
        raise argparse.ArgumentTypeError(f"{text} - write seconds from 1 to 3600")
    return value


def _draw(text: str) -> int:
    if not text.isdecimal() or len(text) > 6:
        raise argparse.ArgumentTypeError(f"{text} - write a number from 0 to 999999")
    return int(text)


def run(options: argparse.Namespace) -> int:
    module = _module(options.name)
    given: dict[str, Any] = {
        name: value for name in OPTIONS if (value := getattr(options, name)) is not None
    }
    for name in given.keys() - TAKES.get(options.name, ()):
        raise HriError(f"bench {options.name} takes no --{name} - leave it out")
    print(json.dumps(module.measure(**given), indent=2))
    return 0


def _module(name: str) -> ModuleType:
    if name not in RESEARCH:
        return importlib.import_module(f"hri.bench.{name}")
    if (module := research(name)) is None:
        raise missing(name)
    return module
