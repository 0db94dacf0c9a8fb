"""The options of the studio, and what is said about its address."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from contextlib import suppress

from hri.cli.run.browser import open_page
from hri.cli.terminal.messages import Within
from hri.core.errors import HriError
from hri.robot import Robot
from hri.studio.port import PortTaken
from hri.studio.session import PORT, StudioSession


def add_studio_options(parser: argparse.ArgumentParser) -> None:
    """Add `--port` and `--open`."""
    about = "where the studio's page is (%(default)s); 0 takes any free port"
    parser.add_argument("--port", type=Within(int, 0, 65535), default=PORT, metavar="P", help=about)
    parser.add_argument("--open", action="store_true", help="open the studio's page in a browser")


def studio_of(robot: Robot, options: argparse.Namespace) -> StudioSession:
    """The studio of a robot. Raises HriError where the port is taken; when that is by another
    studio, `--open` opens its page.
    """
    try:
        return StudioSession(robot, options.port, options.allow_remote)
    except PortTaken as taken:
        if options.open and taken.page:
            with suppress(HriError):  # the address is in the message
                open_page(taken.page)
        raise


def show_address(
    studio: StudioSession, options: argparse.Namespace, tell: Callable[[str], object]
) -> None:
    """Print where the page is, and open it when asked to."""
    tell(f"studio    {studio.address()}")
    if not options.open:
        return
    try:
        open_page(studio.address())
        tell("          a browser opens it; if none does, open this address in one")
    except HriError as error:
        tell(f"          not opened: {error}, or open this address in a browser")
