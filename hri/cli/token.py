"""`hri token`: prints the token with which programs move the robot over a network."""

from __future__ import annotations

import argparse
import os
import sys

from hri.core.quoting import report
from hri.core.token import VARIABLE, new_token, own_token


def add_arguments(parser: argparse.ArgumentParser) -> None:
    about = "make a new one; programs that proved the old one must prove the new one"
    parser.add_argument("--new", action="store_true", help=about)
    about = "print it as a header for curl, which reads it: hri token --curl | curl --config - URL"
    parser.add_argument("--curl", action="store_true", help=about)


def run(options: argparse.Namespace) -> int:
    """Print the token; make one if there is none."""
    token = new_token() if options.new else own_token()
    print(f'header = "Authorization: Bearer {token}"' if options.curl else token)
    if options.new and os.environ.get(VARIABLE):
        report(f"{VARIABLE} is set and takes precedence - unset {VARIABLE}", file=sys.stderr)
    return 0
