"""`hri bench NAME`: figures as JSON, and JSON only."""

from __future__ import annotations

import argparse
import importlib
import json

from hri.core.errors import HriError

BENCHES = ("behavior", "companion", "net")
"""Each is a module of `hri.bench` with `measure() -> dict`."""
TIMED = ("behavior", "companion")
"""Those whose `measure` takes `seconds`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", choices=BENCHES, help="what to measure")
    about = f"how long each case runs ({', '.join(TIMED)})"
    parser.add_argument("--seconds", type=_seconds, metavar="S", help=about)


def _seconds(text: str) -> float:
    value = float(text)
    if not 1 <= value <= 3600:
        raise argparse.ArgumentTypeError(f"{text} - write seconds from 1 to 3600")
    return value


def run(options: argparse.Namespace) -> int:
    module = importlib.import_module(f"hri.bench.{options.name}")
    if options.seconds is not None and options.name not in TIMED:
        raise HriError(f"bench {options.name} takes no --seconds - leave it out")
    limits = {} if options.seconds is None else {"seconds": options.seconds}
    print(json.dumps(module.measure(**limits), indent=2))
    return 0
