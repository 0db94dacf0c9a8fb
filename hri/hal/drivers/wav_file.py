"""WAV files as a microphone and as a speaker."""

from __future__ import annotations

import wave
from pathlib import Path

import numpy as np
import soxr

from hri.core.errors import HriError
from hri.core.signals import Samples
from hri.hal.microphone import Microphone
from hri.hal.speaker import Speaker

LONGEST = 4 * 3600.0
"""Seconds; a longer recording is refused, so that it cannot fill the memory."""
TAIL = 1.0
"""Seconds of silence heard after a file, so that its last word is seen to end."""


def read_wav(path: Path) -> tuple[Samples, int]:
    """The samples of a PCM file as mono int16 with its rate.

    Raises HriError when it cannot be read, is empty, no WAV, compressed, or too long.
    """
    try:
        with wave.open(str(path), "rb") as file:
            channels, width, rate = file.getnchannels(), file.getsampwidth(), file.getframerate()
            if not 1000 <= rate <= 400_000 or file.getnframes() > LONGEST * rate:
                raise HriError(
                    f"{path}: {rate} Hz or its length is out of range - convert it to 16 kHz"
                )
            raw = file.readframes(file.getnframes())
    except (wave.Error, EOFError) as error:
        why = str(error) or "it ends too early"
        raise HriError(
            f"{path}: not a readable WAV file ({why}) - record it as 16-bit PCM"
        ) from error
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{path}: cannot read this WAV file: {reason} - check the path") from error
    samples = _as_int16(raw[: len(raw) // (channels * width) * channels * width], width)
    if not len(samples):
        raise HriError(f"{path}: this WAV file holds no sound - record it again")
    mono = samples.reshape(-1, channels).astype(np.int32).mean(axis=1)
    return mono.astype(np.int16), rate


def write_wav(path: Path, samples: Samples, rate: int) -> None:
    """Write mono 16-bit PCM."""
    with wave.open(str(path), "wb") as file:
        file.setparams((1, 2, rate, 0, "NONE", "not compressed"))
        file.writeframes(samples.tobytes())


def resample(samples: Samples, rate: int, wanted: int) -> Samples:
    """The same sound at another rate."""
    if rate == wanted:
        return samples
    converted: Samples = soxr.resample(samples, rate, wanted)
    return converted


def _as_int16(raw: bytes, width: int) -> Samples:
    if width == 1:  # WAV keeps 8 bits unsigned, all else signed
        return ((np.frombuffer(raw, np.uint8).astype(np.int16) - 128) << 8).astype(np.int16)
    if width == 2:
        return np.frombuffer(raw, "<i2").astype(np.int16)
    # Of 24 and 32 bits the upper 16 are kept.
    return np.frombuffer(raw, np.uint8).reshape(-1, width)[:, -2:].copy().view("<i2").reshape(-1)


class WavMicrophone(Microphone):
    """Hears a file from the moment it is opened, then silence."""

    parameters = ("file",)

    def _open(self) -> None:
        samples, rate = read_wav(Path(self.description.text("file")))
        self._sound = resample(samples, rate, self.rate)
        self._start = self.manager.clock.now()
        self._given = 0

    def read(self, now: float) -> Samples:
        until = max(self._given, round((now - self._start) * self.rate))
        heard = self._sound[self._given : until]
        silence = np.zeros(until - self._given - len(heard), np.int16)
        self._given = until
        return np.concatenate([heard, silence])

    @property
    def has_ended(self) -> bool:
        return self._given >= len(self._sound) + TAIL * self.rate


class WavSpeaker(Speaker):
    """Writes what it plays to a file, silence between the sounds included."""

    parameters = ("file", "rate")

    def _open(self) -> None:
        self.rate = int(self.description.number("rate", 22050))
        path = self.description.text("file")
        try:
            self._file = wave.open(path, "wb")  # noqa: SIM115 - closed in _close
        except OSError as error:
            raise HriError(f"{path}: cannot write: {error.strerror} - check the folder") from error
        self._file.setparams((1, 2, self.rate, 0, "NONE", "not compressed"))
        self._origin = self.manager.clock.now()
        self._written = 0
        self._sound: Samples = np.zeros(0, np.int16)
        self._begun = self._origin

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self.stop(now)
        self._sound, self._begun = resample(samples, rate, self.rate), now

    def position(self, now: float) -> float | None:
        elapsed = now - self._begun
        return elapsed if elapsed < len(self._sound) / self.rate else None

    def stop(self, now: float) -> None:
        """Write the sound as far as it was heard."""
        heard = self._sound[: round((now - self._begun) * self.rate)]
        self._sound = self._sound[:0]
        if len(heard):
            self._pad_to(self._begun)
            self._write(heard)

    def _pad_to(self, time: float) -> None:
        gap = round((time - self._origin) * self.rate) - self._written
        self._write(np.zeros(max(0, gap), np.int16))

    def _write(self, samples: Samples) -> None:
        self._file.writeframes(samples.tobytes())
        self._written += len(samples)

    def _close(self) -> None:
        now = self.manager.clock.now()
        self.stop(now)
        self._pad_to(now)
        self._file.close()
