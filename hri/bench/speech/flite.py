"""Sentences in the voices of flite, a small synthesizer; what was made once is kept on disk."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tempfile
import wave
from contextlib import suppress
from pathlib import Path

import numpy as np

from hri.bench.speech.babble import RATE
from hri.core import paths
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Samples

VOICES = ("slt", "rms", "kal16", "awb")
LEAD, TAIL = 0.4, 0.8
"""Seconds of silence before and after a sentence."""
LONGEST = 20.0
"""Seconds that flite may take."""


def is_there() -> bool:
    """Whether the program is installed."""
    return shutil.which("flite") is not None


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
    if not is_there():
        raise NotAvailable("flite is not installed - apt install flite")
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "said.wav"
        command = ["flite", "-voice", voice, "-t", text, "-o", str(made)]
        try:
            subprocess.run(command, check=True, capture_output=True, timeout=LONGEST)
        except (OSError, subprocess.SubprocessError) as error:
            raise HriError(f"{' '.join(command)} failed: {error} - run it by hand") from error
        with suppress(OSError):  # The cache is only a shortcut.
            _keep(made, path)
        return read_wav(made)


def _keep(made: Path, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    arriving = path.with_suffix(f".{os.getpid()}")
    shutil.copyfile(made, arriving)
    arriving.replace(path)


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
