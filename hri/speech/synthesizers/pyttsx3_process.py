"""A process of its own for pyttsx3: one sentence, one file, then it ends.

Its drivers lose queued sentences, print to standard output, want the main thread (macOS, Windows)
and share espeak-ng's library with whoever else uses it; none of that leaves this process.
Arguments: the path of the sound file to write. Standard input: JSON with `text`, `rate`, `voice`
and `volume`.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
from contextlib import suppress


def save(path: str, text: str, rate: float, volume: float, voice: str) -> None:
    """Write the speech to a file."""
    _offer_espeak()
    import pyttsx3

    engine = pyttsx3.init()
    engine.setProperty("rate", round(rate))
    engine.setProperty("volume", min(max(volume, 0.0), 1.0))
    if voice:
        engine.setProperty("voice", voice)
    engine.save_to_file(text, path)
    engine.runAndWait()


def _offer_espeak() -> None:
    """On Linux pyttsx3 looks for the system's espeak-ng; lend it the wheel's."""
    if sys.platform == "linux":
        with suppress(ImportError, OSError):
            import espeakng_loader

            os.environ["ESPEAK_DATA_PATH"] = espeakng_loader.get_data_path()
            ctypes.CDLL(espeakng_loader.get_library_path())


if __name__ == "__main__":
    save(sys.argv[1], **json.load(sys.stdin))
