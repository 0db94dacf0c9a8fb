"""`hri grammar expand`: the sentences that are understood."""

from __future__ import annotations

import argparse

from hri.cli.grammar.check import FILE_HELP
from hri.core import paths
from hri.speech.grammar import load_grammar


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument("-n", type=_count, default=20, metavar="N", help="how many (20)")


def run(options: argparse.Namespace) -> int:
    for sentence in load_grammar(paths.find("grammars", options.file)).sentences(options.n):
        print(sentence)
    return 0


def _count(text: str) -> int:
    if not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text} is no number of sentences")
    return int(text)
