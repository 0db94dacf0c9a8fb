"""Pictures that something is learned from: a bad one does not lose what the others teach."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from hri.core.errors import HriError
from hri.core.paths import exists
from hri.core.quoting import report
from hri.hal.drivers.image_folder import pictures_in
from hri.hal.drivers.still_image import StillImage, read_still


@dataclass
class LeftOut:
    """Counts the pictures that teach nothing, and says why."""

    count: int = 0

    def add(self, reason: object) -> None:
        report(str(reason), sys.stderr, flush=True)
        self.count += 1

    @property
    def status(self) -> int:
        """Exit status of a command that learned something nevertheless: 1 when one is left out."""
        return int(self.count > 0)


def stills_of(given: Sequence[Path], left_out: LeftOut) -> Iterator[tuple[Path, StillImage]]:
    """The pictures of these names, and in these folders, as far as they can be read."""
    tell = partial(report, file=sys.stderr)
    for path in given:
        try:
            is_folder = exists(path) and path.is_dir()
            files = pictures_in(path, tell) if is_folder else [path]
        except HriError as error:
            left_out.add(error)
            continue
        for file in files:
            try:
                still = read_still(file)
            except HriError as error:
                left_out.add(error)
            else:
                yield file, still
