"""A rule of reading: a pattern, and the words for its matches."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

Match = re.Match[str]
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺"
LETTER = rf"[^\W\d_{SUPERSCRIPTS}½¼¾⅐-⅟\u2460-\u24ff]"
"""A letter: numbers above the line count as such in regular expressions."""


@dataclass(slots=True)
class Scan:
    """Facts about the text before, for rules to use."""

    is_after_amount: bool = False
    """Whether the last that was said was an amount, with at most a space since."""
    is_quoted: bool = False
    """Whether a quotation was opened and not closed."""


@dataclass(frozen=True, slots=True)
class Rule:
    """Reads what `pattern` finds at a place of a text."""

    pattern: re.Pattern[str]
    words: Callable[[Match, Scan], str | None]
    """What is said; None where the rule does not apply."""
    is_amount: bool = False
    """Whether that can begin or end a range."""


def rule(pattern: str, words: Callable[[Match, Scan], str | None] | str) -> Rule:
    """A rule that says words, or a text with the groups of the pattern as "{1}"."""
    return Rule(re.compile(pattern), _saying(words))


def amount(pattern: str, words: Callable[[Match, Scan], str | None] | str) -> Rule:
    """The same for an amount."""
    return Rule(re.compile(pattern), _saying(words), is_amount=True)


def _saying(
    words: Callable[[Match, Scan], str | None] | str,
) -> Callable[[Match, Scan], str | None]:
    if not isinstance(words, str):
        return words
    return lambda match, scan: words.format("", *match.groups(default=""))
