"""`hri grammar`: check grammars, and try them with text and sound.

Each subcommand is a module with `EXAMPLES`, `add_arguments(parser)` and
`run(options) -> exit status`.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import sys

from hri.cli.terminal.messages import OptionParser
from hri.core.errors import AuthoringError, AuthoringErrors, HriError

COMMANDS = {
    "check": "report mistakes, and commands that are hard to recognize",
    "parse": "print the meaning of a sentence",
    "expand": "list, sample or count the sentences of a grammar",
    "test": "test a grammar with sentences or recordings",
    "watch": "check and test a grammar each time it is saved",
    "listen": "recognize speech: from a microphone, recordings or typed lines",
    "confuse": "find sentences that sound alike but differ in meaning",
    "pronounce": "show and correct pronunciations",
    "lexicon": "list the pronunciations of a grammar's words",
    "calibrate": "choose the strictness from recordings or synthetic speech",
}

OBJECTS_BETWEEN_COLLECTIONS = 20_000
"""A grammar is many lasting objects. With Python's default of 700, garbage collection takes a third
of the time of reading a large one.
"""
FILE_HELP = "grammar file, or the name of one in grammars/"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    width = max(map(len, COMMANDS))
    about = "\n".join(f"  {name:<{width}}  {about}" for name, about in COMMANDS.items())
    parser.epilog = f"commands:\n{about}\n\nhri grammar COMMAND --help lists the options."
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("command", metavar="COMMAND", choices=COMMANDS, help="a command below")
    parser.add_argument("words", nargs=argparse.REMAINDER, help=argparse.SUPPRESS)


def run(options: argparse.Namespace) -> int:
    """Load only the module of the wanted command: some are slow to import."""
    module = importlib.import_module(f"hri.cli.grammar.{options.command}")
    parser = OptionParser(
        prog=f"hri grammar {options.command}",
        description=COMMANDS[options.command],
        epilog=getattr(module, "EXAMPLES", None),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    module.add_arguments(parser)
    given = parser.parse_args(options.words)
    gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS)
    try:
        status: int = module.run(given)
    except AuthoringError as error:
        print(explained(error), file=sys.stderr)
        return 2
    return status


def explained(error: HriError) -> str:
    """The error; each mistake in a file with its line."""
    from hri.cli.grammar.excerpt import Excerpts

    if not isinstance(error, AuthoringError):
        return str(error)
    errors = error.errors if isinstance(error, AuthoringErrors) else [error]
    excerpts = Excerpts()
    return "\n".join(f"{one}\n{excerpts.of(one.place)}".rstrip() for one in errors)
