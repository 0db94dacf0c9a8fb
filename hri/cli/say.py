"""`hri say`: speak a text aloud, or into a WAV file."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

import trio

from hri.core.clock import RealClock
from hri.core.errors import LARGEST_FILE, AuthoringError, HriError, did_you_mean
from hri.core.signals import EmotionState, Prosody, Speech
from hri.emotion.display import felt_now, load_display
from hri.emotion.emotions import NAMES
from hri.hal.drivers.wav_file import write_wav
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description
from hri.speech.synthesizers.espeak import FASTEST, SLOWEST, EspeakVoice
from hri.speech.synthesizers.espeak_library import Setting

PATIENCE = 2.0
"""Seconds beyond the length of the speech after which a speaker is given up."""
DECIMALS = 4
"""Of the seconds in JSON."""
RATES = f"{SLOWEST} to {FASTEST}"
NO_FILE = Description("", "").place.path
"""Where mistakes of the command line are."""

HELP = """\
--phonemes writes one JSON object: "text", "rate" (samples a second), "duration" (seconds),
"phonemes" (each with the "name" that espeak-ng gives it, "start" and "duration" in seconds, and
whether it is "stressed"; names that begin with "_" are pauses), "words" and "sentences" (each with
"text", "position" in characters, "start" and "end" in seconds).

  hri say "Hello there."
  hri say "I have found it!" --emotion joy --wav found.wav --phonemes found.json
  echo "One text from a pipe." | hri say -"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = HELP
    add = parser.add_argument
    add("text", help='what to say, in quotes; "-" reads it from standard input')
    add("--voice", default=Setting().voice, help="a voice such as en-gb or en-us+f3 (%(default)s)")
    add("--rate", type=int, metavar="WPM", help=f"words a minute, {RATES} ({Setting().rate})")
    add("--emotion", metavar="E", help=f"how it sounds: neutral, {', '.join(NAMES)}, or happy, ...")
    add("--intensity", type=float, default=1.0, metavar="X", help="of the emotion, 0 to 1")
    add("--wav", type=Path, metavar="FILE", help="write the sound there, play nothing")
    add("--phonemes", type=Path, metavar="FILE", help="write the times there as JSON, likewise")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when something of it cannot be done."""
    check(options)
    resources = ResourceManager((), RealClock())
    try:
        speech = _synthesize(resources, options)
        if options.phonemes is not None:
            _write(options.phonemes, json.dumps(times_of(speech), indent=1) + "\n")
        if options.wav is not None:
            write_wav(options.wav, speech.samples, speech.rate)
        if options.wav is None and options.phonemes is None:
            trio.run(_play, resources, speech)
    except AuthoringError as error:
        if error.place.path != NO_FILE:
            raise
        print(f"hri say: {error.what} - {error.remedy}", file=sys.stderr)
        return 2
    finally:
        resources.close()
    return 0


def check(options: argparse.Namespace) -> None:
    """Refuse what cannot be meant. Raises HriError."""
    if options.rate is not None and not SLOWEST <= options.rate <= FASTEST:
        raise HriError(f"--rate {options.rate} - give words a minute, {RATES}")
    if not 0 <= options.intensity <= 1:
        raise HriError(f"--intensity {options.intensity:g} - give one from 0 to 1")
    if options.wav is not None and options.wav.suffix.lower() not in ("", ".wav"):
        remedy = f"name it {options.wav.with_suffix('.wav').name}"
        raise HriError(f"{options.wav}: only WAV is written - {remedy}")


def _synthesize(resources: ResourceManager, options: argparse.Namespace) -> Speech:
    prosody = prosody_of(options.emotion, options.intensity) if options.emotion else Prosody()
    text = sys.stdin.read(LARGEST_FILE) if options.text == "-" else options.text
    if not text.strip():
        raise HriError("there is nothing to say - give some words")
    parameters = {"voice": options.voice}
    if options.rate is not None:
        parameters["rate_wpm"] = str(options.rate)
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice", parameters), resources)
    resources.substitute("voice", voice)
    voice.activate()
    return voice.synthesize(text, prosody)


def prosody_of(feeling: str, intensity: float) -> Prosody:
    """How the voice of a robot in a neutral mood shows an emotion ("joy" or "happy"), 0 to 1.

    Raises HriError when there is no such emotion.
    """
    if feeling == "neutral":
        return Prosody()
    display = load_display()
    names = {display.looks[name].words: name for name in NAMES} | {name: name for name in NAMES}
    emotion = names.get(feeling)
    if emotion is None:
        raise HriError(f'no emotion "{feeling}" - {did_you_mean(feeling, names)}')
    state = EmotionState(emotion, intensity, 0.0, 0.0, 0.0, {emotion: intensity})
    return display.prosody(felt_now(state))


def times_of(speech: Speech) -> dict[str, Any]:
    """The speech without its samples, as it is written to JSON; see HELP."""
    return {
        "text": speech.text,
        "rate": speech.rate,
        "duration": round(speech.duration, DECIMALS),
        "phonemes": [_rounded(asdict(phoneme)) for phoneme in speech.phonemes],
        "words": [_rounded(asdict(word)) for word in speech.words],
        "sentences": [_rounded(asdict(sentence)) for sentence in speech.sentences],
    }


def _rounded(fields: dict[str, Any]) -> dict[str, Any]:
    return {
        name: round(value, DECIMALS) if isinstance(value, float) else value
        for name, value in fields.items()
    }


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{path}: cannot be written: {reason} - check the folder") from error


async def _play(resources: ResourceManager, speech: Speech) -> None:
    from hri.hal.drivers.sound_card import SoundCardSpeaker

    speaker = SoundCardSpeaker(Description("speaker", "Hri.Speaker"), resources)
    resources.substitute("speaker", speaker)
    speaker.activate()
    now = resources.clock.now
    speaker.play(speech.samples, speech.rate, now())
    with trio.move_on_after(speech.duration + PATIENCE):
        while speaker.position(now()) is not None:  # noqa: ASYNC110 - it can only be asked
            await trio.sleep(0.02)
        await trio.sleep(speaker.latency)
