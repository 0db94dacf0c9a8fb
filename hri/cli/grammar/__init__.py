"""`hri grammar`: write grammars, check what was written, try it in words and in sound.

Each subcommand is a module with `EXAMPLES`, `add_arguments(parser)` and
`run(options) -> exit status`.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import sys

from hri.cli.messages import OptionParser
from hri.core.errors import AuthoringError, AuthoringErrors, HriError

COMMANDS = {
    "check": "say what is wrong and what is heard badly",
    "parse": "say what a sentence means",
    "expand": "list, draw or count the sentences that are understood",
    "test": "try a file of sentences, or recordings, that should be understood",
    "watch": "check a grammar, and test it, each time it is saved",
    "listen": "hear with a grammar: a microphone, recordings or typed lines",
    "confuse": "find sentences of different meaning that sound alike",
    "pronounce": "tell and fix how words are said",
    "lexicon": "list how the words of a grammar are said",
    "calibrate": "choose the strictness from recordings or synthetic speech",
}

OBJECTS_BETWEEN_COLLECTIONS = 20_000
"""A grammar is many objects that all stay. With Python's 700, a third of the time of reading a
large one goes by in looking for garbage among them."""
FILE_HELP = "grammar file, or the name of one in grammars/"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    width = max(map(len, COMMANDS))
    about = "\n".join(f"  {name:<{width}}  {about}" for name, about in COMMANDS.items())
    parser.epilog = f"commands:\n{about}\n\nhri grammar COMMAND --help lists the options."
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("command", metavar="COMMAND", choices=COMMANDS, help="one of those below")
    parser.add_argument("words", nargs=argparse.REMAINDER, help=argparse.SUPPRESS)


def run(options: argparse.Namespace) -> int:
    """Only the module of the command that is wanted is loaded: some take their time."""
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
    """The error; each mistake in a file with the line it is in."""
    from hri.cli.grammar.excerpt import Excerpts

    if not isinstance(error, AuthoringError):
        return str(error)
    errors = error.errors if isinstance(error, AuthoringErrors) else [error]
    excerpts = Excerpts()
    return "\n".join(f"{one}\n{excerpts.of(one.place)}".rstrip() for one in errors)
