"""`hri face animate`: films a script of expressions, speech and gestures."""

from __future__ import annotations

import argparse
from functools import cache, partial
from pathlib import Path

from hri.cli.face.options import FACE, pixels
from hri.cli.face_film import FaceFilm
from hri.cli.voice.voice_options import PLAIN_VOICE, open_voice
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.face import load_face
from hri.face.scene import load_scene
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource_manager import ResourceManager

HELP = """\
The script is TOML: [[step]] by [[step]], each with `at` (seconds from the start), or `wait`
(seconds after the step above it, and after what that one says), or neither (together with it).
A step does any of these:

  express = "happy"        intensity = 0 to 1, duration = seconds until it fades
  say = "Hello there."     by espeak-ng; or sound = "hello.wav", with its text in `say` and, when
                           there are any, phonemes = "hello.json" as `hri say` writes them
  gaze = [0.5, 0.1]        -1 to 1: to the viewer's right, and up; or look_at = [x, y, z], meters
  gesture = "nod"          strength = 0 to 1.5, seconds = how long; or play = "take.csv", weights
                           as --csv writes them and as the app Live Link Face records them
  state = "listening"      "" ends it
  valence = 0.5            the mood, with arousal = -1 to 1
  weights = { blush = 1 }  targets that replace everything else; {} ends it

`duration` above the steps is the length of the movie in seconds. An example is
docs/samples/face/hello.toml.

  hri face animate docs/samples/face/hello.toml --out hello.mp4"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = HELP
    add = parser.add_argument
    add("script", type=Path, metavar="SCRIPT.toml")
    add("--face", default="robot", metavar="NAME", help=FACE)
    add("--voice", default=PLAIN_VOICE, help="voice of the texts (%(default)s)")
    add("--fps", type=float, default=30.0, metavar="N", help="frames per second (%(default)g)")
    add("--size", type=pixels, default=(640, 480), metavar="WxH", help="in pixels")
    add("--seed", type=int, default=0, metavar="N", help="seed of the idle motion")
    add("--captions", action="store_true", help="show captions below the face")
    add("--wav", type=Path, metavar="FILE", help="also write the speech here")
    add("--csv", type=Path, metavar="FILE", help="also write the weights of all frames here")
    add("--out", required=True, type=Path, metavar="FILE", help=".mp4, .webp or .gif")


def run(options: argparse.Namespace) -> int:
    model = load_face(options.face)
    with ResourceManager((), RealClock()) as resources:
        # The usual voice, which is always there, is opened only where something is said.
        voice = cache(partial(open_voice, resources, options.voice))
        if options.voice != PLAIN_VOICE:
            voice()
        scene = load_scene(options.script, model, lambda text: voice().synthesize(text))
    if options.wav is not None:
        sound = scene.sound()
        if sound is None:
            raise HriError(f"{options.wav}: {options.script} has no speech - leave out --wav")
        write_wav(options.wav, *sound)
    film = FaceFilm(options.fps, options.size, options.seed, options.captions, options.csv)
    film.shoot(scene, model, options.out, options.wav)
    return 0
