"""The emotion files of a running robot, read again when one of them is saved: all or nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from hri.core.errors import HriError
from hri.emotion.display import display_path
from hri.emotion.model_spec import EmotionModelSpec, load_emotions
from hri.emotion.personality import personality_path
from hri.emotion.stimulus import stimulus_paths

Stamp = tuple[Path, int, int]
"""A file, when it was changed (nanoseconds), its size (bytes)."""


class EmotionFiles:
    """One personality, all stimuli and the display, as they were when they last were all right."""

    def __init__(self, personality: str) -> None:
        """Raises HriError for an unknown personality, AuthoringError for a wrong file."""
        self._personality = personality
        self._stamps = self._look()
        self.model: EmotionModelSpec = load_emotions(personality)

    def reload(self) -> bool:
        """Look at the files, and read them when one has changed; whether `model` is a new one.

        Raises HriError for files that are wrong, once until one of them changes again; `model` is
        then as it was.
        """
        stamps = self._look()
        if stamps == self._stamps:
            return False
        self._stamps = stamps
        self.model = load_emotions(self._personality)
        return True

    def _look(self) -> tuple[Stamp, ...]:
        # Before they are read: what is saved meanwhile is seen the next time.
        return tuple(_stamps(self._personality))


def _stamps(personality: str) -> Iterator[Stamp]:
    """Of all files that there are; one that is gone has none."""
    finders: tuple[Callable[[], Iterable[Path]], ...] = (
        lambda: (personality_path(personality),),
        lambda: (display_path(),),
        stimulus_paths,
    )
    for find in finders:
        with suppress(HriError, OSError):
            for path in find():
                status = path.stat()
                yield path, status.st_mtime_ns, status.st_size
