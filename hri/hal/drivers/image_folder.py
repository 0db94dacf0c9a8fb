"""A folder of pictures as a camera, such as `ffmpeg -i film.mp4 folder/%04d.png` leaves."""

from __future__ import annotations

import re
from pathlib import Path

import cv2
import numpy as np

from hri.core.errors import HriError
from hri.core.native_path import native_path
from hri.core.signals import Frame, Image
from hri.hal.camera import FIELD_OF_VIEW, Camera
from hri.hal.drivers.image_size import picture_size
from hri.hal.drivers.video_file import PACES

SUFFIXES = (".bmp", ".jpg", ".jpeg", ".png", ".webp")
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
        self._files = pictures_in(folder)
        self._start = self.manager.clock.now()
        self._next = 0
        size = picture_size(self._files[0])
        if size is not None:
            self._take_size(np.empty((size[1], size[0]), np.uint8))

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
            size = picture_size(path)  # raises before a giant is decoded
            with native_path(path) as name:
                picture = cv2.imread(name, cv2.IMREAD_COLOR) if size is not None else None
        except (HriError, cv2.error) as error:
            self._refuse(f"{path.name}: {error}")
            return None
        if picture is None:
            self._refuse(f"{path.name}, which is not a readable picture")
            return None
        return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2RGB), np.uint8)

    @property
    def has_ended(self) -> bool:
        return self._next >= len(self._files)


def pictures_in(folder: Path) -> list[Path]:
    """Files of pictures, "2.png" before "10.png". Raises HriError when there is none."""
    if not folder.is_dir():
        raise HriError(f"{folder}: no such folder - check the path")
    files = [path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES]
    if not files:
        raise HriError(f"{folder}: no pictures in it - put {', '.join(SUFFIXES)} there")
    if len(files) > MOST_FILES:
        raise HriError(f"{folder}: {len(files)} pictures - keep it below {MOST_FILES}")
    return sorted(files, key=_by_number)


def _by_number(path: Path) -> tuple[list[tuple[int, str]], str]:
    parts = re.split(r"(\d+)", path.name)
    return [(int(part) if part.isdecimal() else -1, part) for part in parts], path.name
