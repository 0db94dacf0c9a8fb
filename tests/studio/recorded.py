"""Recordings as a robot makes them, for tests, small and quick to make."""

import json

import cv2
import numpy as np

from hri.core.recorded import EVENTS, FACE, SOUND, STARTED
from hri.hal.drivers.growing_movie import GrowingMovie
from hri.hal.drivers.wav_file import write_wav

RATE, SIZE = 30.0, (64, 48)


def film(path, count, is_killed=False):
    """A film of which each picture is as bright as its number, from 0 to 250."""
    movie = GrowingMovie(path, SIZE, RATE)
    for number in range(count):
        movie.write(np.full((*SIZE[::-1], 3), number % 250, np.uint8))
    movie._flush() if is_killed else movie.close()


def brightness(jpeg):
    return float(cv2.imdecode(np.frombuffer(jpeg, np.uint8), cv2.IMREAD_GRAYSCALE).mean())


def log(folder, *events):
    (folder / EVENTS).write_text("".join(json.dumps(event) + "\n" for event in events))


MINUTE = (
    {"t": 0.0, "event": STARTED, "face": 0.0, "sound": 0.0},
    {"t": 0.0, "event": "emotion.changed", "label": "calm",
     "valence": 0.0, "arousal": 0.0, "dominance": 0.0},
    {"t": 1.0, "event": "odometry", "x_cm": 0.0, "y_cm": 0.0, "heading_rad": 0.0},
    {"t": 4.0, "event": "speech.heard", "text": "hello robot", "confidence": 0.98,
     "start": 2.5, "end": 3.8},
    {"t": 4.5, "event": "speech.said", "text": "Hello!"},
    {"t": 5.5, "event": "speech.finished", "text": "Hello!"},
    {"t": 12.0, "event": "speech.rejected", "reason": "noise", "text": "", "detail": ""},
    {"t": 20.0, "event": "head.nodded", "person": "p1", "confidence": 0.9},
    {"t": 30.0, "event": "emotion.changed", "label": "fear",
     "valence": -0.4, "arousal": 0.6, "dominance": -0.3},
    {"t": 31.0, "event": "bumper.pressed", "bumper": "left"},
    {"t": 32.0, "event": "drive.stopped", "reason": "e-stop", "words": "someone said stop"},
    {"t": 45.0, "event": "speech.heard", "text": "goodbye", "start": 44.0, "end": 44.8},
    {"t": 46.0, "event": "speech.said", "text": "Good bye!"},
)  # fmt: skip
"""The events of a visit."""


def visit(folder, has_sound=True):
    """A recording of a minute."""
    folder.mkdir()
    log(folder, *MINUTE)
    film(folder / FACE, 60 * int(RATE))
    if has_sound:
        hum = 3000 * np.sin(np.arange(60 * 8000) * 0.2)
        write_wav(folder / SOUND, hum.astype(np.int16), 8000)
    return folder
