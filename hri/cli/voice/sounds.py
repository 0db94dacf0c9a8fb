"""`hri sounds`: lists the sounds that are not words, checks their file, and makes them."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import trio

from hri.cli.voice.say import play
from hri.cli.voice.voice_options import open_voice
from hri.core.clock import RealClock
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report
from hri.core.signals import Speech
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import WOMAN, VocalTract
from hri.speech.vocalizations.formant_synthesis import RATE
from hri.speech.vocalizations.in_text import SoundMark, parted
from hri.speech.vocalizations.vocalization import Vocalization, load_sounds

PAUSE_S = 0.4
"""Between one sound and the next."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = (
        "The list has the name, the seconds, the gesture of the face that makes the sound, and what"
        " it is.\nReplies, `hri say` and scripts make one by its name in brackets; soft or strong,"
        " short or long\nmay follow.\n\n"
        "  hri sounds giggle 'sigh long'\n"
        "  hri sounds --file mine.toml --out heard.wav hiccup\n"
        '  hri say "[gasp] You scared me!"'
    )
    add = parser.add_argument
    add("names", nargs="*", metavar="SOUND", help="make these; without any, list all")
    add("--out", type=Path, metavar="FILE", help="write them as WAV instead of playing them")
    add("--voice", metavar="VOICE", help="whose: a voice, a language or a character (heart)")
    add("--file", type=Path, metavar="FILE", help="check and use this file of sounds")
    add("--json", action="store_true", help="print the list as JSON")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 for a file with a mistake, and for an unknown sound."""
    sounds = load_sounds(options.file)
    if not options.names and options.out is not None:
        raise HriError("--out has no sound to write - name one, such as giggle")
    if not options.names:
        _list(sounds, options.json)
        return 0
    marks = [_mark(name, sounds) for name in options.names]
    with ResourceManager((), RealClock(), notice=_complain) as resources:
        tract = open_voice(resources, options.voice).tract("") if options.voice else WOMAN
        speech = _together([_made(mark, sounds, tract) for mark in marks])
        if options.out is None:
            trio.run(play, resources, speech)
        else:
            write_wav(options.out, speech.samples, speech.rate)
    return 0


def _mark(name: str, sounds: Mapping[str, Vocalization]) -> SoundMark:
    """A sound by its name, "sigh long" or "[sigh long]"."""
    text = f"[{name.strip('[]')}]"
    found = next(parted(text, sounds), None)
    if not isinstance(found, SoundMark):
        raise HriError(
            f'no sound "{name}" - {did_you_mean(name.strip("[] ").partition(" ")[0], sounds)}'
        )
    return found


def _made(mark: SoundMark, sounds: Mapping[str, Vocalization], tract: VocalTract) -> Speech:
    return sounds[mark.name].speech(tract, mark.strength, mark.length)


def _together(speeches: Sequence[Speech]) -> Speech:
    pause = np.zeros(round(PAUSE_S * RATE), np.int16)
    samples = [part for speech in speeches for part in (speech.samples, pause)]
    return Speech(" ".join(speech.text for speech in speeches), np.concatenate(samples), RATE)


def _list(sounds: Mapping[str, Vocalization], as_json: bool) -> None:
    seconds = {name: sum(part.ms for part in sound.parts) / 1000 for name, sound in sounds.items()}
    if as_json:
        rows = [
            {"name": name, "seconds": seconds[name], "gesture": sound.gesture, "about": sound.about}
            for name, sound in sounds.items()
        ]
        print(json.dumps(rows, indent=1))
        return
    width = max(map(len, sounds))
    for name, sound in sounds.items():
        gesture = sound.gesture or "-"
        report(f"{name:<{width}}  {seconds[name]:4.1f} s  {gesture:<8}  {sound.about}")


def _complain(line: str) -> None:
    report(f"hri sounds: {line}", file=sys.stderr)
