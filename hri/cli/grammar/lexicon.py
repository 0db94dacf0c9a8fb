"""`hri grammar lexicon`: lists the pronunciations of a grammar's words."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.cli.grammar import FILE_HELP
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.speech.grammar import load_grammar
from hri.speech.language import complaint, foreign
from hri.speech.pronunciation.lexicon import load_lexicon, user_lexicon

EXAMPLES = """\
examples:
  hri grammar lexicon companion                      all words, with who knows them
  hri grammar lexicon my.jsgf --missing > words.txt  only the guessed ones, to be corrected
  hri grammar lexicon my.jsgf --add words.txt        the same, with a lexicon on trial
The output is a lexicon. Append the lines you corrected to your own, which the robot uses for
hearing and speaking: ~/.config/hri/lexicon.txt, or the file that HRI_LEXICON names."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument("--missing", action="store_true", help="only words that are guessed")
    parser.add_argument(
        "--add", type=Path, nargs="+", default=[], metavar="LEXICON", help="additional lexicons"
    )


def run(options: argparse.Namespace) -> int:
    grammar = load_grammar(options.file)
    if language := foreign(grammar):
        print(f"{grammar.path}: {' - '.join(complaint(grammar, language))}", file=sys.stderr)
    lexicon = load_lexicon(*options.add)
    words = sorted(word for word in grammar.words() if not options.missing or word not in lexicon)
    width = max(map(len, words), default=0)
    unsayable = 0
    for word in words:
        try:
            for phones in lexicon.pronunciations(word):
                note = "" if options.missing else f"   # {lexicon.origin(word)}"
                report(f"{word:<{width}}  {' '.join(phones)}{note}")
        except HriError as error:
            unsayable += 1
            report(f"# {error}")
    if options.missing and not words:
        report(f"{grammar.path}: no word is guessed", file=sys.stderr)
    elif options.missing:
        report(f"correct these, then append them to {user_lexicon()}", file=sys.stderr)
    return 1 if unsayable else 0
