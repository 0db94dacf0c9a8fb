"""`hri grammar check`: reports mistakes in a grammar, and commands that are hard to recognize."""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from pathlib import Path
from typing import TextIO

from hri.cli.grammar import FILE_HELP
from hri.cli.grammar.excerpt import Excerpts
from hri.cli.terminal.progress_line import waiting
from hri.core import paths
from hri.core.errors import AuthoringError, HriError, NotAvailable, Place
from hri.core.quoting import report
from hri.speech.grammar import Grammar, read_grammar
from hri.speech.grammar.lint.finding import SEVERITIES, Finding, warning
from hri.speech.grammar.lint.linter import check
from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon
from hri.speech.recognizers.ctc.phone_graph import compile

EXAMPLES = """\
examples:
  hri grammar check companion            errors, warnings and hints, each with its place
  hri grammar check my.jsgf --all        also commands of one word, which may be intended
  hri grammar check my.jsgf --strict     warnings count as errors: for a build
  hri grammar check my.jsgf --json       for other programs

Status 0: fine. 1: with --strict, there are warnings. 2: there are errors.
A rule whose comment has @answer may be short: it is active only while a question is open."""

MOST_SHOWN = 3
"""Most errors shown; fixing the first often fixes the rest."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument("--strict", action="store_true", help="fail for warnings too")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument(
        "--all", action="store_true", help=f"more than {MOST_SHOWN} errors, and notes"
    )


def run(options: argparse.Namespace) -> int:
    with waiting("checking"):
        grammar, mistakes = _read(paths.find("grammars", options.file))
        findings = [Finding("error", error.place, error.what, error.remedy) for error in mistakes]
        findings = findings or check(grammar, _lexicon())
        if all(finding.severity != "error" for finding in findings):
            findings = [*_too_large(grammar), *findings]
    if options.json:
        print(json.dumps(_as_json(grammar, findings), indent=2))
    else:
        _show(grammar, findings, options.all)
    severities = {finding.severity for finding in findings}
    if "error" in severities:
        return 2
    return 1 if options.strict and "warning" in severities else 0


def _read(path: Path) -> tuple[Grammar, list[AuthoringError]]:
    """The grammar and its syntax errors; no grammar and one error for a file that is not text."""
    try:
        return read_grammar(path)
    except AuthoringError as error:
        return Grammar(path.stem, path, {}), [error]


class _OneSound:
    """A pronunciation shared by all words: a grammar too large with it is too large with any."""

    def pronunciations(self, word: str) -> tuple[tuple[str, ...], ...]:
        return (("AH",),)


def _too_large(grammar: Grammar) -> list[Finding]:
    """A warning for a grammar that the default engine cannot handle, whatever its
    pronunciations.
    """
    try:
        compile(grammar.graph(), _OneSound())
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        return [warning(Place(grammar.path), what, remedy)]
    return []


def _lexicon() -> Lexicon | None:
    try:
        return load_lexicon()
    except NotAvailable as error:
        report(f"pronunciations are not checked: {error}", file=sys.stderr)
        return None


def _as_json(grammar: Grammar, findings: list[Finding]) -> dict[str, object]:
    return {
        "file": str(grammar.path),
        "commands": len(grammar.public_rules),
        "words": len(grammar.words()),
        "findings": [
            {
                "severity": finding.severity,
                "file": str(finding.place.path),
                "line": finding.place.line,
                "column": finding.place.column,
                "what": finding.what,
                "remedy": finding.remedy,
            }
            for finding in findings
        ],
    }


def _show(grammar: Grammar, findings: list[Finding], is_all: bool) -> None:
    excerpts = Excerpts()
    most_errors = len(findings) if is_all else MOST_SHOWN
    errors = [finding for finding in findings if finding.severity == "error"]
    others = [finding for finding in findings if finding.severity != "error"]
    for finding in errors[:most_errors]:
        _print(finding, excerpts, sys.stderr)
    if len(errors) > most_errors:
        more = _counted(len(errors) - most_errors, "more error")
        report(f"{grammar.path}: {more} - fix these, or see --all", file=sys.stderr)
    for finding in others:
        if is_all or finding.severity != "note":
            _print(finding, excerpts, sys.stdout)
    if not errors:
        is_less = not is_all and any(finding.severity == "note" for finding in others)
        summary = _summary(grammar, others) + (" (see --all)" if is_less else "")
        report(f"{grammar.path}: fine, {summary}")


def _print(finding: Finding, excerpts: Excerpts, stream: TextIO) -> None:
    report(str(finding), stream)
    excerpt = excerpts.of(finding.place)
    if excerpt:
        print(excerpt, file=stream)


def _summary(grammar: Grammar, findings: list[Finding]) -> str:
    parts = [_counted(len(grammar.public_rules), "command"), _counted(len(grammar.words()), "word")]
    counts = Counter(finding.severity for finding in findings)
    parts += [_counted(counts[severity], severity) for severity in SEVERITIES if counts[severity]]
    return ", ".join(parts)


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
