"""`hri voices`: the voices that can be chosen, and how."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterable
from dataclasses import asdict, dataclass

from hri.core.errors import HriError, did_you_mean
from hri.speech.synthesizers.espeak_library import load_espeak
from hri.speech.synthesizers.pyttsx3 import platform_voices


@dataclass(frozen=True)
class Listed:
    """A voice as this command shows it."""

    voice: str
    """What to give as `voice`."""
    name: str
    language: str
    gender: str
    """"male", "female", or empty where it is not known."""
    driver: str
    """The device type that speaks with it."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        "A voice of Hri.EspeakVoice can be given a variant, another speaker of the same language:"
        " en-us+f3. Those are listed last, with the language +."
    )
    parser.add_argument("--language", metavar="L", help="only voices of a language, such as en")
    parser.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when there is no voice of the language."""
    voices = all_voices()
    if options.language:
        voices = of_language(voices, options.language)
    if options.json:
        print(json.dumps([asdict(voice) for voice in voices], indent=1))
    else:
        print(_table(voices))
    return 0


def all_voices() -> list[Listed]:
    """The voices of espeak-ng, those of the platform, then the variants."""
    library = load_espeak()
    found = [Listed(v.id, v.name, v.id, v.gender, "Hri.EspeakVoice") for v in library.voices()]
    try:
        platform = platform_voices()
    except HriError as error:
        print(error, file=sys.stderr)
        platform = ()
    found += [Listed(v.id, v.name, v.language, v.gender, "Hri.Pyttsx3Voice") for v in platform]
    variants = sorted(library.variants(), key=lambda variant: variant.id.casefold())
    return found + [Listed(f"+{v.id}", v.name, "+", v.gender, "Hri.EspeakVoice") for v in variants]


def of_language(voices: Iterable[Listed], language: str) -> list[Listed]:
    """The voices of "en", en-us among them, and the variants. Raises HriError without any."""
    wanted = language.lower().replace("_", "-")
    voices = list(voices)
    fitting = [v for v in voices if f"{v.language.lower()}-".startswith(f"{wanted}-")]
    if not fitting:
        known = {voice.language for voice in voices} - {"+"}
        remedy = did_you_mean(wanted, known, "`hri voices` lists all")
        raise HriError(f'no voice speaks "{language}" - {remedy}')
    return fitting + [voice for voice in voices if voice.language == "+"]


def _table(voices: Iterable[Listed]) -> str:
    rows = [("voice", "name", "gender", "device type")]
    rows += [(v.voice, v.name, v.gender or "-", v.driver) for v in voices]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join(lines)
