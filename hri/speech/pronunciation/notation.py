"""Text as people write it, as it is read aloud: addresses, telephone numbers, measures, fractions.

What is not here (plain numbers, prices, times, titles, Roman numerals, most units) voices read by
themselves.
"""

from __future__ import annotations

import re
from collections.abc import Callable

_MONTHS = (
    "January", "February", "March", "April", "May", "June", "July", "August", "September",
    "October", "November", "December",
)  # fmt: skip
_SIGNS = {
    ".": "dot", "@": "at", "/": "slash", "-": "dash", "_": "underscore", "?": "question mark",
    "=": "equals", "&": "and", "#": "hash", ":": "colon", "+": "plus", "%": "percent", "~": "tilde",
}  # fmt: skip
_UNITS = {
    "m/s": "meters per second", "m/s²": "meters per second squared", "m": "meters", "V": "volts",
    "W": "watts", "mph": "miles per hour", "rpm": "revolutions per minute", "dB": "decibels",
    "kWh": "kilowatt hours", "mAh": "milliampere hours", "fps": "frames per second",
}  # fmt: skip
_PARTS = {"1/2": "a half", "½": "a half", "1/4": "a quarter", "¼": "a quarter",
          "3/4": "three quarters", "¾": "three quarters"}  # fmt: skip
_SCHEME = re.compile(r"https?://")
_GOES_ON = re.compile(
    r"(?i)\b(?:jan|feb|mar|apr|jun|jul|aug|sept?|oct|nov|dec|no|nos|approx|ver|fig|vol|ch|pp?|ext"
    r"|tel|sec|art|ca|c)\.$"
)
"""Abbreviations before a number, which end no sentence."""


def goes_on(before: str, after: str) -> bool:
    """Whether two parts of a text, parted at a period, are one sentence: "Nov." and "24"."""
    return after[:1].isdigit() and _GOES_ON.search(before[-12:]) is not None


def read_aloud(text: str) -> str:
    """The text with what is here in words; everything else as it stands."""
    for pattern, words in _RULES:
        text = pattern.sub(words, text)
    return text


def _address(match: re.Match[str]) -> str:
    signs = (f" {_SIGNS[c]} " if c in _SIGNS else c for c in _SCHEME.sub("", match[0]))
    return " ".join("".join(signs).replace("www", "w w w").split())


def _telephone(match: re.Match[str]) -> str:
    groups = [" ".join(group) for group in re.findall(r"\d+", match[0])]
    return ("plus " if match[0].startswith("+") else "") + ", ".join(groups)


def _digits(match: re.Match[str]) -> str:
    return " ".join(match[0])


def _date(match: re.Match[str]) -> str:
    day, month = int(match[1]), int(match[2])
    if not (1 <= day <= 31 and 1 <= month <= 12):
        return match[0]
    return f"{_MONTHS[month - 1]} {day}, {match[3]}"


def _mixed(match: re.Match[str]) -> str:
    return f"{match[1]} and {_PARTS[match[2]]}"


def _measure(match: re.Match[str]) -> str:
    return f"{match[1]} {_UNITS[match[2]]}"


_ANY_UNIT = "|".join(map(re.escape, sorted(_UNITS, key=len, reverse=True)))
_ANY_PART = "|".join(map(re.escape, _PARTS))
_RULES: tuple[tuple[re.Pattern[str], str | Callable[[re.Match[str]], str]], ...] = (
    (re.compile(r"(?<![\w.+-])[\w.+-]++@[\w-]++(?:\.[\w-]++)+"), _address),
    (re.compile(r"(?:https?://|\bwww\.)[^\s<>\"']*[\w/]"), _address),
    (re.compile(r"(?<![\w.])[A-Za-z][\w-]++(?:\.[a-z][a-z0-9]{1,4})+(?![\w.]\w)\b"), _address),
    (re.compile(r"(?:\+\d{1,3}[ -]?)?(?:\(\d{3}\) ?|\b\d{3}[ -])\d{3}[ -]\d{4}\b"), _telephone),
    (re.compile(r"(?<![\w-])\d{3}-\d{4}(?![\w-])"), _telephone),
    (re.compile(r"\b(\d{1,2})\.(\d{1,2})\.(\d{4})\b"), _date),
    (re.compile(r"\b(\d{1,2})' ?(\d{1,2})\""), r"\1 feet \2 inches"),
    (re.compile(rf"(\d) ?({_ANY_UNIT})(?![\w/²'])"), _measure),
    (re.compile(rf"\b(\d++) ?({_ANY_PART})(?![\w/])"), _mixed),
    (re.compile(r"\b24/7\b"), "24 7"),
    (re.compile(r"\b([A-Za-z]{2,})/([A-Za-z]{2,})\b"), r"\1 \2"),
    (re.compile(r"#(?=\d)"), "number "),
    (re.compile(r"#(?=[A-Za-z])"), "hashtag "),
    (re.compile(r"~ ?(?=\d)"), "about "),
    (re.compile(r"(?<![\d.,:/-])\b0\d++(?![\d.,:/-]*\d)\b"), _digits),
)
