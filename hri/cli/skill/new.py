"""`hri skill new`: creates a small skill that works."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.new import TEMPLATES, Kind, Template, create
from hri.core.errors import HriError
from hri.core.privacy import private_folder
from hri.core.quoting import report
from hri.robot.skills import own_folder

TEMPLATE = Template(TEMPLATES / "skill", "skill", Kind("a skill that draws cards", ()))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="letters, digits and _: dice, tell_fortune")
    parser.add_argument(
        "--to", type=Path, metavar="DIR", help="where to put its folder (your own skills)"
    )


def run(options: argparse.Namespace) -> int:
    to = options.to or own_folder()
    if options.to is None:
        private_folder(to)
    elif not to.is_dir():
        raise HriError(f"{to}: no such folder - make it, or check the path")
    folder = create(TEMPLATE, options.name, to)
    name = folder.name if options.to is None else str(folder)
    report(f"{folder}: a skill that draws cards. Next:")
    print()
    report(f"  hri skill test {name}     # plays the dialogue of its README.md")
    report(f"  hri skill check {name}    # mistakes, and sentences that sound like others")
    if options.to is None:
        print("  hri companion --config typed    # say: draw two cards")
    else:
        report(f"  cp -r {folder} {own_folder()}/    # plugs it in")
    return 0
