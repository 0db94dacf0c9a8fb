"""Words of the command line as text that can be printed."""

from __future__ import annotations


def legible(text: str) -> str:
    """A text that can be printed: bytes that are none become a sign that no word holds."""
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
