"""A separate process for pyttsx3: one text, one file, then it ends.

Its drivers lose queued sentences, print to standard output, want the main thread (macOS, Windows)
and share espeak-ng's library with whoever else uses it; none of that leaves this process.
Arguments: `save` and the path of the sound file to write, with JSON of `text`, `rate`, `voice` and
`volume` on standard input; or `list`, which prints the voices as JSON in its last line.
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


def list_voices() -> None:
    """Print what voices there are."""
    _offer_espeak()
    import pyttsx3

    found = [
        {
            "id": str(voice.id),
            "name": str(voice.name),
            "language": _language(voice.languages),
            "gender": _gender(voice.gender),
        }
        for voice in pyttsx3.init().getProperty("voices")
    ]
    print(f"\n{json.dumps(found)}")


def _language(languages: list[str | bytes] | None) -> str:
    """The first of a voice's languages: "en_US" as "en-us"."""
    first = (languages or [""])[0]
    text = first.decode(errors="replace") if isinstance(first, bytes) else str(first)
    return text.strip("\x05\x02\x00").replace("_", "-").lower()


def _gender(gender: str | None) -> str:
    """Drivers write "Female", "VoiceGenderFemale" or nothing."""
    text = (gender or "").lower()
    return "female" if "female" in text else "male" if "male" in text else ""


def _offer_espeak() -> None:
    """On Linux pyttsx3 looks for the system's espeak-ng; lend it the wheel's."""
    if sys.platform == "linux":
        with suppress(ImportError, OSError):
            import espeakng_loader

            os.environ["ESPEAK_DATA_PATH"] = espeakng_loader.get_data_path()
            ctypes.CDLL(espeakng_loader.get_library_path())


if __name__ == "__main__":
    if sys.argv[1] == "list":
        list_voices()
    else:
        save(sys.argv[2], **json.load(sys.stdin))
