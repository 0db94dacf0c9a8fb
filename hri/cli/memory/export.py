"""`hri memory export [FILE]`: all that is remembered, as JSON."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.memory.output import as_json, remembered, whole
from hri.core.quoting import report
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE, write_text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    about = "where to write it, for your eyes only; printed without one"
    parser.add_argument("file", nargs="?", type=Path, metavar="FILE", help=about)


def run(options: argparse.Namespace) -> int:
    people = remembered()
    text = as_json(whole(people))
    if options.file is None:
        print(text)
        return 0
    # Noted first: a file that nobody knows of could not be forgotten.
    note("exports", options.file)
    write_text(options.file, f"{text}\n", PRIVATE)
    count = len(people)
    who = "1 person" if count == 1 else f"{count} people"
    report(f"{options.file}: {who} - `hri forget` finds it there")
    return 0
