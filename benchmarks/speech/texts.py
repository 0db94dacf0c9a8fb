"""Files of sentences, one a line, beside this one; a line that begins with # is a comment."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path


def lines(name: str) -> list[str]:
    """The sentences of a file, and its headings, without comments and empty lines."""
    text = Path(__file__).with_name(name).read_text(encoding="utf-8")
    return [line for line in text.splitlines() if line and not line.startswith("#")]


def blocks(name: str) -> Iterator[tuple[str, str]]:
    """The heading above each sentence of a file ("yes" for a line "yes:"), and the sentence."""
    heading = ""
    for line in lines(name):
        if line.endswith(":"):
            heading = line.removesuffix(":")
        else:
            yield heading, line
