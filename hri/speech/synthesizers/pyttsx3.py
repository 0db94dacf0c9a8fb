"""The voices of the platform (SAPI5, NSSpeech, espeak) through pyttsx3, one sentence at a time."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from hri.core.signals import Prosody, Speech
from hri.hal.drivers.wav_file import read_wav
from hri.hal.synthesizer import PLAIN, Synthesizer

_PROGRAM = Path(__file__).with_name("pyttsx3_process.py")
LONGEST_WAIT = 60.0
"""Seconds until a sentence is given up."""


class Pyttsx3Voice(Synthesizer):
    """Makes the sound in a process of its own; gives no phonemes, and knows no pitch."""

    parameters = ("voice", "rate_wpm")

    def _open(self) -> None:
        self._voice = self.description.text("voice")
        self._rate = self.description.number("rate_wpm", 165)
        self._one = threading.Lock()

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        order = {
            "text": text,
            "rate": self._rate * prosody.rate,
            "volume": prosody.volume,
            "voice": self._voice,
        }
        with self._one, tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "speech.wav"
            self._run(path, json.dumps(order))
            samples, rate = read_wav(path)
        return Speech(text, samples, rate)

    def _run(self, path: Path, order: str) -> None:
        try:
            done = subprocess.run(
                [sys.executable, "-P", str(_PROGRAM), str(path)],
                input=order,
                text=True,
                capture_output=True,
                timeout=LONGEST_WAIT,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )
        except subprocess.TimeoutExpired as error:
            why = f"no speech within {LONGEST_WAIT:g} s"
            raise self.not_available(why, "use Hri.EspeakVoice") from error
        if done.returncode != 0 or not path.is_file():
            last = (done.stderr.strip().splitlines() or ["no sound was made"])[-1]
            raise self.not_available(f"pyttsx3: {last[:200]}", "use Hri.EspeakVoice")
