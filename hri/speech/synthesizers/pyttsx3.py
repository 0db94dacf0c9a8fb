"""The voices of the platform (SAPI5, NSSpeech, espeak) through pyttsx3, one text at a time."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path

from hri.core import child
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Prosody, Speech
from hri.hal.drivers.wav_file import read_wav
from hri.hal.synthesizer import PLAIN, Skill, Synthesizer
from hri.speech.aligner import with_times

_PROGRAM = Path(__file__).with_name("pyttsx3_process.py")
LONGEST_WAIT = 60.0
"""Seconds until a text is given up."""
LONGEST_LIST = 5.0
"""Seconds until a list of voices is given up."""
REMEDY = "use Hri.EspeakVoice"


@dataclass(frozen=True, slots=True)
class PlatformVoice:
    """A voice of the operating system."""

    id: str
    """What to give as the parameter `voice`."""
    name: str
    language: str
    """Such as "en-us"; empty where it is not told."""
    gender: str
    """"male", "female", or empty."""


def platform_voices() -> tuple[PlatformVoice, ...]:
    """The voices of Windows or macOS; on Linux pyttsx3 has none but espeak-ng's.

    Raises NotAvailable when they cannot be asked for.
    """
    if sys.platform == "linux":
        return ()
    lines = _run(["list"], "", LONGEST_LIST).splitlines()
    return tuple(PlatformVoice(**voice) for voice in json.loads(lines[-1] if lines else "[]"))


class Pyttsx3Voice(Synthesizer):
    """Synthesizes in a separate process, times the sounds afterward, and does not support pitch."""

    parameters = ("voice", "rate_wpm")
    skills = frozenset({Skill.PACE, Skill.LOUDNESS})

    def _open(self) -> None:
        self._voice = self.description.text("voice")
        self._rate = self.description.number("rate_wpm", 165)
        self._one = threading.Lock()

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        order = {
            "text": text,
            "rate": self._rate * prosody.rate,
            "volume": prosody.volume,
            "voice": prosody.voice or self._voice,
        }
        with self._one, tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "speech.wav"
            try:
                _run(["save", str(path)], json.dumps(order), LONGEST_WAIT)
            except NotAvailable as error:
                raise NotAvailable(f"{self.id}: {error}") from error
            if not path.is_file():
                raise self.not_available("pyttsx3: no sound was made", REMEDY)
            samples, rate = read_wav(path)
        return _timed(Speech(text, samples, rate))


def _timed(speech: Speech) -> Speech:
    """With the times of English words; what is in another language is left to its loudness."""
    try:
        return with_times(speech)
    except HriError:
        return speech


def _run(arguments: list[str], order: str, patience: float) -> str:
    """The output of the separate process. Raises NotAvailable when it fails or hangs."""
    try:
        done = subprocess.run(
            child.command(_PROGRAM, *arguments),
            input=order,
            text=True,
            capture_output=True,
            timeout=patience,
            env=child.environment(),
        )
    except subprocess.TimeoutExpired as error:
        raise NotAvailable(f"pyttsx3: no answer within {patience:g} s - {REMEDY}") from error
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["it failed"])[-1]
        raise NotAvailable(f"pyttsx3: {last[:200]} - {REMEDY}")
    return done.stdout
