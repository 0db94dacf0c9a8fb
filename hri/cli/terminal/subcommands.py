"""Commands that have commands, such as `hri color learn`: a module for each."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from types import ModuleType

Commands = Mapping[str, tuple[ModuleType, str]]
"""By name: a module with `add_arguments(parser)` and `run(options) -> exit status`; its help."""


def add_commands(parser: argparse.ArgumentParser, commands: Commands) -> None:
    """Add them; their options have the name of the chosen one as `verb`."""
    found = parser.add_subparsers(metavar="COMMAND", required=True)
    for name, (module, about) in commands.items():
        command = found.add_parser(name, help=about, description=about)
        command.set_defaults(verb=name, run_verb=module.run)
        module.add_arguments(command)


def run_command(options: argparse.Namespace) -> int:
    """Run the chosen one; its exit status."""
    status: int = options.run_verb(options)
    return status
