"""Sentences in the voices of flite, a small synthesizer; what was made once is kept on disk."""

from __future__ import annotations

import hashlib
import wave
from contextlib import suppress
from pathlib import Path

import numpy as np

from hri.core import paths
from hri.core.errors import HriError
from hri.core.signals import Samples
from hri.core.writing import make_folder
from hri.hal.drivers.resampling import resample
from hri.hal.drivers.wav_file import write_wav
from hri.speech.synthesizers.flite import speak

RATE = 16000
VOICES = ("slt", "rms", "kal16", "awb")
LEAD, TAIL = 0.4, 0.8
"""Seconds of silence before and after a sentence."""


def say(text: str, voice: str) -> Samples:
    """The sentence between its silences, 16 kHz.

    Raises NotAvailable without the program, HriError when it fails.
    """
    name = hashlib.sha256(f"{voice}\n{text}".encode()).hexdigest()[:20] + ".wav"
    path = paths.cache_folder() / "flite" / name
    try:
        spoken = read_wav(path)
    except HriError:
        spoken = _made(text, voice, path)
    silences = (np.zeros(round(LEAD * RATE), np.int16), np.zeros(round(TAIL * RATE), np.int16))
    return np.concatenate([silences[0], spoken, silences[1]])


def _made(text: str, voice: str, path: Path) -> Samples:
    samples, rate = speak(text, voice)
    spoken = resample(samples, rate, RATE)
    with suppress(HriError):  # The cache is only a shortcut.
        make_folder(path.parent)
        write_wav(path, spoken, RATE)
    return spoken


def read_wav(path: Path) -> Samples:
    """A WAV file of 16 bit, mono, 16 kHz. Raises HriError for any other."""
    try:
        with wave.open(str(path)) as file:
            kind = (file.getnchannels(), file.getsampwidth(), file.getframerate())
            if kind != (1, 2, RATE):
                raise HriError(f"{path}: not mono, 16 bit, {RATE} Hz - convert it")
            return np.frombuffer(file.readframes(file.getnframes()), np.int16)
    except (OSError, EOFError, wave.Error) as error:
        raise HriError(f"{path}: {error} - is it a WAV file?") from error
