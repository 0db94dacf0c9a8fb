"""The options of who joins a fleet, or looks at one."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hri.net.zenoh.session import FleetSettings


def add_fleet_options(parser: argparse.ArgumentParser) -> None:
    """Add where the fleet is, but for `--allow-remote`."""
    add = parser.add_argument
    about = "a router or robot of another machine, such as tcp/192.168.1.5:7447; may be repeated"
    add("--connect", action="append", default=[], metavar="ADDRESS", help=about)
    about = "Zenoh's own configuration, JSON5: TLS, access rules, routers"
    add("--fleet-config", type=Path, metavar="FILE", help=about)


def add_looking_options(parser: argparse.ArgumentParser) -> None:
    """Add all options of a program that looks at a fleet."""
    about = "look for robots of other machines, too"
    parser.add_argument("--allow-remote", action="store_true", help=about)
    add_fleet_options(parser)


def settings_of(options: argparse.Namespace, name: str = "") -> FleetSettings:
    """How to join, as the options say.

    Raises HriError for options that do not fit, and where the packages of the extra are missing.
    """
    from hri.net.zenoh.session import FleetSettings

    return FleetSettings(name, options.allow_remote, tuple(options.connect), options.fleet_config)
