"""`hri grammar check`: what is wrong with a grammar, and what will be heard badly."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.core import paths
from hri.speech.grammar import read_grammar
from hri.speech.grammar.check import Finding, check
from hri.speech.recognizers.pocketsphinx import dictionary

FILE_HELP = "grammar file, or the name of one in grammars/"
MOST_SHOWN = 3
"""Errors that are shown at once; mending the first often mends the rest."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)


def run(options: argparse.Namespace) -> int:
    path = paths.find("grammars", options.file)
    grammar, mistakes = read_grammar(path)
    findings = [Finding("error", error.place, error.what, error.remedy) for error in mistakes]
    findings = findings or check(grammar, dictionary())
    errors = [finding for finding in findings if finding.severity == "error"]
    if errors:
        _show(path, errors)
        return 2
    for finding in findings:
        print(finding)
    counts = f"{len(grammar.public_rules)} commands, {len(grammar.words())} words"
    print(f"{path}: fine, {counts}" + (f", {len(findings)} warnings" if findings else ""))
    return 0


def _show(path: Path, errors: list[Finding]) -> None:
    for error in errors[:MOST_SHOWN]:
        print(error, file=sys.stderr)
    if len(errors) > MOST_SHOWN:
        print(f"{path}: {len(errors) - MOST_SHOWN} more errors - mend these", file=sys.stderr)
