"""Words of the command line as text that can be printed."""

from __future__ import annotations


def legible(text: str) -> str:
    """A printable text: undecodable bytes become a replacement sign that no word contains."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
