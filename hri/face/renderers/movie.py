"""Pictures as a moving file: MP4, WebP or GIF."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import chain, pairwise
from pathlib import Path

import cv2
from PIL import Image as Picture

from hri.core.errors import HriError
from hri.core.native_path import native_path
from hri.core.signals import Image, Samples
from hri.core.writing import replacing
from hri.hal.drivers.mp4 import check_size, is_whole
from hri.hal.drivers.mp4_sound import add_sound
from hri.hal.drivers.scaling import by_area
from hri.hal.picture import fitted

MOST_PICTURES = 100_000
"""Nearly an hour at 30 a second."""
MOST_HELD = 600_000_000
"""Pixels of a GIF together: Pillow holds them until the end, one byte each."""
SLOWEST, FASTEST = 1.0, 120.0
"""Pictures a second."""
FASTEST_GIF = 50.0
"""Pictures a second; browsers slow down what is faster."""
ROOM = 4096
"""Bytes that a disk must have for an MP4 to be begun."""
WEBP_QUALITY = 85
"""Of 100."""


Sound = tuple[Samples, int]
"""Samples of one channel, and how many there are in a second."""


def write_movie(
    path: Path,
    pictures: Iterable[Image],
    rate: float,
    mode: int | None = None,
    sound: Sound | None = None,
) -> None:
    """Write pictures, `rate` a second, as the suffix says: .mp4, .webp or .gif.

    Pictures are taken one at a time, so they may be drawn on the way. The first one gives the size;
    one of another size is fitted into it, with black bars. An MP4 (MPEG-4 part 2) leaves out the
    last line of an odd side, and holds the sound, if there is one; WebP and GIF are silent, and
    repeat for ever. `mode` sets the permissions of the file, such as PRIVATE for a film of people.

    Raises HriError for another suffix, a rate out of range, no picture at all, too many, a size
    that an MP4 cannot have, or a file that cannot be written; one that was there before stays as it
    was.
    """
    check_movie(path, rate)
    suffix = path.suffix.lower()
    with replacing(path, mode, suffix) as new:
        WRITERS[suffix](new, _bounded(path, pictures), rate)
        if sound is not None and suffix in WITH_SOUND:
            add_sound(new, *sound)


def check_movie(path: Path, rate: float) -> None:
    """Raises HriError for what `write_movie` cannot write."""
    if path.suffix.lower() not in WRITERS:
        known = ", ".join(WRITERS)
        raise HriError(f"{path}: no movie of this kind - end its name with one of {known}")
    fastest = FASTEST_GIF if path.suffix.lower() == ".gif" else FASTEST
    if not SLOWEST <= rate <= fastest:
        what = f"{rate:g} pictures a second"
        raise HriError(f"{path}: {what} - give a rate from {SLOWEST:g} to {fastest:g}")


def _bounded(path: Path, pictures: Iterable[Image]) -> Iterator[Image]:
    """The pictures, in the size of the first.

    Raises HriError when there are none, or too many, and for a size that the file cannot have.
    """
    number, height, width = 0, 0, 0
    for number, picture in enumerate(pictures, start=1):
        if number > MOST_PICTURES:
            raise HriError(f"{path}: more than {MOST_PICTURES} pictures - make it shorter")
        if number == 1:
            height, width = picture.shape[:2]
            if path.suffix.lower() == ".mp4":
                check_size(path, width, height)
        yield fitted(picture, width, height, by_area)
    if not number:
        raise HriError(f"{path}: no pictures - let it last longer than one of them")


def _write_mp4(path: Path, pictures: Iterator[Image], rate: float) -> None:
    first = next(pictures)
    height, width = first.shape[:2]
    path.write_bytes(bytes(ROOM))  # OpenCV's own complaints do not say why
    code = cv2.VideoWriter.fourcc(*"mp4v")
    with native_path(path) as name:
        writer = cv2.VideoWriter(name, code, rate, (width, height))
    try:
        if not writer.isOpened():
            raise HriError("OpenCV cannot write MP4 here - write .webp in its place")
        for picture in chain([first], pictures):
            writer.write(cv2.cvtColor(picture, cv2.COLOR_RGB2BGR))
    finally:
        writer.release()
    if not is_whole(path):
        raise HriError("OpenCV could not write it to its end - make room on the disk")


def _write_webp(path: Path, pictures: Iterator[Image], rate: float) -> None:
    frames = (Picture.fromarray(picture) for picture in pictures)
    durations = _milliseconds(rate, 1)
    _save(path, frames, "WEBP", durations, quality=WEBP_QUALITY, method=2)


def _write_gif(path: Path, pictures: Iterator[Image], rate: float) -> None:
    _save(path, _few_colors(pictures), "GIF", _milliseconds(rate, 10), optimize=False)


def _few_colors(pictures: Iterator[Image]) -> Iterator[Picture.Image]:
    """Each picture with the 256 colors that suit it best."""
    held = 0
    for picture in pictures:
        held += picture.shape[0] * picture.shape[1]
        if held > MOST_HELD:
            raise HriError("too long for a GIF - make it smaller, or write .webp or .mp4")
        yield Picture.fromarray(picture).quantize(256, Picture.Quantize.MEDIANCUT)


def _save(
    path: Path, frames: Iterator[Picture.Image], kind: str, durations: list[int], **options: object
) -> None:
    first = next(frames)
    first.save(
        path, kind, save_all=True, append_images=frames, duration=durations, loop=0, **options
    )


def _milliseconds(rate: float, unit: int) -> list[int]:
    """How long each picture stays, in whole units, so that the sum never drifts from the rate."""
    ends = [round(n * 1000 / rate / unit) * unit for n in range(MOST_PICTURES + 1)]
    return [end - start for start, end in pairwise(ends)]


Writer = Callable[[Path, Iterator[Image], float], None]
WRITERS: dict[str, Writer] = {".mp4": _write_mp4, ".webp": _write_webp, ".gif": _write_gif}
"""By suffix."""
WITH_SOUND = (".mp4",)
"""Those that can hold sound."""
