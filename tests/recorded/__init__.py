"""Where recordings and pictures of people are: a small set here, more beside the checkout.

`manifest.tsv` lists what is here, with what is in it, its source and its license; the texts of the
licenses lie beside it. Tests that need more read `../shared` and are skipped without it.
"""

from __future__ import annotations

import csv
from pathlib import Path

import cv2
import pytest

from hri.core.signals import Image, Samples
from hri.hal.drivers.wav_file import load_sound

HERE = Path(__file__).parent
SHARED = HERE.parents[2] / "shared"
"""What may not be part of the project."""
BOOK = tuple(f"book_{number}" for number in (870, 880, 890, 920, 930))
"""Lines of a book, read aloud: no commands."""
ORDERS = tuple(path.stem for path in sorted((HERE / "speech").glob("order_*.flac")))
"""Orders of coffee, each by another person: no commands for a robot."""


def speech(name: str) -> Path:
    """A recording of somebody who speaks: mono, 16 bit, 16 kHz."""
    return HERE / "speech" / f"{name}.flac"


def spoken_by_a_person(name: str) -> Samples:
    """The samples of such a recording."""
    samples, rate = load_sound(speech(name))
    assert rate == 16000
    return samples


def picture(name: str) -> Image:
    """A photograph, 8-bit RGB."""
    return cv2.cvtColor(cv2.imread(str(HERE / "pictures" / f"{name}.jpg")), cv2.COLOR_BGR2RGB)


def manifest() -> list[dict[str, str]]:
    """The rows of `manifest.tsv`."""
    with (HERE / "manifest.tsv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))


def needs_shared(path: str) -> pytest.MarkDecorator:
    """Skips a test, or the tests of a module, without this file or folder of `../shared`."""
    return pytest.mark.skipif(not (SHARED / path).exists(), reason=f"needs ../shared/{path}")
