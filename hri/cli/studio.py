"""`hri studio [APP]`: runs an app or a network, and serves a page to see, talk to, and stop it."""

from __future__ import annotations

import argparse

from hri.cli import run as run_app


def add_arguments(parser: argparse.ArgumentParser) -> None:
    about = "name of an app in apps/, or a path; also of a NETWORK.xml (%(default)s)"
    parser.add_argument("app", nargs="?", default="companion", help=about)
    run_app.add_options(parser)


def run(options: argparse.Namespace) -> int:
    """The face is on the page, so that it needs no window."""
    options.studio = options.headless = True
    return run_app.run(options)
