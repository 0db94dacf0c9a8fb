"""`hri studio [APP]`: runs an app or a network, and serves a page to see, talk to, and stop it."""

from __future__ import annotations

import argparse
from contextlib import suppress
from pathlib import Path

from hri.behavior.network import Network
from hri.behavior.network_writer import save_network
from hri.cli import run as run_app
from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.robot.app import NETWORK


def add_arguments(parser: argparse.ArgumentParser) -> None:
    about = "name of an app in apps/, or a path; also of a NETWORK.xml, old or new (%(default)s)"
    parser.add_argument("app", nargs="?", default="companion", help=about)
    run_app.add_options(parser)


def run(options: argparse.Namespace) -> int:
    """The face is on the page, so that it needs no window."""
    if options.app.endswith(NETWORK):
        _begin(options.app)
    options.studio = options.headless = True
    return run_app.run(options)


def _begin(name: str) -> None:
    """Write an empty network where there is none yet: it is built on the page."""
    path = Path(name)
    with suppress(HriError):
        paths.find("config", name)
        return
    if path.parent.is_dir():
        save_network(Network(path.stem), path)
        report(f"{path}: a new network, still empty")
