"""`hri grammar`: check what an author wrote, try sentences on it, see what can be said."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.speech.check import Finding, check
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.matching import parse
from hri.speech.recognizers.pocketsphinx import dictionary

MOST_SHOWN = 3
"""Errors that are shown at once; mending the first often mends the rest."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="grammar_command", metavar="COMMAND", required=True)
    file_help = "grammar file, or the name of one in grammars/"
    checking = commands.add_parser("check", help="say what is wrong and what is heard badly")
    checking.set_defaults(grammar_run=_check)
    checking.add_argument("file", metavar="FILE", help=file_help)
    parsing = commands.add_parser("parse", help="say what a sentence means")
    parsing.set_defaults(grammar_run=_parse)
    parsing.add_argument("file", metavar="FILE", help=file_help)
    parsing.add_argument("text", help="the sentence, in quotes")
    parsing.add_argument("--json", action="store_true", help="print one JSON object")
    expanding = commands.add_parser("expand", help="list sentences that are understood")
    expanding.set_defaults(grammar_run=_expand)
    expanding.add_argument("file", metavar="FILE", help=file_help)
    expanding.add_argument("-n", type=_count, default=20, metavar="N", help="how many (20)")


def run(options: argparse.Namespace) -> int:
    try:
        status: int = options.grammar_run(options)
    except HriError as error:
        print(error, file=sys.stderr)
        return 2
    return status


def _count(text: str) -> int:
    if not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text} is no number of sentences")
    return int(text)


def _check(options: argparse.Namespace) -> int:
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


def _parse(options: argparse.Namespace) -> int:
    found = parse(load_grammar(paths.find("grammars", options.file)), options.text)
    if options.json:
        answer: dict[str, object] = {"accepted": found is not None}
        if found is not None:
            answer |= {"text": found.text, "rule": found.rule, "tags": dict(found.tags)}
        print(json.dumps(answer))
    elif found is None:
        print(f'"{options.text}" is not in the grammar - see `hri grammar expand`')
    else:
        tags = " ".join(f"{name}={value}" for name, value in found.tags.items())
        print(f"{found.rule}: {found.text}" + (f" {{{tags}}}" if tags else ""))
    return 0 if found is not None else 1


def _expand(options: argparse.Namespace) -> int:
    for sentence in load_grammar(paths.find("grammars", options.file)).sentences(options.n):
        print(sentence)
    return 0
