"""`hri mcp token`: prints the bearer with which an assistant comes over HTTP."""

from __future__ import annotations

import argparse
import sys

from hri.core.errors import HriError
from hri.core.quoting import report
from hri.net.mcp.bearer import BEARER, revoke

OPTIONS = ("new", "revoke")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    group = parser.add_mutually_exclusive_group()
    about = "with `token`: make another bearer; the one before is worth nothing"
    group.add_argument("--new", action="store_true", help=about)
    about = "with `token`: delete the bearer; nobody may come over HTTP until there is another"
    group.add_argument("--revoke", action="store_true", help=about)


def refuse(options: argparse.Namespace) -> None:
    """Raise HriError for what is meant for `hri mcp token`."""
    for name in OPTIONS:
        if getattr(options, name):
            raise HriError(f"--{name} is about the bearer - write hri mcp token --{name}")


def run(options: argparse.Namespace) -> int:
    """Print the bearer; make one if there is none."""
    if options.revoke:
        told = "revoked - hri mcp token makes another one" if revoke() else "there was no bearer"
        report(told, file=sys.stderr)
        return 0
    print(BEARER.new() if options.new else BEARER.load() or BEARER.new())
    return 0
