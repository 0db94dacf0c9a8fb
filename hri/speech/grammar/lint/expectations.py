"""What a grammar is expected to understand, line by line in a text file: tests of a grammar.

    # The first line may name the grammar, else it is the one beside the file with the same name.
    grammar companion

    + go back one meter => distance=-1          understood, with these tags and no others
    + go back one meter => move: distance=-1    ... and by this rule
    + go back one meter => move:                ... by this rule, whatever its tags
    + hello robot => greet: {}                  understood, without any tag; or only "=>"
    + see you tomorrow                          understood, whatever it means
    ++ a bit more => move: distance=-0.5        the same, when it is said after the line before
    - fly to the moon                           not understood

Lines that begin with `#` or `//` are comments, and so is what follows ` #`. Tags are written as in
grammars, without the braces.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from hri.core.errors import AuthoringError, Mistakes, Place
from hri.core.reading import read_text
from hri.speech.grammar.follow_ups import Followed, can_be_followed, out_of_place, resolved
from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.matching import Parse, meanings, parse, refusal
from hri.speech.grammar.tags import TagEntry, Value, evaluate, read_entries, spell_tags

_LINE = re.compile(r"(?P<sign>\+\+|[+-])(?P<sentence>.*?)(?P<arrow>=>(?P<meaning>.*))?")
_MEANING = re.compile(r"(?:(?P<rule>[\w.-]+)\s*:(?:\s+|$))?(?P<tags>.*)", re.DOTALL)
_COMMENT = re.compile(r"\s#.*")


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a sentence should mean."""

    rule: str | None = None
    """The public rule; None when any will do."""
    tags: Mapping[str, Value] | None = None
    """All its tags; None when any will do."""

    def __str__(self) -> str:
        if self.tags is None:
            return f"{self.rule}:" if self.rule else "any rule"
        return f"{self.rule or 'any rule'}: {spell_tags(self.tags) or '{}'}"

    def fits(self, found: Parse) -> bool:
        """Whether a reading means this."""
        is_rule = self.rule in (None, found.rule)
        return is_rule and (self.tags is None or _are_same(self.tags, found.tags))


def _are_same(one: Mapping[str, Value], other: Mapping[str, Value]) -> bool:
    return one.keys() == other.keys() and all(_is_same(one[name], other[name]) for name in one)


def _is_same(one: Value, other: Value) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-9)
    return type(one) is type(other) and one == other  # 1 is not true.


def meaning_of(found: Parse) -> Meaning:
    """What was understood, as it is written in these files."""
    return Meaning(found.rule, found.tags)


@dataclass(frozen=True, slots=True)
class Expectation:
    """One line."""

    place: Place
    sentence: str
    meaning: Meaning | None
    """None when the sentence must not be understood."""
    is_follow_up: bool = False
    """Whether it is said after what the line before says."""


@dataclass(frozen=True, slots=True)
class Expectations:
    """A file of them."""

    path: Path
    grammar: str
    """Name or path of the grammar; empty when the file does not tell."""
    lines: tuple[Expectation, ...]


@dataclass(frozen=True, slots=True)
class Failure:
    """An expectation that was not met."""

    expectation: Expectation
    came: str
    """The actual outcome."""

    def __str__(self) -> str:
        line = self.expectation
        wanted = "not to be understood" if line.meaning is None else str(line.meaning)
        return f'{line.place}: "{line.sentence}" {self.came} - expected {wanted}'


def failures(grammar: Grammar, expectations: Expectations) -> list[Failure]:
    """The expectations that a grammar does not meet, in their order."""
    found: list[Failure] = []
    last: Followed | None = None
    for line in expectations.lines:
        last = last if line.is_follow_up else None
        rules = frozenset(grammar.public_rules) - out_of_place(grammar, last)
        meant = parse(grammar, line.sentence, rules)
        if meant is not None:
            meant = resolved(grammar, meant, last)
        if came := _disappointment(grammar, line, meant):
            found.append(Failure(line, came))
        if meant is not None and meant.rule in can_be_followed(grammar):
            last = Followed(meant.rule, meant.tags)
        elif meant is not None:
            last = last or Followed()
    return found


def _disappointment(grammar: Grammar, line: Expectation, found: Parse | None) -> str:
    """How the outcome fails the expectation; empty when it does not."""
    if found is not None and found.free and len(all_of := meanings(grammar, line.sentence)) > 1:
        told = " or ".join(str(meaning_of(one)) for one in all_of)
        return f"means {told}, which are equally specific, so that the robot asks"
    if line.meaning is None:
        return "" if found is None else f"is understood as {meaning_of(found)}"
    if found is None:
        return f"is not understood{_how_far(grammar, line.sentence)}"
    if line.meaning.fits(found):
        return ""
    return f"is understood as {meaning_of(found)}{_slip(grammar, line.meaning)}"


def _slip(grammar: Grammar, wanted: Meaning) -> str:
    """The likely intention behind a lone name that is not a tag: a rule."""
    names = tuple(wanted.tags or ())
    is_slip = not wanted.rule and len(names) == 1 and names[0] in grammar.public_rules
    return f' (a rule is written with a colon, "=> {names[0]}:")' if is_slip else ""


def _how_far(grammar: Grammar, sentence: str) -> str:
    """Where a sentence leaves the grammar."""
    refused = refusal(grammar, sentence)
    if refused is None or not refused.understood:
        return ""
    return f' beyond "{refused.understood}"'


def read_expectations(path: Path) -> Expectations:
    """The expectations of a file.

    Raises AuthoringError for a line that cannot be read (AuthoringErrors for several), for a file
    without a sentence and for a grammar; HriError when it cannot be read.
    """
    mistakes = Mistakes()
    grammar = ""
    lines: list[Expectation] = []
    text = read_text(path, "file of expectations")
    if text.lstrip().startswith("#JSGF"):
        what, remedy = "this is a grammar", "name a file of sentences, or see `hri grammar check`"
        raise AuthoringError(Place(path), what, remedy)
    for number, raw in enumerate(text.splitlines(), start=1):
        line = _COMMENT.sub("", " " + raw).strip()
        place = Place(path, number, len(raw) - len(raw.lstrip()) + 1)
        if line.startswith("//") or not line:
            continue
        if line.split()[0] == "grammar" and not lines and not grammar:
            grammar = mistakes.keep(partial(_grammar_of, line, place)) or ""
        elif (read := mistakes.keep(partial(_expectation, line, place))) is not None:
            lines.append(read)
    mistakes.tell()
    if not lines:
        raise AuthoringError(Place(path), "no sentence in this file", "write one: + hello robot")
    return Expectations(path, grammar, tuple(lines))


def _grammar_of(line: str, place: Place) -> str:
    name = line.removeprefix("grammar").strip().rstrip(";")
    if not name:
        raise AuthoringError(place, "no name of a grammar", "write: grammar companion")
    return name


def _expectation(line: str, place: Place) -> Expectation:
    match = _LINE.fullmatch(line)
    if match is None:
        remedy = (
            "begin it with + (understood), ++ (after the line before), - (not understood)"
            " or # (comment)"
        )
        raise AuthoringError(place, "a line of another kind", remedy)
    sentence = match["sentence"].strip()
    if not sentence:
        raise AuthoringError(place, "no sentence", "write one behind the sign")
    if match["sign"] != "-":
        meaning = read_meaning(match["meaning"], place) if match["arrow"] else Meaning()
        return Expectation(place, sentence, meaning, is_follow_up=match["sign"] == "++")
    if match["arrow"]:
        raise AuthoringError(place, "what is not understood means nothing", 'leave "=>" out')
    return Expectation(place, sentence, None)


def read_meaning(text: str, place: Place) -> Meaning:
    """The meaning of `rule: tag=value tag=value`, where `{}` means no tags. Raises
    AuthoringError.
    """
    match = _MEANING.fullmatch(text.strip())
    assert match is not None, "all of the pattern is optional"
    rule, written = match["rule"], match["tags"].strip()
    if written in ("", "{}"):
        return Meaning(rule, None if rule and not written else {})
    try:
        entries = read_entries(written)
    except ValueError as error:
        raise AuthoringError(place, str(error), "write tags as name=value") from error
    if not _are_values(entries):
        what = "only values can be expected, each tag once, no sums and no $references"
        raise AuthoringError(place, what, "write tags as name=value, and lists as name+=text")
    return Meaning(rule, evaluate([entries]))


def _are_values(entries: Sequence[TagEntry]) -> bool:
    """Whether entries say each tag once, or text by text where it is a list."""
    known: dict[str, str] = {}
    for entry in entries:
        is_part = entry.operation == "+=" and isinstance(entry.value, str)
        is_new = entry.name not in known or (is_part and known[entry.name] == "+=")
        if entry.takes or not is_new or not (is_part or entry.operation == "="):
            return False
        known[entry.name] = entry.operation
    return True
