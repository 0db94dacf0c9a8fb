"""Abbreviations, titles and streets, initials, and names with signs in them."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re

from hri.speech.notation.abbreviations import (
    BEFORE_NUMBERS,
    DIRECTIONS,
    PLAIN,
    SPELLED,
    STATES,
    STREET_NAMES,
    STREETS,
    TITLES,
    WITHOUT_PERIOD,
)
from hri.speech.notation.context import FUNCTION_WORDS, text_after, text_before
from hri.speech.notation.quantities import any_of
from hri.speech.notation.rule import Match, Rule, Scan, rule

_ANY_STREET = any_of((*STREETS, *STREET_NAMES))
_NAME = r"(?:[A-Z][\w']+|\d{1,3}(?:st|nd|rd|th))"
_NAME_BEFORE = re.compile(rf"(?:^|\s)({_NAME}) $")
_HOUSE_BEFORE = re.compile(rf"\d[\w-]* (?:[NSEW]\.? )?{_NAME}(?: [A-Z][\w']+){{0,2}} $")
_PLACE_BEFORE = re.compile(
    r"\b(?:on|at|of|down|up|along|near|from|to|off|and|across) (?:[NSEW]\.? )?"
    rf"(?:[A-Z][\w']+ ){{0,2}}{_NAME} $"
)
_IN_ADDRESS = re.compile(rf" {_NAME}(?: [A-Z][\w']+)? (?:{_ANY_STREET})\b")
_BEHIND_STREET = re.compile(rf"\b(?:{_ANY_STREET})\.?,? $")
_CITY = re.compile(r"(?:^|[\s.])[A-Z][\w'.]+, $")
_GREETING = frozenset(
    ("ask", "call", "dear", "good", "hello", "hey", "hi", "no", "see", "tell", "thanks", "yes")
)
"""Words before a title, which begin with a capital at the begin of a sentence."""
_ALSO_WORDS = frozenset(("OK", "IN", "OR", "ME", "HI", "OH"))
"""States that are words, too."""
_GRADED = re.compile(r"(?i)\b(?:an?|got|grade|rated|earned|gets?|is|of) $")


def _ending(match: Match, words: str) -> str:
    """With the period of an abbreviation where that ends the sentence, too."""
    ends = match[0].endswith(".") and not text_after(match).strip(" \"')”’")
    return f"{words}." if ends else words


def _street(match: Match, scan: Scan) -> str | None:
    """A street behind its name: "Elm Dr.", not "Ask Dr. Smith"."""
    before = text_before(match)
    found = _NAME_BEFORE.search(before)
    if found is None or found[1].lower() in FUNCTION_WORDS | _GREETING:
        return None
    starts = re.fullmatch(r"\s*[A-Z][\w']+ ", before) is not None
    has_name_behind = re.match(r" [A-Z][a-z]", text_after(match)) is not None
    is_place = not starts and (_PLACE_BEFORE.search(before) or _HOUSE_BEFORE.search(before))
    if match[1] in TITLES and has_name_behind and not is_place:
        return None
    return _ending(match, STREETS[match[1]])


def _title(match: Match, scan: Scan) -> str | None:
    is_one = match[0].endswith(".") or match[1] in WITHOUT_PERIOD
    return TITLES[match[1]] if is_one else None


def _direction(match: Match, scan: Scan) -> str | None:
    """A point of the compass in an address: "123 N. Main St."."""
    in_address = _IN_ADDRESS.match(text_after(match)) or _BEHIND_STREET.search(text_before(match))
    return DIRECTIONS[match[1]] if in_address else None


def _state(match: Match, scan: Scan) -> str | None:
    """A state behind a city or before its ZIP code: "Austin, TX 78701"."""
    has_zip = re.match(r",? \d{5}\b", text_after(match)) is not None
    is_behind_city = _CITY.search(text_before(match)) and match[0] not in _ALSO_WORDS
    return STATES[match[0]] if has_zip or is_behind_city else None


def _before_number(match: Match, scan: Scan) -> str:
    words = BEFORE_NUMBERS[match[1].lower()]
    return words.capitalize() if match[1][0].isupper() else words


def _plain(match: Match, scan: Scan) -> str | None:
    is_word = match[0] in ("est.", "min.", "mo.", "ed.") and not text_after(match).strip()
    return None if is_word else _ending(match, PLAIN[match[0]])


def _initials(match: Match, scan: Scan) -> str:
    return _ending(match, _spelt(match[0].replace(".", "")))


def _spelt(letters: str) -> str:
    return " ".join(letters.upper())


def _row(match: Match, scan: Scan) -> str | None:
    """Letters with spaces between them; I and A may be words."""
    return match[0] if set(match[0]) - set("AI ") else None


def _versus(match: Match, scan: Scan) -> str | None:
    return "versus" if re.search(r"[A-Z]\w* $", text_before(match)) else None


def _joined(match: Match, scan: Scan) -> str:
    """AT&T is spelt, and so is AC/DC; a word is not."""
    sign = " and " if "&" in match[0] else " "
    parts = re.split(r"[/&]", match[0])
    are_spelt = "&" in match[0] or all(len(part) < 4 for part in parts)
    return sign.join(map(_spelt, parts) if are_spelt else parts)


def _pluses(match: Match, scan: Scan) -> str:
    name = match[1].upper() if len(match[1]) == 1 else match[1]
    return name + " plus" * len(match[2])


def _grade(match: Match, scan: Scan) -> str | None:
    return f"{match[1]} minus" if _GRADED.search(text_before(match)) else None


def _library(match: Match, scan: Scan) -> str:
    return f"{match[1]} dot {SPELLED.get(match[2]) or _spelt(match[2])}"


NAMES: tuple[Rule, ...] = (
    rule(r"([A-GJQX])[#♯](?![\w#])", "{1} sharp"),
    rule(r"([A-G])♭(?!\w)", "{1} flat"),
    rule(r"ASP\.NET\b", "A S P dot net"),
    rule(r"([A-Z][A-Za-z]{1,12})\.(js|py|rs|io|ai|ts|jl)\b", _library),
    rule(
        r"([A-Za-z]{1,3}|Google|Disney|Apple|Paramount|[Nn]otepad|[A-Z]{4})(\+{1,2})(?![\w+])",
        _pluses,
    ),
    rule(r"([A-F])-(?=[\s.,;!?)]|$)(?! [-–])(?! \w+-)", _grade),
    rule(r"[Aa][-–][Zz]\b", "A to Z"),
    rule(r"[A-Z]{1,3}&[A-Z]{1,3}\b", _joined),
    rule(r"[A-Z]{1,4}(?:/[A-Z]{1,4}){1,3}\b", _joined),
    rule(r"([b-df-hj-np-tv-xz]{2})(?=[²³])", lambda m, s: _spelt(m[1])),
)
_LETTERS = rule(r"[A-Z](?: [A-Z]){1,40}(?![\w'.])", _row)
ABBREVIATIONS: tuple[Rule, ...] = (
    rule(rf"({any_of(STREETS)})\b\.?(?![\w'])", _street),
    rule(rf"({any_of(TITLES)})\b\.?(?= (?:[A-Z]|O')[\w.'])", _title),
    rule(rf"({any_of(DIRECTIONS)})\b\.?(?!\w)", _direction),
    rule(rf"(?:{any_of(STATES)})\b(?!['.]\w)", _state),
    rule(rf"((?i:{any_of(BEFORE_NUMBERS)}))\. ?(?=[\d#])", _before_number),
    rule(rf"(?:{any_of(PLAIN)})(?!\w)", _plain),
    _LETTERS,
    rule(r"v\.(?= [A-Z])", _versus),
    rule(r"(?:[A-Za-z]\.){2,8}(?:[A-Z]\b)?", _initials),
    rule(r"([A-Z])\.(?= [A-Za-z])", "{1}"),
)
