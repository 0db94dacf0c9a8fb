"""The entry of the supervisor's process; see `process`."""

import sys

from hri.drive.supervisor.process import main

if len(sys.argv) != 2:
    raise SystemExit("a program that opens a base starts this - see docs/safety.md")
main(sys.argv[1])
