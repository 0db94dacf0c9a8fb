"""`hri companion`: alias for `hri run companion`."""

from __future__ import annotations

import argparse

from hri.cli import run as run_app


def add_arguments(parser: argparse.ArgumentParser) -> None:
    run_app.add_options(parser)


def run(options: argparse.Namespace) -> int:
    options.app = "companion"
    return run_app.run(options)
