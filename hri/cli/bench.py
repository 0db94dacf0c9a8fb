"""`hri bench NAME`: figures as JSON, and JSON only."""

from __future__ import annotations

import argparse
import importlib
import json

BENCHES = ("behavior", "companion", "net")
"""Each is a module of `hri.bench` with `measure() -> dict`."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", choices=BENCHES, help="what to measure")


def run(options: argparse.Namespace) -> int:
    module = importlib.import_module(f"hri.bench.{options.name}")
    print(json.dumps(module.measure(), indent=2))
    return 0
