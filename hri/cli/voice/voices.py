"""`hri voices`: lists the voices, and lets them speak."""

from __future__ import annotations

import argparse
import importlib.util
import json
import sys
import textwrap
import time
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import trio

from hri.cli.voice.say import play
from hri.cli.voice.voice_options import open_voice
from hri.core.clock import RealClock
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report
from hri.core.signals import Prosody, Speech
from hri.hal.drivers.resampling import resample
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Skill, Synthesizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.espeak_library import Setting, load_espeak
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.synthesizers.pyttsx3 import Pyttsx3Voice, platform_voices
from hri.speech.synthesizers.voice_names import CHARACTERS, HEART, tongue, unknown, voice_named

VARIANT = "+"
"""Language of a variant, which speaks any."""
VOICES: dict[str, type[Synthesizer]] = {
    "Hri.NaturalVoice": NaturalVoice,
    "Hri.EspeakVoice": EspeakVoice,
    "Hri.Pyttsx3Voice": Pyttsx3Voice,
}
"""What speaks, by device type."""
PLAIN_ESPEAK = Setting().voice
SAMPLE = "Hello! It is good to see you. This is how I sound."
COUNTING = "1, 2, 3, 4, 5, 6, 7."
"""What any language can read."""
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
    character: str = ""
    """Another name for it, by how it sounds."""
    license: str = ""
    size_mb: float | None = None
    """Megabytes of the files of its device type; None where they are not known."""
    speed: float | None = None
    """Seconds of sound that are made in a second, of its device type."""
    cannot: tuple[str, ...] = ()
    """What of a feeling it leaves out."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        "A voice of Hri.EspeakVoice can have a variant, another speaker of the same language:"
        " en-us+f3. The variants are listed last; in JSON their language is +."
    )
    add = parser.add_argument
    add("--language", metavar="L", help="only voices of a language, such as en or english")
    add("--json", action="store_true", help="print JSON")
    play = "let these speak: names, languages such as german, or characters"
    add("--play", nargs="+", metavar="VOICE", default=[], help=play)
    add("--out", type=Path, metavar="FILE", help="write what they say as WAV instead of playing it")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when there is no voice of the language."""
    if options.play:
        return _speak(options.play, options.out)
    voices = all_voices()
    if options.language:
        voices = of_language(voices, options.language)
    if options.json:
        print(json.dumps([asdict(voice) for voice in voices], indent=1))
    else:
        for line in _told(voices).split("\n"):
            report(line)
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
    found += [Listed(f"+{v.id}", v.name, VARIANT, v.gender, "Hri.EspeakVoice") for v in variants]
    engines = {name: engine_of(name) for name in dict.fromkeys(one.driver for one in found)}
    named = {character.voice: name for name, character in CHARACTERS.items()}
    return [
        replace(one, character=named.get(one.voice, ""), **engines[one.driver]) for one in found
    ]


def engine_of(driver: str) -> dict[str, Any]:
    """License, size and speed of a device type that speaks, and the skills that it lacks."""
    kind = VOICES[driver]
    cannot = tuple(skill.value for skill in Skill if skill not in kind.skills)
    licenses = {"Hri.NaturalVoice": "Apache-2.0", "Hri.EspeakVoice": "GPL-3.0-or-later"}
    if driver not in licenses:
        return {"license": "the system's", "cannot": cannot}
    package = {"Hri.NaturalVoice": "hibari-tts", "Hri.EspeakVoice": "espeakng-loader"}[driver]
    name = {"Hri.NaturalVoice": HEART, "Hri.EspeakVoice": PLAIN_ESPEAK}[driver]
    with ResourceManager((), RealClock(), notice=_complain) as resources:
        voice = open_voice(resources, name)
        voice.synthesize(COUNTING)  # what is said again would come from memory
        begun = time.perf_counter()
        made = voice.synthesize(SAMPLE).duration
        speed = made / (time.perf_counter() - begun)
    known = {"license": licenses[driver], "size_mb": size_of(package), "speed": round(speed, 1)}
    return {**known, "cannot": cannot}


def size_of(package: str) -> float | None:
    """Megabytes of an installed package."""
    try:
        files = metadata.files(package) or ()
    except metadata.PackageNotFoundError:
        return None
    return round(sum(file.size or 0 for file in files) / 1e6, 1)


def _speak(names: Sequence[str], out: Path | None) -> int:
    """Let voices say one sentence after the other."""
    with ResourceManager((), RealClock(), notice=_complain) as resources:
        voice = open_voice(resources, HEART)
        parts = [_sample(voice, name) for name in names]
        rate = parts[0].rate
        pause = np.zeros(rate // 2, np.int16)
        sounds = [np.append(resample(part.samples, part.rate, rate), pause) for part in parts]
        speech = Speech(" ".join(names), np.concatenate(sounds), rate)
        if out is None:
            trio.run(play, resources, speech)
        else:
            write_wav(out, speech.samples, speech.rate)
    return 0


def _sample(voice: Synthesizer, name: str) -> Speech:
    """What a voice says to be heard; other languages count. Raises HriError for an unknown one."""
    meant = voice_named(name)
    if not meant:
        raise HriError(unknown(name))
    is_english = meant == HEART or meant.startswith("en")
    return voice.synthesize(SAMPLE if is_english else COUNTING, Prosody(voice=meant))


def _complain(line: str) -> None:
    report(f"hri voices: {line}", file=sys.stderr)


def of_language(voices: Iterable[Listed], language: str) -> list[Listed]:
    """The voices of "en" or "English", en-us among them, and the variants.

    Raises HriError without any.
    """
    wanted = language.casefold().replace("_", "-")
    voices = list(voices)
    fitting = [
        voice
        for voice in voices
        if f"{voice.language.casefold()}-".startswith(f"{wanted}-") or wanted == tongue(voice.name)
    ]
    if not fitting:
        known = {tongue(voice.name) for voice in voices if voice.language != VARIANT}
        remedy = did_you_mean(wanted, known, "`hri voices` lists all")
        raise HriError(f'no voice speaks "{language}" - {remedy}')
    return fitting + [voice for voice in voices if voice.language == VARIANT]


def _told(voices: Iterable[Listed]) -> str:
    """The voices as a table, and the variants in lines."""
    voices = list(voices)
    variants = [voice.voice for voice in voices if voice.language == VARIANT]
    table = _table(voice for voice in voices if voice.language != VARIANT)
    behind = textwrap.fill(" ".join(variants), WIDTH, break_on_hyphens=False)
    characters = "\n".join(f"  {n:<12}{c.voice:<18}{c.about}" for n, c in CHARACTERS.items())
    return (
        f"{table}\n\nvariants, appended to a voice, such as en-us+f3:\n{behind}\n\n"
        f"characters, which any voice may be asked for:\n{characters}\n\n{_engines(voices)}"
    )


def _engines(voices: Iterable[Listed]) -> str:
    """Size, license and speed of each device type, and what it leaves out."""
    rows = [("device type", "size", "license", "speed", "cannot")]
    for voice in {voice.driver: voice for voice in voices}.values():
        size = "-" if voice.size_mb is None else f"{voice.size_mb:.0f} MB"
        speed = "-" if voice.speed is None else f"{voice.speed:.0f} times real time"
        rows.append((voice.driver, size, voice.license, speed, ", ".join(voice.cannot) or "-"))
    return _columns(rows)


def _table(voices: Iterable[Listed]) -> str:
    rows = [("voice", "name", "gender", "device type")]
    rows += [(v.voice, v.name, v.gender or "-", v.driver) for v in voices]
    return _columns(rows)


def _columns(rows: Sequence[tuple[str, ...]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join(lines)
