"""`hri skill new`: creates a small skill that works."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.new import TEMPLATES, Kind, Template, create
from hri.core.errors import HriError
from hri.core.privacy import private_folder
from hri.core.quoting import report
from hri.robot.skills import own_folder

PLAIN = Template(TEMPLATES / "skill", "skill", Kind("a skill that draws cards", ()))
FORM = Template(TEMPLATES / "form_skill", "skill", Kind("a skill that asks how to make tea", ()))
BEGINNING = {PLAIN: "draw two cards", FORM: "make me some tea"}
"""What may be said first to each."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="letters, digits and _: dice, tell_fortune")
    parser.add_argument(
        "--form", action="store_true", help="one that asks for what it needs, and keeps a timer"
    )
    parser.add_argument(
        "--to", type=Path, metavar="DIR", help="where to put its folder (your own skills)"
    )


def run(options: argparse.Namespace) -> int:
    to = options.to or own_folder()
    if options.to is None:
        private_folder(to)
    elif not to.is_dir():
        raise HriError(f"{to}: no such folder - make it, or check the path")
    template = FORM if options.form else PLAIN
    folder = create(template, options.name, to)
    name = folder.name if options.to is None else str(folder)
    report(f"{folder}: {template.kind.about} so far; change what you like. Next:")
    print()
    report(f"  hri skill test {name}     # plays the dialogue of its README.md")
    report(f"  hri skill check {name}    # mistakes, and sentences that sound like others")
    if options.to is None:
        report(f"  hri companion --config typed    # say: {BEGINNING[template]}")
    else:
        report(f"  cp -r {folder} {own_folder()}/    # plugs it in")
    return 0
