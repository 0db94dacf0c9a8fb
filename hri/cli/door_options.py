"""The options of every command that serves: who may connect over the network."""

from __future__ import annotations

import argparse

from hri.behavior.doors import Doors


def add_door_options(parser: argparse.ArgumentParser) -> None:
    """Add `--allow-remote` and `--trusted`."""
    add = parser.add_argument
    add("--allow-remote", action="store_true", help="let other machines connect (bind, HRI_BIND)")
    add(
        "--trusted",
        action="append",
        default=[],
        metavar="TAG[.PORT]",
        help="let anyone write to a port of the bridge without the token; may be repeated",
    )


def doors_of(options: argparse.Namespace) -> Doors:
    """The access that the options allow."""
    return Doors(allows_remote=options.allow_remote, trusted=tuple(options.trusted))
