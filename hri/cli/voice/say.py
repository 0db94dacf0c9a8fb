"""`hri say`: speak a text aloud, or into a WAV file."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import trio

from hri.cli.face_film import FaceFilm
from hri.cli.voice.voice_options import NO_FILE, PLAIN_VOICE, open_voice
from hri.core.clock import RealClock
from hri.core.errors import AuthoringError, HriError, did_you_mean
from hri.core.quoting import report
from hri.core.reading import LARGEST_FILE
from hri.core.signals import EmotionState, Expression, Prosody, Speech
from hri.core.writing import write_text
from hri.emotion.display import load_display
from hri.emotion.emotions import NAMES
from hri.face import load_face
from hri.face.lips.lipsync import PhonemeTrack
from hri.face.lips.loudness import Loudness
from hri.face.lips.phonemes import Alphabet
from hri.face.lips.spans import ARTICULATORS
from hri.face.scene import scene_of
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.ssml import Ssml, is_ssml, spoken
from hri.speech.synthesizers.espeak import FASTEST, LONGEST_TEXT, SLOWEST
from hri.speech.vocalizations.in_text import has_sounds

STANDARD_OUTPUT = Path("-")
PATIENCE = 2.0
"""Seconds beyond the length of the speech after which waiting for the speaker ends."""
FRAMES = 30
"""Frames per second of the weights in JSON."""
DECIMALS = 4
"""Decimals of seconds in JSON."""
RATES = f"{SLOWEST} to {FASTEST}"

HELP = """\
--phonemes writes one JSON object: "text", "rate" (samples a second), "duration" (seconds),
"alphabet" ("espeak"), "phonemes" (each with the "name" that espeak-ng has for it, "start" and
"duration" in seconds, and whether it is "stressed"; names that begin with "_" are pauses), "words"
and "sentences" (each with "text", "position" in characters, "start" and "end" in seconds), "marks"
(of SSML, each with "name" and "time").

--visemes also writes one JSON object: "text", "duration", "visemes" (the mouth shapes, each with
"viseme" by its Oculus name, "start" and "end" in seconds and "strength", 0 to 1; sounds too short
to be seen have none), "rate" (frames a second) and "frames" (each with the "time" in seconds, the
weights, 0 to 1.2, of the visemes of "lips", "jaw" and "tongue", and the "emphasis", 0 to 1, that
lifts the brows).

  hri say "Hello there."
  hri say "Good evening." --voice en-gb
  hri say "I have found it!" --emotion joy --wav found.wav --phonemes found.json
  hri say "I am so happy." --emotion joy --face-video happy.mp4 --visemes happy.json
  hri say '<speak>It is <emphasis>very</emphasis> late.<break time="1s"/> Good night.</speak>'
  echo "One text from a pipe." | hri say -"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = HELP
    add = parser.add_argument
    add("text", help='what to say, in quotes; "-" reads it from standard input')
    add(
        "--voice",
        default=PLAIN_VOICE,
        help="a voice, a language or a character: en-gb, german, robot, ... (%(default)s)",
    )
    add("--rate", type=int, metavar="WPM", help=f"words a minute, {RATES}")
    add(
        "--emotion",
        metavar="E",
        help=f"emotion: neutral, {', '.join(NAMES)}, or happy, ...",
    )
    markup = "the text is SSML; a text that begins with <speak> or <?xml is, too"
    add("--ssml", action="store_true", help=markup)
    add("--intensity", type=float, default=1.0, metavar="X", help="of the emotion, 0 to 1")
    add("--wav", type=Path, metavar="FILE", help="write the sound there instead of playing it")
    times = 'write the times as JSON instead of playing; "-" is standard output'
    add("--phonemes", type=Path, metavar="FILE", help=times)
    video = "film a face that says it instead of playing: .mp4, .webp or .gif"
    add("--face-video", type=Path, metavar="FILE", help=video)
    add(
        "--visemes",
        type=Path,
        metavar="FILE",
        help="write the mouth shapes as JSON instead of playing",
    )
    add("--face", default="robot", metavar="NAME", help="the face, from faces/ (%(default)s)")
    add("--captions", action="store_true", help="show captions below the face")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when a part of it fails."""
    check(options)
    resources = ResourceManager((), RealClock(), notice=_complain)
    try:
        speech = _synthesize(resources, options)
        if not _written(speech, options):
            trio.run(play, resources, speech)
    except AuthoringError as error:
        if error.place.path != NO_FILE:
            raise
        report(f"hri say: {error.what} - {error.remedy}", file=sys.stderr)
        return 2
    finally:
        resources.close()
    return 0


def _complain(line: str) -> None:
    report(f"hri say: {line}", file=sys.stderr)


def _written(speech: Speech, options: argparse.Namespace) -> bool:
    """Write the requested files; whether there were any."""
    if options.phonemes is not None:
        write_json(options.phonemes, times_of(speech))
    if options.visemes is not None:
        write_json(options.visemes, visemes_of(speech))
    if options.wav is not None:
        write_wav(options.wav, speech.samples, speech.rate)
    if options.face_video is not None:
        scene = scene_of(speech, expression_of(options.emotion, options.intensity))
        film = FaceFilm(captions=options.captions)
        film.shoot(scene, load_face(options.face), options.face_video, options.wav)
    files = (options.phonemes, options.visemes, options.wav, options.face_video)
    return any(file is not None for file in files)


def write_json(path: Path, what: Mapping[str, Any]) -> None:
    """Write an object to a file, or to standard output for "-"."""
    text = json.dumps(what, indent=1) + "\n"
    if path == STANDARD_OUTPUT:
        sys.stdout.write(text)
    else:
        write_text(path, text)


def check(options: argparse.Namespace) -> None:
    """Refuse options out of range. Raises HriError."""
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
        raise HriError("empty text - give some words")
    is_markup = options.ssml or is_ssml(text)
    if len(text) > LONGEST_TEXT and not is_markup:
        told = f"only the first {LONGEST_TEXT} characters of {len(text)} are spoken"
        report(f"{told} - say it in parts", file=sys.stderr)
    voice = open_voice(resources, options.voice, options.rate)
    if not is_markup and not has_sounds(text):
        return voice.synthesize(text, prosody)
    document = Ssml.parse(text) if is_markup else Ssml.of_text(text)
    return spoken(document, voice, prosody, lambda speech: None, lambda: True)


def prosody_of(feeling: str, intensity: float) -> Prosody:
    """The prosody of an emotion ("joy" or "happy"), 0 to 1, for a neutral mood. Raises HriError for
    an unknown emotion.
    """
    state = _feeling(feeling, intensity)
    return Prosody() if state is None else load_display().prosody(state)


def expression_of(feeling: str | None, intensity: float) -> Expression:
    """The expression of the face for it, likewise."""
    state = _feeling(feeling or "neutral", intensity)
    return Expression() if state is None else load_display().expression(state)


def _feeling(name: str, intensity: float) -> EmotionState | None:
    """A neutral mood with one emotion; None for "neutral"."""
    if name == "neutral":
        return None
    looks = load_display().looks
    names = {looks[emotion].words: emotion for emotion in NAMES} | {name: name for name in NAMES}
    if name not in names:
        raise HriError(f'no emotion "{name}" - {did_you_mean(name, names)}')
    emotion = names[name]
    return EmotionState(emotion, intensity, 0.0, 0.0, 0.0, {emotion: intensity})


def times_of(speech: Speech) -> dict[str, Any]:
    """The speech without its samples, as it is written to JSON; see HELP."""
    return {
        "text": speech.text,
        "rate": speech.rate,
        "duration": round(speech.duration, DECIMALS),
        "alphabet": Alphabet.ESPEAK,
        "phonemes": [_rounded(asdict(phoneme)) for phoneme in speech.phonemes],
        "words": [_rounded(asdict(word)) for word in speech.words],
        "sentences": [_rounded(asdict(sentence)) for sentence in speech.sentences],
        "marks": [{"name": name, "time": round(time, DECIMALS)} for name, time in speech.marks],
    }


def visemes_of(speech: Speech) -> dict[str, Any]:
    """The mouth shapes of a speech with phonemes, as written to JSON; see HELP."""
    track = PhonemeTrack(speech.phonemes, Loudness(speech.samples, speech.rate))
    segments = (segment for segment in track.segments if segment.viseme != "sil")
    return {
        "text": speech.text,
        "duration": round(speech.duration, DECIMALS),
        "visemes": [
            {
                "viseme": segment.viseme,
                "start": round(segment.start, DECIMALS),
                "end": round(segment.end, DECIMALS),
                "strength": round(segment.strength, DECIMALS),
            }
            for segment in segments
        ],
        "rate": FRAMES,
        "frames": [
            _frame(track, number / FRAMES) for number in range(round(speech.duration * FRAMES) + 1)
        ],
    }


def _frame(track: PhonemeTrack, time: float) -> dict[str, Any]:
    regions = {name: _rounded(track.weights(time, name)) for name in ARTICULATORS}
    emphasis = round(track.emphasis(time), DECIMALS)
    return {"time": round(time, DECIMALS), **regions, "emphasis": emphasis}


def _rounded(fields: Mapping[str, Any]) -> dict[str, Any]:
    return {
        name: round(value, DECIMALS) if isinstance(value, float) else value
        for name, value in fields.items()
    }


async def play(resources: ResourceManager, speech: Speech) -> None:
    """Play a speech to its end. Raises NotAvailable without a sound card."""
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
