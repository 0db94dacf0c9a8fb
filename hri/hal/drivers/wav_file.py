"""Sound files as a microphone, and WAV files as a speaker."""

from __future__ import annotations

import struct
import wave
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hri.core.errors import HriError
from hri.core.growing_files import GrowingFile
from hri.core.reading import require_file
from hri.core.signals import Samples
from hri.core.writing import write_bytes
from hri.hal.drivers.channels import CHOICES, OneChannel, channel_of
from hri.hal.drivers.recording_level import audible
from hri.hal.drivers.resampling import GrowingSound, resample_blocks
from hri.hal.drivers.sound_decoder import (
    BLOCK,
    LEAST_RATE,
    MOST_RATE,
    Tell,
    decode,
    joined,
    log,
    require_room,
    tell_of,
)
from hri.hal.drivers.unfinished_wav import finished
from hri.hal.microphone import Microphone
from hri.hal.speaker import Speaker

LONGEST = 4 * 3600.0
"""Seconds; a longer recording is refused, so that it cannot fill the memory."""
PUMP = 0.5
"""Seconds between two writes of what a speaker plays to a file."""
MOST_BYTES = 2**32 - 40
"""Bytes of sound that the header of a file can count; readers find more behind it."""
TAIL = 1.0
"""Seconds of silence heard after a file, so that its last word is seen to end."""


def load_sound(
    path: Path, wanted: int | None = None, channel: str = CHOICES[0], tell: Tell = log.warning
) -> tuple[Samples, int]:
    """The samples of a WAV, MP3, FLAC or Ogg file as mono int16, and their rate: as `read_wav`.

    Raises HriError when it cannot be read, is empty, or too long, NotAvailable when the decoder is
    not installed.
    """
    require_file(path, "sound")
    if path.suffix.lower() != ".wav":
        return decode(path, wanted, channel, tell)
    try:
        return read_wav(path, wanted, channel, tell)
    except HriError as refusal:
        try:
            # Numbers with a point, and other layouts.
            return decode(path, wanted, channel, tell)
        except HriError:
            raise refusal from None  # it says more of what is wrong


def read_wav(
    path: Path, wanted: int | None = None, channel: str = CHOICES[0], tell: Tell = log.warning
) -> tuple[Samples, int]:
    """The samples of a PCM file as mono int16, and their rate: the file's own, or `wanted`.

    `channel` says what becomes of several: see `hri.hal.drivers.channels`. `tell` gets a line when
    one of them is inverted, or when the recorder never wrote the length of the file.

    Raises HriError when it cannot be read, is empty, no WAV, compressed, or too long.
    """
    one_channel = OneChannel(channel)
    try:
        with finished(path) as (source, is_unfinished), wave.open(source, "rb") as file:
            rate = file.getframerate()
            if not LEAST_RATE <= rate <= MOST_RATE or file.getnframes() > LONGEST * rate:
                raise HriError(
                    f"{path}: {rate} Hz or its length is out of range - convert it to 16 kHz"
                )
            require_room(path, file.getnframes() * (wanted or rate) / rate)
            # Block by block: the frames of a long file would fill the memory beside its samples.
            blocks = resample_blocks(_mono_blocks(file, one_channel), rate, wanted or rate)
            samples = joined(path, blocks)
    except (wave.Error, EOFError, RuntimeError) as error:  # wave seeks wrongly in broken files
        why = str(error) or "it ends too early"
        raise HriError(
            f"{path}: not a readable WAV file ({why}) - record it as 16-bit PCM"
        ) from error
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{path}: cannot read this WAV file: {reason} - check the path") from error
    if not len(samples):
        raise HriError(f"{path}: this WAV file holds no sound - record it again")
    tell_of(path, tell, is_unfinished, one_channel)
    return samples, wanted or rate


def write_wav(path: Path, samples: Samples, rate: int) -> None:
    """Write mono 16-bit PCM. Raises HriError when it cannot be written."""
    write_bytes(path, _header(rate, len(samples)) + samples.tobytes())


class GrowingWav:
    """Appends sound to a file of mono 16-bit PCM, which can be heard at any time."""

    def __init__(self, path: Path, rate: int) -> None:
        """Raises HriError when the file cannot be written."""
        self._file = GrowingFile(path)
        self._rate, self._count = rate, 0
        self._file.append(_header(rate, 0))

    def append(self, samples: Samples) -> bool:
        """Write samples at the end; whether they are there."""
        is_written = self._file.append(samples.tobytes())
        if is_written:
            self._count += len(samples)
            self._file.patch(0, _header(self._rate, self._count))
        return is_written

    def close(self) -> None:
        self._file.close()


def _header(rate: int, count: int) -> bytes:
    """The header for a number of samples; it is limited to 4 GB."""
    size = min(2 * count, MOST_BYTES)
    layout = struct.pack("<4sIHHIIHH", b"fmt ", 16, 1, 1, rate, 2 * rate, 2, 16)
    return (
        struct.pack("<4sI4s", b"RIFF", 36 + size, b"WAVE")
        + layout
        + struct.pack("<4sI", b"data", size)
    )


def _mono_blocks(file: wave.Wave_read, one_channel: OneChannel) -> Iterator[Samples]:
    channels, width = file.getnchannels(), file.getsampwidth()
    while raw := file.readframes(BLOCK):
        whole = len(raw) // (channels * width) * channels * width
        yield one_channel.take(_as_int16(raw[:whole], width).reshape(-1, channels))


def _as_int16(raw: bytes, width: int) -> Samples:
    if width == 1:  # WAV keeps 8 bits unsigned, all else signed
        return ((np.frombuffer(raw, np.uint8).astype(np.int16) - 128) << 8).astype(np.int16)
    if width == 2:
        return np.frombuffer(raw, "<i2").astype(np.int16)
    # Of 24 and 32 bits the upper 16 are kept.
    return np.frombuffer(raw, np.uint8).reshape(-1, width)[:, -2:].copy().view("<i2").reshape(-1)


class WavMicrophone(Microphone):
    """Hears a file from the moment it is opened, then silence; a quiet one as loud as a voice."""

    parameters = ("file", "channel")
    is_recording = True

    def _open(self) -> None:
        path = Path(self.description.text("file"))
        channel = channel_of(self.description)
        sound, _ = load_sound(path, self.rate, channel, self.manager.notice)
        self._sound, _ = audible(sound, self.rate)
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
    """Writes what it plays to a file, silence between the sounds included.

    The file can be heard at any time, up to half a second ago, also when the program is killed.
    """

    parameters = ("file", "rate")

    def _open(self) -> None:
        self.rate = self.description.count("rate", 22050, LEAST_RATE, MOST_RATE)
        self._file = GrowingWav(Path(self.description.text("file")), self.rate)
        self._clock = self.manager.clock
        self.origin = self._clock.now()
        """Seconds of the clock at which the file begins."""
        self._written = 0
        self._sound = self._nothing()
        self._heard = 0
        """Samples of the sound that are written."""
        self._begun = self.origin
        self._wait()

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self.stop(now)
        self._sound, self._begun, self._heard = GrowingSound(samples, rate, self.rate), now, 0

    def extend(self, samples: Samples, now: float) -> None:
        if self._sound.seconds:
            self._begun = max(self._begun, now - self._sound.seconds)
            self._sound.extend(samples)

    def position(self, now: float) -> float | None:
        elapsed = now - self._begun
        return elapsed if elapsed < self._sound.seconds else None

    def stop(self, now: float) -> None:
        """Write the sound as far as it was heard."""
        self._write_until(now)
        self._sound = self._nothing()

    def _nothing(self) -> GrowingSound:
        return GrowingSound(np.zeros(0, np.int16), self.rate, self.rate)

    def _wait(self) -> None:
        self._timer = self._clock.call_at(self._clock.now() + PUMP, self._pump)

    def _pump(self) -> None:
        self._write_until(self._clock.now())
        self._wait()

    def _write_until(self, now: float) -> None:
        """Write what was heard up to now, silence where nothing was."""
        until = max(0, round((now - self._begun) * self.rate))
        heard = self._sound.samples[self._heard : until]
        if len(heard):
            self._pad_to(self._begun + self._heard / self.rate)
            self._write(heard)
            self._heard += len(heard)
        if self._heard >= len(self._sound.samples):
            self._pad_to(now)

    def _pad_to(self, time: float) -> None:
        while (gap := round((time - self.origin) * self.rate) - self._written) > 0:
            self._write(np.zeros(min(gap, BLOCK), np.int16))

    def _write(self, samples: Samples) -> None:
        self._file.append(samples)
        self._written += len(samples)

    def _close(self) -> None:
        self._timer.cancel()
        self.stop(self._clock.now())
        self._file.close()
