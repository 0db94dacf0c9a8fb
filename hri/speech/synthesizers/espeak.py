"""The robot's own voice: espeak-ng, with the time of every phoneme."""

from __future__ import annotations

import numpy as np

from hri.core.signals import Phoneme, Prosody, Speech
from hri.hal.synthesizer import PLAIN, Synthesizer
from hri.speech.synthesizers.espeak_library import Setting, Sound, load_espeak

PLAIN_SETTING = Setting()
LONGEST_TEXT = 5000
"""Characters; what is longer is cut, it would be minutes of speech."""


class EspeakVoice(Synthesizer):
    """Speaks some two hundred times faster than real time; the same text gives the same samples."""

    parameters = ("voice", "rate_wpm", "pitch")

    def _open(self) -> None:
        self._library = load_espeak()
        self._plain = Setting(
            voice=self.description.text("voice", PLAIN_SETTING.voice),
            rate=round(self.description.number("rate_wpm", PLAIN_SETTING.rate)),
            pitch=round(self.description.number("pitch", PLAIN_SETTING.pitch)),
        )
        if not self._library.has_voice(self._plain.voice):
            what = f'espeak-ng has no voice "{self._plain.voice}"'
            raise self.description.error("voice", what, "write a voice such as en-us or en-us+f3")

    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        sound = self._library.speak(text[:LONGEST_TEXT], scaled(self._plain, prosody))
        samples = np.frombuffer(sound.samples, np.int16)
        duration = len(samples) / self._library.rate
        return Speech(text, samples, self._library.rate, timed_phonemes(sound, duration))

    def describe(self) -> str:
        return f"espeak-ng, voice {self._plain.voice}, {self._plain.rate} words a minute"


def scaled(plain: Setting, prosody: Prosody) -> Setting:
    """The setting with the factors of a prosody, within what the library takes."""
    return Setting(
        plain.voice,
        rate=_within(plain.rate * prosody.rate, 80, 450),
        pitch=_within(plain.pitch * prosody.pitch, 0, 100),
        volume=_within(plain.volume * prosody.volume, 0, 200),
    )


def _within(value: float, low: int, high: int) -> int:
    return round(min(max(value, low), high))


def timed_phonemes(sound: Sound, duration: float) -> tuple[Phoneme, ...]:
    """The phonemes with their durations; each lasts until the next begins, pauses included."""
    starts = [start for _, start in sound.phonemes]
    ends = [*starts[1:], duration]
    return tuple(
        Phoneme(name.lstrip("',"), start, max(0.0, end - start), name.startswith(("'", ",")))
        for (name, start), end in zip(sound.phonemes, ends, strict=True)
        if name.strip("',")
    )
