"""`hri grammar parse`: prints the meaning of a sentence, or where it leaves the grammar."""

from __future__ import annotations

import argparse
import io
import json
import sys
from collections.abc import Iterator

from hri.cli.grammar import FILE_HELP
from hri.cli.terminal.messages import legible
from hri.cli.terminal.progress_line import waiting
from hri.core.quoting import escaped, message_line
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.grammar.excerpt import excerpt
from hri.speech.grammar.guessing import paraphrased
from hri.speech.grammar.matching import (
    MOST_PARSES,
    Parse,
    Refusal,
    Tree,
    different,
    parses,
    refusal,
)
from hri.speech.grammar.tags import spell_tags
from hri.speech.grammar.tolerance import Tolerant, nearest

MOST_SHOWN = 12
"""Most words listed of those that could follow."""
DEEPEST = 200
"""Printed depth of nested rules; deeper ones are shown as words."""
LONGEST_RULES = 60
"""Most characters of rules in one line."""
LONGEST_LINE = 20_000
"""Most characters read of a line; more than a sentence may have."""

EXAMPLES = """\
examples:
  hri grammar parse companion "turn left a little"
  hri grammar parse companion "um go go forward" --tolerant
  hri grammar parse companion - --json < sentences.txt

The exit status is 0 when all are accepted, 1 when one is not.
"""

NO_MEANING: dict[str, object] = {"rule": "", "tags": {}, "tree": None, "free": [], "slots": []}
"""The fields for a sentence outside the grammar: all are present."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help=FILE_HELP)
    parser.add_argument(
        "texts",
        type=legible,
        metavar="TEXT",
        nargs="+",
        help='sentences, each in quotes (unquoted words form one); "-" reads lines',
    )
    parser.add_argument(
        "--tolerant",
        action="store_true",
        help="as typed lines are heard: forgive small words that are missing, extra or doubled, "
        "and show the cost; else take a command that stands in the sentence, or that it says in "
        "other words",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object per sentence")


def run(options: argparse.Namespace) -> int:
    with waiting("reading the grammar"):
        grammar = load_grammar(options.file)
        parses(grammar, "")  # Prepares it.
    status = 0
    for text in _sentences(options.texts):
        found = parses(grammar, text)
        near = nearest(grammar, text) if options.tolerant else None
        if not found and options.tolerant and (meant := _meant(grammar, text, near)) is not None:
            found = parses(grammar, meant.text)
        refused = None if found else refusal(grammar, text)
        if options.json:
            print(json.dumps(_object(text, found, near, refused)), flush=True)
        elif refused is not None:
            print(_refused(text, refused, None if options.tolerant else nearest(grammar, text)))
        else:
            print(_accepted(found, near))
        status = status or (0 if found else 1)
    return status


def _meant(grammar: Grammar, text: str, near: Tolerant | None) -> Parse | None:
    """What a line means beyond its letters; None if nothing is near it."""
    if near is not None:
        return near.parse
    part = excerpt(grammar, text)
    return paraphrased(grammar, text, part=part) or part


def _sentences(texts: list[str]) -> Iterator[str]:
    if "-" not in texts and all(len(text.split()) == 1 for text in texts):
        texts = [" ".join(texts)]
    for text in texts:
        if text == "-":
            yield from _lines()
        else:
            yield text


def _lines() -> Iterator[str]:
    if isinstance(sys.stdin, io.TextIOWrapper):
        sys.stdin.reconfigure(errors="replace")
    while line := sys.stdin.readline(LONGEST_LINE):
        rest = line
        while rest and not rest.endswith("\n"):
            rest = sys.stdin.readline(LONGEST_LINE)
        if line.strip():
            yield line.strip()


def _object(
    text: str, found: tuple[Parse, ...], near: Tolerant | None, refused: Refusal | None
) -> dict[str, object]:
    answer: dict[str, object] = {"text": found[0].text if found else text, "accepted": bool(found)}
    answer |= _meaning(found[0]) if found else NO_MEANING
    answer["parses"] = [_meaning(reading) for reading in found]
    answer["more_parses"] = len(found) == MOST_PARSES
    if near is not None:
        answer |= {"cost": near.cost, "edits": [str(edit) for edit in near.edits]}
    if refused is not None:
        answer |= {
            "understood": refused.understood,
            "word": refused.word,
            "expected": list(refused.expected),
            "remedy": refused.remedy,
        }
    return answer


def _meaning(reading: Parse) -> dict[str, object]:
    words = reading.text.split()
    return {
        "rule": reading.rule,
        "tags": dict(reading.tags),
        "tree": _branch(reading.tree, words, DEEPEST),
        "free": list(reading.free),
        "slots": [
            {"name": slot.name, "text": slot.text, "start": slot.start, "end": slot.end}
            for slot in reading.slots
        ],
    }


def _branch(tree: Tree, words: list[str], levels: int) -> dict[str, object]:
    children = tree.children if levels else tuple(words[tree.start : tree.end])
    return {
        "rule": tree.rule,
        "start": tree.start,
        "end": tree.end,
        "children": [
            child if isinstance(child, str) else _branch(child, words, levels - 1)
            for child in children
        ],
    }


def _accepted(found: tuple[Parse, ...], near: Tolerant | None) -> str:
    lines = [_forgiven(near) if near is not None and near.edits else found[0].text]
    shown = different(found)
    if len(shown) > 1:
        count = f"{len(shown)} or more" if len(found) == MOST_PARSES else f"{len(shown)}"
        what = (
            "all are equally specific, so the robot asks" if found[0].free else "the first counts"
        )
        lines.append(f"ambiguous, {count} meanings; {what}")
    for reading in shown:
        tags = f" {{{spell_tags(reading.tags)}}}" if reading.tags else ""
        lines.append(reading.rule + tags)
        lines += _drawn(reading)
    return "\n".join(map(escaped, lines))


def _forgiven(near: Tolerant) -> str:
    return f"{near.parse.text}   ({' '.join(map(str, near.edits))}, cost {near.cost:g})"


def _drawn(reading: Parse) -> Iterator[str]:
    """The rules of a tree with their words, each below and right of the one that uses it. A rule
    that is another's only content shares its line. Free words stand in parentheses.
    """
    words = reading.text.split()
    for place in reading.free:
        words[place] = f"({words[place]})"
    rules, indent = "", 0
    for depth, tree in reading.tree.walk():
        indent, rules = (indent, rules) if rules else (depth, "")
        rules += f"<{tree.rule}> "
        is_all = len(tree.children) == 1 and isinstance(tree.children[0], Tree)
        if not is_all or len(rules) > LONGEST_RULES:
            if indent < DEEPEST:
                said = " ".join(words[tree.start : tree.end])
                yield f"{'  ' * (indent + 1)}{rules}{said}".rstrip()
            rules = ""


def _refused(text: str, refused: Refusal, near: Tolerant | None) -> str:
    after = f'after "{refused.understood}"' if refused.understood else "at the beginning"
    what = f'"{refused.word}" does not fit' if refused.word else "more words are expected"
    line = message_line(f'"{text}" is not in the grammar: {what} {after} - {refused.remedy}')
    if near is not None:
        line += f"\n  with --tolerant: {escaped(_forgiven(near))}"
    if not refused.expected:
        return f"{line}\n  the sentence ends there"
    shown = ", ".join(refused.expected[:MOST_SHOWN])
    rest = len(refused.expected) - MOST_SHOWN
    more = f" and {rest} more" if rest > 0 else ""
    return f"{line}\n  {escaped(f'{after}: {shown}{more}')}"
