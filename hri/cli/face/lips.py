"""`hri face lips`: films a face that moves its lips to a sound file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.cli.face.options import FACE, pixels
from hri.cli.face_film import FaceFilm
from hri.cli.voice.say import expression_of, times_of, visemes_of, write_json
from hri.core.errors import HriError
from hri.core.reading import LARGEST_FILE
from hri.core.signals import Speech
from hri.emotion.emotions import NAMES
from hri.face import load_face
from hri.face.scene import scene_of
from hri.hal.drivers.wav_file import load_sound
from hri.speech.aligner import with_times

HELP = """\
With --text, each sound of the words gets its time by forced alignment; English. Without it, the
lips follow the sounds that are heard, and in a song or in another language the loudness.
--phonemes and --visemes write JSON as `hri say` does.

  hri face lips song.wav --out song.mp4
  hri face lips hello.wav --text "Hello, nice to meet you." --out hello.mp4 --phonemes hello.json"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = HELP
    add = parser.add_argument
    add("sound", type=Path, metavar="SOUND", help="a WAV, MP3, FLAC or Ogg file")
    add("--text", default="", metavar="T", help='what it says; "-" reads it from standard input')
    add("--out", type=Path, metavar="FILE", help="the film: .mp4, .webp or .gif")
    add("--phonemes", type=Path, metavar="FILE", help='the times as JSON; "-": standard output')
    add("--visemes", type=Path, metavar="FILE", help="the mouth shapes as JSON")
    add("--face", default="robot", metavar="NAME", help=FACE)
    add("--emotion", metavar="E", help=f"what the face shows: neutral, {', '.join(NAMES)}")
    add("--fps", type=float, default=30.0, metavar="N", help="frames per second (%(default)g)")
    add("--size", type=pixels, default=(640, 480), metavar="WxH", help="in pixels")
    add("--captions", action="store_true", help="show captions below the face")


def run(options: argparse.Namespace) -> int:
    """Raises HriError when a file cannot be read or written, or the text is another one."""
    if not any((options.out, options.phonemes, options.visemes)):
        raise HriError("nothing to write - add --out FILE, --phonemes FILE or --visemes FILE")
    text = sys.stdin.read(LARGEST_FILE) if options.text == "-" else options.text
    samples, rate = load_sound(options.sound)
    try:
        speech = with_times(Speech(text.strip(), samples, rate))
    except HriError as error:
        raise HriError(f"{options.sound}: {error}") from error
    if options.phonemes is not None:
        write_json(options.phonemes, times_of(speech))
    if options.visemes is not None:
        write_json(options.visemes, visemes_of(speech))
    if options.out is not None:
        scene = scene_of(speech, expression_of(options.emotion, 1.0))
        film = FaceFilm(options.fps, options.size, captions=options.captions)
        film.shoot(scene, load_face(options.face), options.out, options.sound)
    return 0
