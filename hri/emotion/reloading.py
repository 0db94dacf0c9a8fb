"""The emotion files of a running behavior: read again beside the loop when one of them is saved."""

from __future__ import annotations

from hri.core.clock import Clock, Worker
from hri.emotion.files import EmotionFiles
from hri.emotion.model_spec import EmotionModelSpec

LOOK_EVERY_S = 1.0
"""Seconds between looks at the files."""
LATENCY = 0.05
"""Seconds that a look at the files takes on the fake clock."""


class Reloading:
    """One personality, all stimuli and the display; `model` is what was last all right."""

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
