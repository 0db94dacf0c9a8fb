"""Addresses of mail and of the web, names of files, and paths."""

from __future__ import annotations

import re

from hri.speech.notation import number_words as say
from hri.speech.notation.abbreviations import SPELLED
from hri.speech.notation.rule import Match, Rule, Scan, rule

SIGNS = {
    ".": "dot", "@": "at", "/": "slash", "-": "dash", "_": "underscore", "?": "question mark",
    "=": "equals", "&": "and", "#": "hash", ":": "colon", "+": "plus", "%": "percent", "~": "tilde",
    "\\": "backslash",
}  # fmt: skip
_SCHEME = re.compile(r"(?:https?|ftp)://")
_PART = re.compile(r"[^\W\d_]+|\d+|.", re.DOTALL)


def spelled_out(address: str) -> str:
    """An address with its signs in words; parts that nobody could say are spelt."""
    parts = _PART.findall(_SCHEME.sub("", address).rstrip("/"))
    return " ".join(word for part in parts if (word := _part(part)))


def _part(part: str) -> str:
    if part.isdecimal():
        return say.number(part) if len(part) < 3 else say.in_pairs(part)
    if part.lower() in SPELLED and (part.islower() or part.isupper()):
        return SPELLED[part.lower()]
    if part[0].isalpha():
        is_speakable = len(part) > 3 or re.search(r"[aeiouyAEIOUY]", part)
        is_letter = len(part) == 1 or not is_speakable
        return " ".join(part.upper()) if is_letter else part
    return SIGNS.get(part, "")


def _said(match: Match, scan: Scan) -> str:
    return spelled_out(match[0])


def _port(match: Match, scan: Scan) -> str:
    return f"localhost colon {say.by_digits(match[1])}"


_FILE_ENDS = "|".join(
    sorted(
        (
            *SPELLED,
            "mp3",
            "mp4",
            "m4a",
            "7z",
            "h5",
            "com",
            "org",
            "net",
            "info",
            "dev",
            "app",
            "local",
            "me",
            "co",
            "biz",
            "museum",
            "online",
            "shop",
            "cloud",
            "tech",
        ),
        key=len,
        reverse=True,
    )
)
WEB: tuple[Rule, ...] = (
    rule(r"[\w.+-]{1,64}@[\w-]{1,63}(?:\.[\w-]{1,63}){1,6}(?<![.-])", _said),
    rule(r"(?:(?:https?|ftp)://|www\.)[^\s<>\"']{0,300}[\w/]", _said),
    rule(r"localhost:(\d{1,5})\b", _port),
    rule(
        rf"(?:[\w-]{{1,63}}\.){{1,6}}(?:{_FILE_ENDS})(?::\d{{1,5}})?(?:/[^\s<>\"',;]{{0,200}}[\w/])?(?![\w.]\w|\w)",
        _said,
    ),
)
NAMES: tuple[Rule, ...] = (
    rule(r"[A-Za-z][\w-]{0,62}(?:\.[a-z][a-z0-9]{1,20}){1,6}(?![\w.]\w|\w)", _said),
    rule(r"[A-Za-z]:\\[\w\\.-]{0,200}\w", _said),
    rule(r"[\w-]{1,60}(?:/[\w-]{1,60}){1,12}(?:\.[a-z][a-z0-9]{1,9}){1,3}(?!\w)", _said),
    rule(r"[\w-]{1,60}(?:/\w{1,60}){0,12}/\w{1,60}_[\w/]{1,60}(?!\w)", _said),
)
PATHS: tuple[Rule, ...] = (
    rule(r"(?<![\w.])[~.]{0,2}/[\w.-]{1,60}(?:/[\w.-]{1,60}){0,12}/?(?<!\.)", _said),
)
