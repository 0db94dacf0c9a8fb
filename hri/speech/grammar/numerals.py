"""Numbers in digits, as they are said: what an author or a user may write instead of "ten"."""

from __future__ import annotations

import re
from collections.abc import Iterator

LONGEST = 6
"""Digits; a longer number without separators is said digit by digit."""
LONGEST_NAMED = 12
"""Digits of what is still said as a number: "nine hundred billion"."""
SEPARATORS = ",'_\N{RIGHT SINGLE QUOTATION MARK}"
"""What may stand between thousands and hundreds."""
CURRENCIES = {
    "$": ("dollars", "dollar"),
    "€": ("euros", "euro"),
    "£": ("pounds", "pound"),
    "¥": ("yen",),
}
"""What a sign before or behind a number is called."""
_HUNDREDTHS = {"$": ("cents", "cent"), "€": ("cents", "cent"), "£": ("pence", "penny")}

_FRACTIONS = {
    "½": ("a half", "half", "one half"),
    "¼": ("a quarter", "quarter", "one quarter"),
    "¾": ("three quarters",),
}
_HALF = {"5": "a half", "25": "a quarter", "75": "three quarters"}
_HALVES = re.compile(r"([1-9][0-9]*)\.(5|25|75)")
_FULL_HOUR = re.compile(r"([0-9]{1,2}):00([a-z]*)")
_YEAR = re.compile(r"1[1-9][0-9]{2}|20[0-9]{2}")
_DAY = re.compile(r"[1-9]|[12][0-9]|3[01]")
_ROW_OF_DIGITS = re.compile(r"[0-9][0-9,:-]*")
"""What may be read digit by digit, such as "555-1234"."""

_BELOW_TWENTY = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
    "nineteen",
)
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
NUMERALS = frozenset((*_BELOW_TWENTY, *_TENS, "half", "hundred", "quarter"))
"""Words that are an amount and nothing else."""
_UNITS = ((10**9, "billion"), (10**6, "million"), (1000, "thousand"), (100, "hundred"))
LARGE = frozenset(("hundred", "thousand", "million", "billion", "trillion"))
"""Words behind a number that make it larger."""
_ORDINALS = {
    "one": "first", "two": "second", "three": "third", "five": "fifth", "eight": "eighth",
    "nine": "ninth", "twelve": "twelfth",
}  # fmt: skip
_GROUPS = rf"[0-9]{{1,3}}(?:[{SEPARATORS}][0-9]{{3}})+(?![0-9])"
_NUMBER = re.compile(rf"({_GROUPS}|[0-9]+)(?:\.([0-9]+)|(st|nd|rd|th)\b)?", re.IGNORECASE)
_BARE_POINT = re.compile(r"(?<![\w.])\.(?=[0-9])")
"""Of ".5"."""
_TYPED = re.compile(
    rf"(?P<money>[{''.join(CURRENCIES)}]?)(?P<sign>-?)"
    rf"(?P<whole>{_GROUPS}|[0-9]*)(?:\.(?P<decimals>[0-9]+))?(?P<behind>[{''.join(CURRENCIES)}]?)"
)
_SIGNS = {"": ("",), "-": ("minus ", "negative "), "+": ("plus ", "")}


def in_words(text: str) -> str:
    """The text with its numbers in words: "10" is "ten", "2.5" is "two point five".

    "1,000" is "one thousand", "3rd" is "third". The words are those that `grammars/numbers.jsgf`
    understands.
    """
    return " ".join(_NUMBER.sub(_spelt, _BARE_POINT.sub("0.", text)).split())


def sayings(written: str) -> Iterator[str]:
    """How a number that someone typed may be said, the likeliest first: "-5", "$1,000.50", ".5".

    A sign of a currency may be said or not. Digits may be said one by one, and zero as "oh".
    """
    sign = written[0] if written[0] in "+-" else ""
    match = _TYPED.fullmatch(written, len(sign))
    if written[-1] in _FRACTIONS:
        whole = in_words(written[len(sign) : -1])
        amounts = [f"{whole} and {part}" if whole else part for part in _FRACTIONS[written[-1]]]
    elif match is None or not (match["whole"] or match["decimals"]):
        amounts = [in_words(written[len(sign) :])]
    else:
        amounts = list(_amounts(match))
        sign = sign or match["sign"]
    said = [prefix + amount for prefix in _SIGNS[sign] for amount in amounts]
    if not sign:
        said += _in_dates_and_times(written)
    if _ROW_OF_DIGITS.fullmatch(written):
        said.append(_digits(re.sub(r"[^0-9]", "", written)))
    for words in said:
        yield words
        if "zero" in words:
            yield words.replace("zero", "oh")


def _in_dates_and_times(written: str) -> Iterator[str]:
    """How the day of a month, a year, a full hour, or a half is said."""
    if match := _FULL_HOUR.fullmatch(written):
        hour = _whole(int(match[1]))
        yield f"{hour} {match[2]}"
        yield f"{hour} o'clock {match[2]}"
    elif match := _HALVES.fullmatch(written):
        yield f"{in_words(match[1])} and {_HALF[match[2]]}"
    elif _YEAR.fullmatch(written):
        century, year = divmod(int(written), 100)
        rest = _whole(year) if year > 9 else f"oh {_whole(year)}" if year else "hundred"
        yield f"{_whole(century)} {rest}"
    elif _DAY.fullmatch(written):
        yield _ordinal(_whole(int(written)))


def _amounts(match: re.Match[str]) -> Iterator[str]:
    whole, decimals = match["whole"] or "0", match["decimals"]
    money = match["money"] or match["behind"]
    amount = in_words(f"{whole}.{decimals}" if decimals else whole)
    for unit in CURRENCIES.get(money, ()):
        if decimals and len(decimals) == 2:
            for part in _HUNDREDTHS.get(money, ()):
                hundredths = f"{_whole(int(decimals))} {part}"
                yield f"{in_words(whole)} {unit} and {hundredths}"
                yield f"{in_words(whole)} {unit} {hundredths}"
                if not whole.strip("0"):
                    yield hundredths
        yield f"{amount} {unit}"
    if decimals in ("0", "00"):  # More of them may be a thousand.
        yield from (f"{in_words(whole)} {unit}" for unit in CURRENCIES.get(money, ()))
        yield in_words(whole)
    yield amount
    if not match["whole"]:
        yield amount.removeprefix("zero ")
    if LONGEST < len(_bare(whole)) <= LONGEST_NAMED and not decimals:
        yield _whole(int(_bare(whole)))


def _bare(number: str) -> str:
    return re.sub(rf"[{SEPARATORS}]", "", number)


def _spelt(match: re.Match[str]) -> str:
    written, decimals, ending = match.groups()
    whole = _bare(written)
    longest = LONGEST if whole == written else LONGEST_NAMED
    is_code = len(whole) > longest or (whole[0] == "0" and len(whole) > 1)
    said = _digits(whole) if is_code else _whole(int(whole))
    if ending:
        return f" {_ordinal(said)} "
    return f" {said} point {_digits(decimals)} " if decimals else f" {said} "


def _digits(digits: str) -> str:
    return " ".join(_BELOW_TWENTY[int(digit)] for digit in digits)


def _whole(number: int) -> str:
    if number < 20:
        return _BELOW_TWENTY[number]
    if number < 100:
        rest = f" {_BELOW_TWENTY[number % 10]}" if number % 10 else ""
        return _TENS[number // 10 - 2] + rest
    unit, name = next((unit, name) for unit, name in _UNITS if number >= unit)
    rest = f" {_whole(number % unit)}" if number % unit else ""
    return f"{_whole(number // unit)} {name}{rest}"


def _ordinal(said: str) -> str:
    before, _, last = said.rpartition(" ")
    ending = last[:-1] + "ieth" if last.endswith("y") else f"{last}th"
    return f"{before} {_ORDINALS.get(last, ending)}".strip()
