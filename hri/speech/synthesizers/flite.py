"""The voices of flite, a small synthesizer (`apt install flite`): to try grammars with."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Samples
from hri.hal.drivers.wav_file import read_wav

VOICES = ("slt", "rms", "awb", "kal16")
PATIENCE = 20.0
"""Seconds that flite may take for a sentence."""


def is_there() -> bool:
    """Whether the program is installed."""
    return shutil.which("flite") is not None


def speak(text: str, voice: str) -> tuple[Samples, int]:
    """The sound of a sentence and its rate.

    Raises NotAvailable without the program, HriError when it fails.
    """
    if not is_there():
        raise NotAvailable("flite is not installed - apt install flite")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "said.wav"
        command = ["flite", "-voice", voice, "-t", text, "-o", str(path)]
        try:
            subprocess.run(command, check=True, capture_output=True, timeout=PATIENCE)
        except (OSError, subprocess.SubprocessError) as error:
            raise HriError(f"{' '.join(command)} failed: {error} - run it by hand") from error
        return read_wav(path)
