"""A folder of pictures as a camera, such as `ffmpeg -i film.mp4 folder/%04d.png` leaves."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from hri.core.errors import HriError
from hri.core.signals import Frame, Image
from hri.hal.camera import FIELD_OF_VIEW, Camera
from hri.hal.drivers.still_image import read_still
from hri.hal.drivers.video_file import PACES

READ = re.compile(r"\.(avif|bmp|gif|jfif|jp[eg]|jpeg|mpo|p[bfgnp]m|png|tiff?|webp)", re.IGNORECASE)
"""Suffixes of pictures that are read."""
NOT_READ = re.compile(
    r"\.(arw|cr[23]|dng|exr|hdr|hei[cf]s?|ico|j2k|jp2|jxl|nef|orf|psd|raf|raw|rw2|svg|tga)",
    re.IGNORECASE,
)
"""Suffixes of others."""
MOST_FILES = 1_000_000


class ImageFolderCamera(Camera):
    """Shows the pictures of a folder in the order of the numbers in their names, once.

    `rate` pictures a second; `pace` as in `VideoFileCamera`. An unreadable picture is skipped, and
    reported once.
    """

    parameters = (*Camera.parameters, "folder", "rate", "pace", "field_of_view")

    def _open(self) -> None:
        folder = Path(self.description.text("folder"))
        self.is_recording = self.description.choice("pace", "real", PACES) == "fast"
        self._rate = self.description.number_within("rate", 30.0, 0.1, 1000.0)
        self.field_of_view = self.description.number_within("field_of_view", *FIELD_OF_VIEW)
        self._files = pictures_in(folder, self.manager.notice)
        self._start = self.manager.clock.now()
        self._next = 0
        with suppress(HriError):
            self._take_size(read_still(self._files[0]).image)

    def _read(self, now: float) -> Frame | None:
        due = int((now - self._start) * self._rate + 1e-6)
        if self.is_recording:
            due = self._next
        if due < self._next or self._next >= len(self._files):
            return None
        due = min(due, len(self._files) - 1)
        self._next = due + 1
        image = self._load(self._files[due])
        return None if image is None else Frame(image, self._start + due / self._rate, due)

    def _load(self, path: Path) -> Image | None:
        try:
            return read_still(path).image
        except HriError as error:
            self._log.refused += 1
            self._tell(f"{error}; it is passed over")
            return None

    @property
    def has_ended(self) -> bool:
        return self._next >= len(self._files)


def pictures_in(folder: Path, tell: Callable[[str], object]) -> list[Path]:
    """Files of pictures, "2.png" before "10.png".

    `tell` is given a line about those that are left out since they are of a kind that is not read.
    Raises HriError when no other is there.
    """
    if not folder.is_dir():
        raise HriError(f"{folder}: no such folder - check the path")
    files = [path for path in folder.iterdir() if not path.name.startswith(".")]
    found = [path for path in files if READ.fullmatch(path.suffix)]
    others = Counter(path.suffix.lower() for path in files if NOT_READ.fullmatch(path.suffix))
    left_out = ", ".join(f"{count} {suffix}" for suffix, count in sorted(others.items()))
    if not found:
        only = f" that can be read, only {left_out}" if others else ""
        raise HriError(f"{folder}: no pictures in it{only} - put JPEG or PNG there")
    if len(found) > MOST_FILES:
        raise HriError(f"{folder}: {len(found)} pictures - keep it below {MOST_FILES}")
    if others:
        tell(f"{folder}: left out {left_out} - convert them to JPEG or PNG")
    return sorted(found, key=_by_number)


def _by_number(path: Path) -> tuple[list[tuple[int, str]], str]:
    parts = re.split(r"(\d+)", path.name)
    return [(int(part) if part.isdecimal() else -1, part) for part in parts], path.name
