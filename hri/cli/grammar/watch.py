"""`hri grammar watch`: checks a grammar and tries its sentences each time a file is saved."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from pathlib import Path
from types import ModuleType

from hri.cli.grammar import FILE_HELP, check, explained, test
from hri.core import paths
from hri.core.clock import Clock, RealClock
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.speech.grammar import read_grammar

EXAMPLES = """\
examples:
  hri grammar watch my.jsgf              check it now and after each save; Ctrl-C ends it
  hri grammar watch my.jsgf other.txt    also test these sentences, as `hri grammar test` does

my.txt beside my.jsgf is tested automatically."""

LOOK_EVERY = 0.5
"""Seconds between checks of the files."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument("sentences", nargs="*", type=Path, metavar="SENTENCES", help="files to try")


def run(options: argparse.Namespace) -> int:
    """Run until Ctrl-C; errors in the files are shown, and it waits for a fix."""
    return watch(paths.find("grammars", options.file), options.sentences, RealClock())


def watch(grammar: Path, sentences: list[Path], clock: Clock) -> int:
    """Check the files now and after each save, until Ctrl-C."""
    seen = None
    try:
        while True:
            if (now := _saved(grammar, sentences)) != seen:
                seen = now
                report(f"--- {clock.wall():%H:%M:%S}", flush=True)
                _look(grammar, sentences)
            clock.advance(LOOK_EVERY)
    except KeyboardInterrupt:
        return 0


def _look(grammar: Path, sentences: list[Path]) -> None:
    beside = grammar.with_suffix(".txt")
    to_try = sentences or ([beside] if paths.is_file(beside) else [])
    if _run(check, str(grammar)) < 2 and to_try:
        _run(test, *map(str, to_try), "--grammar", str(grammar.resolve()))


def _run(command: ModuleType, *words: str) -> int:
    """Run a command of `hri grammar`, with the same error messages."""
    parser = argparse.ArgumentParser()
    command.add_arguments(parser)
    try:
        return int(command.run(parser.parse_args(words)))
    except HriError as error:
        print(explained(error), file=sys.stderr)
        return 2


def _saved(grammar: Path, sentences: list[Path]) -> dict[Path, float]:
    """When each file was saved: the grammar, what it imports, and the sentences."""
    files = {grammar, grammar.with_suffix(".txt"), *sentences}
    with suppress(HriError):  # the check shows it
        files |= {rule.path for rule in read_grammar(grammar)[0].rules.values()}
    return {file: file.stat().st_mtime for file in files if paths.is_file(file)}
