"""`hri say`: speak a text aloud, or into a WAV file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import trio

from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.signals import Speech
from hri.hal.drivers.wav_file import write_wav
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description
from hri.speech.synthesizers.espeak import EspeakVoice

PATIENCE = 2.0
"""Seconds beyond the length of the speech after which a speaker is given up."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("text", help="what to say, in quotes")
    parser.add_argument("--wav", type=Path, metavar="FILE", help="write it there, play nothing")
    parser.add_argument("--voice", default="en-us", help="a voice such as en-gb or en-us+f3")


def run(options: argparse.Namespace) -> int:
    resources = ResourceManager((), RealClock())
    try:
        speech = _synthesize(resources, options)
        if options.wav is not None:
            write_wav(options.wav, speech.samples, speech.rate)
        else:
            trio.run(_play, resources, speech)
    except HriError as error:
        print(error, file=sys.stderr)
        return 2
    finally:
        resources.close()
    return 0


def _synthesize(resources: ResourceManager, options: argparse.Namespace) -> Speech:
    parameters = {"voice": options.voice}
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice", parameters), resources)
    resources.substitute("voice", voice)
    voice.activate()
    return voice.synthesize(options.text)


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
