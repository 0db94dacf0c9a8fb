"""What stands around a number: signs of a year, a count, a code."""

# ruff: noqa: RUF001, SIM905 - signs of texts are meant; tables of words stay readable.
from __future__ import annotations

import re

from hri.speech.notation.rule import Match

WINDOW = 80
"""Characters that are looked at on each side."""
FUNCTION_WORDS = frozenset(
    """a about across after again against ago all along also although always am an and any apart
    are around as at away back be because been before behind being below between both but
    by can could deep did do does down during each either else every few first for from
    had has have he her here high him his how i if in into is it its just last late later
    left less like long may me might minus more most much must my near nearly new next no
    nor not now of off often old on once only onto or other our out over own past per
    perhaps plus remaining right same she should since so some soon still tall than that
    the their them then there these they this those though through thus till times to
    today together tomorrow tonight too total toward towards under unless until up upon us
    versus very via was we were what when where whether which while who whose why wide
    will with within without would yes yesterday yet you your""".split()
)
"""Words that are neither things nor what things are like."""
VERBS = frozenset(
    """begins brings comes costs ends equals feels gets goes had happens keeps looks makes marks
    means needs remains said saw says seems sees shows starts takes turns wins works""".split()
)
"""Words that look like plurals, and follow a year."""
IRREGULAR = frozenset(
    """aircraft children deer dozen euros feet fish geese hertz horsepower men mice people
    percent police sheep staff teeth women won yen""".split()
)
"""Plurals without an s, and the like."""
MEASURES = IRREGULAR | frozenset(
    """books bytes calories cars centimeters cents characters copies days degrees dollars files
    followers gallons grams hours houses inches items kilograms kilometers letters lines
    liters meters miles millimeters minutes months pages parts photos pictures pieces
    pixels points pounds seats seconds steps tickets tons users volts watts weeks words
    yards years""".split()
)
"""Nouns that are counted, regardless of the word before the number."""
YEAR_NOUNS = frozenset(
    """accords awards census championships elections finals games hurricanes models olympics
    playoffs prices protests results riots rules sales talks taxes wildfires""".split()
)
"""What is of a year: "the 1984 games"."""
YEAR_BEFORE = frozenset(
    """after apr april aug august autumn before between by circa class copyright dec december
    during early fall feb february fiscal from in jan january jul july jun june late mar
    march may mid nov november oct october of sep sept september since spring summer
    through till to until vintage winter year years""".split()
)
"""Words before a year."""
COUNT_BEFORE = frozenset(
    """all almost another approximately cost costs counted equals exactly least makes most nearly
    only over paid pays roughly some than total totaling totals weigh weighs""".split()
)
"""Words before a count."""
TIME_PREPOSITIONS = frozenset("""after before by during in since the until""".split())
"""Words before a year that may also stand before a count."""
PAIRED_AFTER = frozenset(
    """airbus apartment apt boeing bus cabin channel error exit flight flights freeway gate hall
    highway http hwy interstate locker model office peugeot porsche rm room rooms route
    rte status ste suite trail train unit""".split()
)
"""What has numbers that are read in pairs."""
DIGITS_AFTER = frozenset(
    """account code combination ext extension id isbn license passcode password pin plate
    postcode serial zip zipcode""".split()
)
"""What has numbers that are read digit by digit."""
SERVICES = frozenset("211 311 411 511 611 711 811 911 988".split())
"""Telephone numbers of the North American Numbering Plan's N11 codes, and the crisis line 988."""
_CALLED = re.compile(
    r"(?i)\b(?:call(?:s|ed|ing)?|dial(?:s|ed|ing)?|phoned?|ring|text(?:ing)?|sms)"
    r"(?: [\w']+){0,4}[ :]+$"
)
_SUM_BEFORE = re.compile(r"[=+×*÷<>−]\s?$")
_SUM_BEHIND = re.compile(r"\s?[=+×*÷<>−]")
_NOUN_BEHIND = re.compile(r"-[a-z]|\s(?:more|of|or more|square|cubic)\b")
_WORD_BEFORE = re.compile(r"([^\W\d_]+)[.:]?[ #]{1,2}$")
_ARTICLE = re.compile(
    r"(?i)\b(?:a|an|the|my|your|his|her|our|their|its|this|that|each|every|one|another|per|single)"
    r"(?: [a-z]+)? [-+~$€£]?$"
)
_WORDS_AFTER = re.compile(r"(?: ([^\W\d_]+(?:'[a-z]+)?)(?: ([^\W\d_]+))?)?")


def text_before(match: Match) -> str:
    """The end of the text before."""
    return match.string[max(0, match.start() - WINDOW) : match.start()]


def text_after(match: Match) -> str:
    """The begin of the text after."""
    return match.string[match.end() : match.end() + WINDOW]


def word_before(match: Match) -> str:
    """The word right before, in small letters; empty after a comma or the like."""
    found = _WORD_BEFORE.search(text_before(match))
    return found[1].lower() if found else ""


def words_after(match: Match) -> tuple[str, str]:
    """The one or two words right after; empty where there are signs."""
    found = _WORDS_AFTER.match(match.string, match.end())
    return (found[1] or "", found[2] or "") if found else ("", "")


def is_called(match: Match) -> bool:
    """Whether someone is to call this number."""
    return _CALLED.search(text_before(match)) is not None


def counts(match: Match) -> str:
    """The noun that is counted by this number; empty for none."""
    first, second = words_after(match)
    if _is_plural(first):
        return first
    is_adjective = first.islower() and first not in FUNCTION_WORDS | VERBS
    return second if is_adjective and _is_plural(second) else ""


def _is_plural(word: str) -> bool:
    if word in IRREGULAR:
        return True
    is_one = word in FUNCTION_WORDS or word in VERBS or word.endswith(("ss", "us", "is"))
    return word.islower() and word.endswith("s") and not is_one


def is_attributive(match: Match) -> bool:
    """Whether an amount stands before a noun as "12 V" does in "a 12 V battery"."""
    first, _ = words_after(match)
    noun = first.islower() and first not in FUNCTION_WORDS and len(first) > 1
    return noun and _ARTICLE.search(text_before(match)) is not None


def is_year(match: Match, number: int) -> bool:
    """Whether four digits are a year."""
    if not 1000 <= number <= 2099:
        return False
    before, counted = word_before(match), counts(match)
    if counted:
        is_time = before in TIME_PREPOSITIONS
        return (is_time and counted not in MEASURES) or counted in YEAR_NOUNS
    if before in YEAR_BEFORE:
        return True
    is_sum = _SUM_BEFORE.search(text_before(match)) or _SUM_BEHIND.match(text_after(match))
    has_noun = _NOUN_BEHIND.match(text_after(match))
    return not (before in COUNT_BEFORE or is_sum or has_noun)
