"""`hri bench NAME`: prints figures as JSON only; some benches need a checkout."""

from __future__ import annotations

import argparse
import importlib
import json
from pathlib import Path
from types import ModuleType
from typing import Any

from hri.bench.checkout import missing, research
from hri.cli.terminal.messages import Within
from hri.core.errors import HriError

BENCHES: dict[str, tuple[str, ...]] = {
    "behavior": ("seconds",),
    "companion": ("seconds",),
    "drive": ("quick", "only"),
    "edits": ("tries", "seed"),
    "emotion": (),
    "face": ("quick",),
    "inputs": ("tries", "seed", "keep", "only", "jobs"),
    "net": (),
    "offline": ("seconds",),
    "people": ("quick",),
    "speech": ("quick", "recordings", "draw"),
    "studio": ("quick", "only"),
    "vision": ("quick", "only"),
    "writes": ("quick",),
}
"""Each is a module with `measure(...) -> dict`; the options that it takes."""
RESEARCH = ("edits", "inputs", "offline", "people", "studio", "writes")
"""Those of the folder `benchmarks`; the others are of `hri.bench`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = "Missed limits are listed; the exit status is 0 all the same."
    about = f"what to measure; {', '.join(RESEARCH)} need a checkout"
    parser.add_argument("name", choices=BENCHES, help=about)
    about = "how long each case runs (behavior, companion, offline)"
    parser.add_argument("--seconds", type=Within(float, 1, 3600), metavar="S", help=about)
    about = "take every sixth sentence (speech), a tenth (drive, face, people, vision, writes);"
    about += " less of everything (studio)"
    parser.add_argument("--quick", action="store_true", default=None, help=about)
    about = "run only this part, such as rooms (drive) or nods (vision), or this reader (inputs);"
    about += " a wrong name lists them all"
    parser.add_argument("--only", metavar="PART", help=about)
    about = "recordings of people, a folder with a manifest.tsv (speech)"
    parser.add_argument("--recordings", type=Path, metavar="DIR", help=about)
    about = "seed of the babble of the same people, a number (speech)"
    parser.add_argument("--draw", type=Within(int, 0, 999_999), metavar="N", help=about)
    about = "number of inputs for all readers together, 100000 by default (inputs); how often the"
    about += " browser is killed, 200 by default (edits)"
    parser.add_argument("--tries", type=Within(int, 1, 999_999_999), metavar="N", help=about)
    about = (
        "seed of the random inputs, another one each time by default (inputs); the first try, each"
    )
    about += " has its own (edits)"
    parser.add_argument("--seed", type=Within(int, 0, 999_999), metavar="N", help=about)
    about = "keep what failed in this folder; the same command continues there (inputs)"
    parser.add_argument("--keep", type=Path, metavar="DIR", help=about)
    about = "number of child processes, one per processor by default (inputs)"
    parser.add_argument("--jobs", type=Within(int, 1, 64), metavar="N", help=about)


def run(options: argparse.Namespace) -> int:
    module = _module(options.name)
    words: dict[str, Any] = {n: v for n, v in vars(options).items() if n not in ("name", "command")}
    given = {name: value for name, value in words.items() if value is not None}
    for name in given.keys() - BENCHES[options.name]:
        raise HriError(f"bench {options.name} takes no --{name} - leave it out")
    print(json.dumps(module.measure(**given), indent=2))
    return 0


def _module(name: str) -> ModuleType:
    if name not in RESEARCH:
        return importlib.import_module(f"hri.bench.{name}")
    if (module := research(name)) is None:
        raise missing(name)
    return module
