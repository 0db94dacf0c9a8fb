"""Kinds of arguments on the command line: what is none of them is refused before any work."""

from __future__ import annotations

import argparse
import math


def count(text: str) -> int:
    """A number of things, 1 or more."""
    if not text.isdecimal() or not int(text):
        raise argparse.ArgumentTypeError(f"{text} - write a number, 1 or more")
    return int(text)


def share(text: str) -> float:
    """A number from 0 to 1."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"{text} - write a number from 0 to 1")
    return value


def legible(text: str) -> str:
    """A text that can be printed: bytes that are none become a sign that no word holds."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
