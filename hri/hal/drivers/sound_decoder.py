"""Decodes sound files of many formats, with libsndfile."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import message_line
from hri.core.signals import Samples
from hri.hal.drivers.channels import CHOICES, OneChannel
from hri.hal.drivers.resampling import resample_blocks
from hri.hal.drivers.silence import silenced_libraries
from hri.hal.drivers.unfinished_wav import finished

LONGEST = 3600.0
"""Seconds; a longer file is refused, so that it cannot fill the memory."""
LEAST_RATE, MOST_RATE = 1000, 400_000
"""Samples a second of what can be sound."""
MOST_SAMPLES = 110_000_000
"""Of a sound in memory: nearly two hours at 16 kHz, 38 minutes at 48 kHz."""
BLOCK = 1 << 18
"""Frames decoded at a time."""

log = logging.getLogger("hri.resources")

Tell = Callable[[str], object]
"""Gets a line about a file that was read, but is not as it should be."""


def decode(
    path: Path, wanted: int | None = None, channel: str = CHOICES[0], tell: Tell = log.warning
) -> tuple[Samples, int]:
    """The samples of an MP3, FLAC, Ogg or WAV file as mono int16, and their rate.

    Raises HriError when it cannot be decoded, is empty or longer than an hour, NotAvailable when
    the decoder is not installed.
    """
    soundfile = _load_soundfile()
    one_channel = OneChannel(channel)
    try:
        with (
            silenced_libraries(),
            finished(path) as (source, is_unfinished),
            soundfile.SoundFile(source) as file,
        ):
            rate = file.samplerate
            if not LEAST_RATE <= rate <= MOST_RATE:
                raise HriError(f"{path}: {rate} Hz is out of range - convert it to 16 kHz")
            heard = _mono_blocks(path, file, one_channel)
            samples = joined(path, resample_blocks(heard, rate, wanted or rate))
    except (soundfile.SoundFileError, ValueError) as error:
        raise HriError(f"{path}: not a readable sound file - try a WAV or an MP3") from error
    if not len(samples):
        raise HriError(f"{path}: this file holds no sound - record it again")
    tell_of(path, tell, is_unfinished, one_channel)
    return samples, wanted or rate


def tell_of(path: Path, tell: Tell, is_unfinished: bool, one_channel: OneChannel) -> None:
    """Tell in a line each what was made good in a file that was read."""
    if is_unfinished:
        what = "its recorder ended before it wrote the length"
        tell(message_line(f"{path}: {what} - it was read to its end"))
    if one_channel.is_any_inverted:
        what = "a channel is the opposite of the other and was turned round"
        tell(message_line(f"{path}: {what} - check the wires of the microphone"))


def joined(path: Path, blocks: Iterable[Samples]) -> Samples:
    """The blocks as one sound, which is never twice in the memory.

    Raises HriError when there are more than MOST_SAMPLES.
    """
    sound = bytearray()
    for block in blocks:
        require_room(path, len(sound) // 2 + len(block))
        sound += block.tobytes()
    return np.frombuffer(sound, np.int16)


def require_room(path: Path, samples: float) -> None:
    """Raises HriError when a sound has more than MOST_SAMPLES."""
    if samples > MOST_SAMPLES:
        what = f"more than {MOST_SAMPLES:,} samples"
        raise HriError(f"{path}: {what} - convert it to 16 kHz, or cut it into parts")


def _load_soundfile() -> Any:
    try:
        import soundfile
    except (ImportError, OSError) as error:
        raise NotAvailable(
            "soundfile, which decodes sounds, is missing - pip install soundfile"
        ) from error
    return soundfile


def _mono_blocks(path: Path, file: Any, one_channel: OneChannel) -> Iterator[Samples]:
    left = LONGEST * file.samplerate
    # As numbers with a point: the library does not scale those of a file to whole ones.
    for block in file.blocks(BLOCK, dtype="float32", always_2d=True):
        left -= len(block)
        if left < 0:
            raise HriError(f"{path}: longer than {LONGEST:g} s - cut it into parts")
        yield one_channel.take(_as_int16(block))


def _as_int16(block: NDArray[np.float32]) -> NDArray[np.int16]:
    """Samples of -1 to 1 as integers; larger values are clipped, NaN is silence."""
    # Clipped before it is scaled, since damaged files hold numbers near the largest there are.
    within = np.clip(np.nan_to_num(block), -1.0, 1.0)
    whole: NDArray[np.int16] = np.rint(within * 32768.0).clip(max=32767).astype(np.int16)
    return whole
