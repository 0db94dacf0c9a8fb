"""Numbers in digits, as they are said: what an author may write instead of "10"."""

from __future__ import annotations

import re

LONGEST = 6
"""Digits; a longer number is said digit by digit."""

_BELOW_TWENTY = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
    "nineteen",
)
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
_NUMBER = re.compile(r"([0-9]+)(?:\.([0-9]+))?")


def in_words(text: str) -> str:
    """The text with its numbers in words: "10" is "ten", "2.5" is "two point five".

    The words are those that `grammars/numbers.jsgf` understands.
    """
    return " ".join(_NUMBER.sub(_spelt, text).split())


def _spelt(match: re.Match[str]) -> str:
    whole, decimals = match.groups()
    is_code = len(whole) > LONGEST or (whole[0] == "0" and len(whole) > 1)
    said = _digits(whole) if is_code else _whole(int(whole))
    return f" {said} point {_digits(decimals)} " if decimals else f" {said} "


def _digits(digits: str) -> str:
    return " ".join(_BELOW_TWENTY[int(digit)] for digit in digits)


def _whole(number: int) -> str:
    if number < 20:
        return _BELOW_TWENTY[number]
    if number < 100:
        rest = f" {_BELOW_TWENTY[number % 10]}" if number % 10 else ""
        return _TENS[number // 10 - 2] + rest
    unit, name = (1000, "thousand") if number >= 1000 else (100, "hundred")
    rest = f" {_whole(number % unit)}" if number % unit else ""
    return f"{_whole(number // unit)} {name}{rest}"
