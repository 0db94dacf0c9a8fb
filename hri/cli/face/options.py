"""Arguments shared by the commands of `hri face`."""

from __future__ import annotations

import argparse

from hri.core.errors import HriError

FACE = "from faces/, or a folder"
"""Help for --face."""


def share(text: str) -> tuple[str, float]:
    """`happy=0.5` as a name and a number, 1 when there is none. Raises HriError."""
    name, equals, number = text.partition("=")
    try:
        return name.strip(), float(number) if equals else 1.0
    except ValueError:
        raise HriError(f'"{text}": "{number}" is not a number - write {name}=0.5') from None


def pair(text: str) -> tuple[float, float]:
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(
            f'"{text}" - write two numbers, such as 0.5,-0.2'
        ) from None
    return x, y


def pixels(text: str) -> tuple[int, int]:
    try:
        width, height = (int(part) for part in text.lower().split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError(f'"{text}" - write pixels, such as 640x480') from None
    return width, height
