"""Other ways to say what a rule says, for texts that no sentence of a grammar allows.

They lie beside the grammar, for `smalltalk.jsgf` in `smalltalk.paraphrases.txt`, below the names of
its rules:

    # Said by people, as they type it.
    [joke]
    got any gags
    make me laugh

    [turn ?]
    face the window

    [-]
    the laundry is still in the dryer

A text that no sentence allows is taken for the rule whose paraphrases it is most like, see
`hri.speech.grammar.guessing`. Below a name with `?` stand texts that may only be about it: such a
rule moves the robot, or has values, which a guess would have to make up. What stands below `-`
means no rule.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.speech.grammar.words import normalize

SUFFIX = ".paraphrases.txt"
MOST_ERRORS = 20
"""Most mistakes reported for one file."""
NO_RULE = "-"
KEPT_FILES = 16
_HEAD = re.compile(r"\[\s*(?P<rule>[^\s\]?]+)\s*(?P<vague>\?)?\s*\]")


class Paraphrase(NamedTuple):
    """One line."""

    rule: str
    """A public rule, or NO_RULE."""
    words: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Paraphrases:
    """A file of them. The same text of the same file is read once, and equal only to itself."""

    path: Path
    lines: tuple[Paraphrase, ...] = ()
    heads: tuple[tuple[str, int], ...] = ()
    """The rules that it names, with their lines, from 1."""
    vague: frozenset[str] = frozenset()
    """Rules that a text may only be about."""
    errors: tuple[AuthoringError, ...] = ()

    def unknown(self, rules: Collection[str]) -> Iterator[AuthoringError]:
        """A mistake for each name that is none of these rules."""
        for rule, line in self.heads:
            if rule not in rules and rule != NO_RULE:
                what = f"no public rule <{rule}> in {self.path.name.removesuffix(SUFFIX)}"
                yield AuthoringError(Place(self.path, line), what, did_you_mean(rule, rules))


@lru_cache(maxsize=KEPT_FILES)
def read_paraphrases(text: str, path: Path) -> Paraphrases:
    """The paraphrases in the text of a file, and its mistakes."""
    errors: list[AuthoringError] = []
    lines: list[Paraphrase] = []
    heads: dict[str, int] = {}
    vague: set[str] = set()
    known: dict[tuple[str, ...], int] = {}
    rule = ""
    for number, line in enumerate(text.split("\n"), 1):
        words, place = tuple(normalize(line)), Place(path, number)
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        if (head := _HEAD.fullmatch(line.strip())) is not None:
            rule = head["rule"]
            if rule in heads:
                what = f"[{rule}] stands in line {heads[rule]}, too"
                errors.append(AuthoringError(place, what, "put their lines together"))
            heads.setdefault(rule, number)
            vague.update({rule} if head["vague"] else ())
        elif line.lstrip().startswith("["):
            errors.append(AuthoringError(place, f"{line.strip()} is not a name", "write [rule]"))
        elif not rule:
            errors.append(AuthoringError(place, "no rule above this line", "write [rule] first"))
        elif words in known:
            what = f'"{line.strip()}" stands in line {known[words]}, too'
            errors.append(AuthoringError(place, what, "delete one of the two"))
        elif words:
            known[words] = number
            lines.append(Paraphrase(rule, words))
        if len(errors) >= MOST_ERRORS:
            break
    return Paraphrases(path, tuple(lines), tuple(heads.items()), frozenset(vague), tuple(errors))
