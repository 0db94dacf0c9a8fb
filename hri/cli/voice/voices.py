"""`hri voices`: lists the voices."""

from __future__ import annotations

import argparse
import importlib.util
import json
import sys
import textwrap
from collections.abc import Iterable
from dataclasses import asdict, dataclass

from hri.core.errors import HriError, did_you_mean
from hri.speech.synthesizers.espeak_library import load_espeak
from hri.speech.synthesizers.natural import HEART
from hri.speech.synthesizers.pyttsx3 import platform_voices

VARIANT = "+"
"""Language of a variant, which speaks any."""
WIDTH = 96
"""Width of a line of variants."""


@dataclass(frozen=True)
class Listed:
    """A voice as this command shows it."""

    voice: str
    """Value for the option `voice`."""
    name: str
    language: str
    gender: str
    """"male", "female", or empty where it is not known."""
    driver: str
    """The device type that speaks with it."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        "A voice of Hri.EspeakVoice can have a variant, another speaker of the same language:"
        " en-us+f3. The variants are listed last; in JSON their language is +."
    )
    add = parser.add_argument
    add("--language", metavar="L", help="only voices of a language, such as en or english")
    add("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when there is no voice of the language."""
    voices = all_voices()
    if options.language:
        voices = of_language(voices, options.language)
    if options.json:
        print(json.dumps([asdict(voice) for voice in voices], indent=1))
    else:
        print(_told(voices))
    return 0


def all_voices() -> list[Listed]:
    """The natural voice, those of espeak-ng and of the platform, then the variants."""
    library = load_espeak()
    found = [Listed(HEART, "English (America), natural", "en-us", "female", "Hri.NaturalVoice")]
    if importlib.util.find_spec("hibari") is None:
        found.clear()
    found += [Listed(v.id, v.name, v.id, v.gender, "Hri.EspeakVoice") for v in library.voices()]
    try:
        platform = platform_voices()
    except HriError as error:
        print(error, file=sys.stderr)
        platform = ()
    found += [Listed(v.id, v.name, v.language, v.gender, "Hri.Pyttsx3Voice") for v in platform]
    variants = sorted(library.variants(), key=lambda variant: variant.id.casefold())
    return found + [
        Listed(f"+{v.id}", v.name, VARIANT, v.gender, "Hri.EspeakVoice") for v in variants
    ]


def of_language(voices: Iterable[Listed], language: str) -> list[Listed]:
    """The voices of "en" or "English", en-us among them, and the variants.

    Raises HriError without any.
    """
    wanted = language.casefold().replace("_", "-")
    voices = list(voices)
    fitting = [
        voice
        for voice in voices
        if f"{voice.language.casefold()}-".startswith(f"{wanted}-") or wanted == _tongue(voice)
    ]
    if not fitting:
        known = {_tongue(voice) for voice in voices if voice.language != VARIANT}
        remedy = did_you_mean(wanted, known, "`hri voices` lists all")
        raise HriError(f'no voice speaks "{language}" - {remedy}')
    return fitting + [voice for voice in voices if voice.language == VARIANT]


def _tongue(voice: Listed) -> str:
    """The language in words: "english" of English (America)."""
    return voice.name.casefold().partition(" (")[0]


def _told(voices: Iterable[Listed]) -> str:
    """The voices as a table, and the variants in lines."""
    voices = list(voices)
    variants = [voice.voice for voice in voices if voice.language == VARIANT]
    table = _table(voice for voice in voices if voice.language != VARIANT)
    behind = textwrap.fill(" ".join(variants), WIDTH, break_on_hyphens=False)
    return f"{table}\n\nvariants, appended to a voice, such as en-us+f3:\n{behind}"


def _table(voices: Iterable[Listed]) -> str:
    rows = [("voice", "name", "gender", "device type")]
    rows += [(v.voice, v.name, v.gender or "-", v.driver) for v in voices]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join(lines)
