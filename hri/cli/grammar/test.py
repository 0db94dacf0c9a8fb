"""`hri grammar test`: tests a grammar with sentences or recordings."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from hri.cli.grammar import explained
from hri.cli.grammar.engine import add_engine_arguments, add_strictness, started_engine
from hri.cli.grammar.manifest import read_manifest
from hri.cli.terminal.progress_line import progress
from hri.core import paths
from hri.core.errors import HriError, Mistakes
from hri.core.quoting import message_line, report
from hri.core.statistics import told
from hri.speech.grammar import Grammar, analysis, read_grammar
from hri.speech.grammar.lint.expectations import Failure, failures, meaning_of, read_expectations
from hri.speech.trials import Attempt, attempt, confusions, score

EXAMPLES = """\
examples:
  hri grammar test my.txt                          sentences for the grammar my.jsgf beside it
  hri grammar test my.txt --grammar companion
  hri grammar test --audio manifest.tsv --grammar companion

A file of sentences:
  grammar companion                                # optional: the grammar these are for
  + go back one meter => move: distance=-1         # understood, with this rule and these tags
  ++ a bit more => move: distance=-0.5             # the same, said after the line before
  + hello robot                                    # understood
  - fly to the moon                                # not understood
To begin one: hri grammar expand FILE --random 20 --tags > my.txt

A manifest of recordings, with a tab between the columns: file, sentence (- for something that the
grammar does not allow), and optionally the tags. Status 0: all as expected. 1: something was not.
2: a file is wrong."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help="sentences to try")
    parser.add_argument("--audio", type=Path, metavar="MANIFEST", help="recordings to try")
    parser.add_argument("--grammar", metavar="GRAMMAR", help="file, or name of one in grammars/")
    add_strictness(parser)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    add_engine_arguments(parser)


def run(options: argparse.Namespace) -> int:
    if not options.files and options.audio is None:
        raise HriError("nothing to test - name a file of sentences, or --audio MANIFEST.tsv")
    statuses = [_tried(path, options) for path in options.files]
    if options.audio is not None:
        statuses.append(_try_recordings(options))
    return max(statuses)


def _tried(path: Path, options: argparse.Namespace) -> int:
    """Try a file; an error in one does not stop the others."""
    if len(options.files) == 1:
        return _try_sentences(path, options)
    try:
        return _try_sentences(path, options)
    except HriError as error:
        print(explained(error), file=sys.stderr)
        return 2


def _try_sentences(path: Path, options: argparse.Namespace) -> int:
    expectations = read_expectations(path)
    grammar = _loaded(_grammar_of(path, options.grammar or expectations.grammar))
    failed = failures(grammar, expectations)
    count = len(expectations.lines)
    if options.json:
        print(json.dumps(_as_json(path, count, failed), indent=2))
    else:
        for failure in failed:
            print(message_line(str(failure)))
        report(f"{path}: {count - len(failed)} of {count} sentences as expected")
    return 1 if failed else 0


def _loaded(path: Path) -> Grammar:
    """The grammar. Raises AuthoringError; AuthoringErrors when there are several mistakes in it."""
    grammar, errors = read_grammar(path)
    mistakes = Mistakes()
    for error in errors or analysis.errors(grammar):
        mistakes.add(error)
    mistakes.tell()
    return grammar


def _grammar_of(path: Path, named: str) -> Path:
    """The named grammar, beside the file or in grammars/; by default the one with the file's
    name.
    """
    suffixes = paths.suffixes("grammars")
    if not named:
        beside = [path.with_suffix(suffix) for suffix in suffixes]
        found = next(filter(paths.is_file, beside), None)
        if found is None:
            remedy = f"add --grammar NAME, or put {beside[0].name} beside it"
            raise HriError(f"{path}: which grammar is this for? - {remedy}")
        return found
    spelled = [path.parent / f"{named}{suffix}" for suffix in ("", *suffixes)]
    return next(filter(paths.is_file, spelled), None) or paths.find("grammars", named)


def _as_json(path: Path, count: int, failed: list[Failure]) -> dict[str, object]:
    return {
        "file": str(path),
        "sentences": count,
        "failures": [
            {
                "line": failure.expectation.place.line,
                "sentence": failure.expectation.sentence,
                "came": failure.came,
                "expected": str(failure.expectation.meaning or "not understood"),
            }
            for failure in failed
        ],
    }


def _try_recordings(options: argparse.Namespace) -> int:
    grammar = _loaded(_grammar_of(options.audio, options.grammar or ""))
    rows = read_manifest(options.audio, grammar)
    with started_engine(options, grammar) as engine:
        heard = [
            attempt(row.clip(), engine, grammar) for row in progress(rows, len(rows), "hearing")
        ]
    wrong = [tried for tried in heard if not tried.is_right(grammar, options.strictness)]
    if options.json:
        print(json.dumps(_heard_as_json(options, grammar, heard), indent=2))
    else:
        _show(options, grammar, heard, wrong)
    return 1 if wrong else 0


def _show(
    options: argparse.Namespace, grammar: Grammar, heard: list[Attempt], wrong: list[Attempt]
) -> None:
    for tried in wrong:
        report(f'{tried.name}: "{tried.said}" {_outcome(tried, grammar, options.strictness)}')
    counts = score(heard, grammar, options.strictness)
    confused = confusions(heard, grammar, options.strictness)
    if confused:
        print("\ntaken for something else:")
        for (said, taken), times in confused.most_common():
            report(f'  {times} x "{said}" for "{taken}"')
        print()
    report(f"{options.audio}: at strictness {options.strictness:g}, with 95 % intervals")
    report(f"  commands right and accepted    {told(counts.right, counts.commands)}")
    report(f"  commands taken for another     {told(counts.wrong, counts.commands)}")
    report(f"  others accepted                {told(counts.foreign_accepted, counts.foreign)}")


def _outcome(tried: Attempt, grammar: Grammar, strictness: float) -> str:
    accepted = tried.accepted(grammar, strictness)
    if [reading.text for reading in accepted] == [tried.said]:
        return f"was heard as {meaning_of(accepted[0])}, not as {tried.meaning}"
    if accepted:
        words = " and ".join(f'"{reading.text}"' for reading in accepted)
        return f"was taken for {words}"
    if not tried.pieces:
        return "was not heard"
    reading, confidence = max(tried.pieces, key=lambda piece: piece[1])
    return f'was rejected: "{reading.text}" with confidence {confidence:.2f}'


def _heard_as_json(
    options: argparse.Namespace, grammar: Grammar, heard: list[Attempt]
) -> dict[str, object]:
    counts = score(heard, grammar, options.strictness)
    return {
        "file": str(options.audio),
        "strictness": options.strictness,
        "commands": counts.commands,
        "right": counts.right,
        "wrong": counts.wrong,
        "foreign": counts.foreign,
        "foreign_accepted": counts.foreign_accepted,
        "recordings": [
            {
                "file": tried.name,
                "said": tried.said,
                "right": tried.is_right(grammar, options.strictness),
                "accepted": [one.text for one in tried.accepted(grammar, options.strictness)],
                "heard": [
                    {"text": reading.text, "rule": reading.rule, "tags": dict(reading.tags)}
                    | {"confidence": round(confidence, 4)}
                    for reading, confidence in tried.pieces
                ],
            }
            for tried in heard
        ],
    }
