"""`hri grammar`: write grammars, check what was written, try it in words and in sound.

Each subcommand is a module with `add_arguments(parser)` and `run(options) -> exit status`.
"""

from __future__ import annotations

import argparse
import importlib

COMMANDS = {
    "check": "say what is wrong and what is heard badly",
    "parse": "say what a sentence means",
    "expand": "list, draw or count the sentences that are understood",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    for name, about in COMMANDS.items():
        module = importlib.import_module(f"hri.cli.grammar.{name}")
        command = commands.add_parser(name, help=about, description=about)
        command.set_defaults(run_grammar=module.run)
        module.add_arguments(command)


def run(options: argparse.Namespace) -> int:
    status: int = options.run_grammar(options)
    return status
