"""The emotion files of a running robot, read again when one of them is saved: all or nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from hri.core.clock import Clock, Worker
from hri.core.errors import HriError
from hri.emotion.display import display_path
from hri.emotion.model_spec import EmotionModelSpec, load_emotions
from hri.emotion.personality import personality_path
from hri.emotion.stimulus import stimulus_paths

Stamp = tuple[Path, int, int]
"""A file, when it was changed (nanoseconds), its size (bytes)."""

LOOK_EVERY_S = 1.0
"""Seconds between looks at the files."""
LATENCY = 0.05
"""Seconds that a look at the files takes on the fake clock."""


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


class Reloading:
    """The same, read again beside the loop; `model` is what was last all right."""

    def __init__(self, personality: str, clock: Clock) -> None:
        """Raises HriError for an unknown personality, AuthoringError for a wrong file."""
        self._files = EmotionFiles(personality)
        self._worker: Worker[bool] = clock.worker(LATENCY)
        self._looked = clock.now()
        self.model: EmotionModelSpec = self._files.model

    def look(self, now: float) -> bool:
        """Look at the files now and then; whether `model` is a new one.

        Raises HriError, once, for files that are wrong; `model` is then as it was.
        """
        is_new = any(self._worker.poll())
        if is_new:
            self.model = self._files.model
        if not self._worker.is_busy and now - self._looked >= LOOK_EVERY_S:
            self._looked = now
            self._worker.submit(self._files.reload)
        return is_new

    def close(self) -> None:
        """Look no more; a second call does nothing."""
        self._worker.close()


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
