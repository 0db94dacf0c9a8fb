"""Two devices as one: both show or play the output, the first answers queries."""

from __future__ import annotations

from collections.abc import Callable

from hri.core.signals import Image, Samples
from hri.hal.resource import Resource
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker


class TeeScreen(Screen):
    """Shows on a screen and writes to another, such as a video file."""

    def __init__(
        self, screen: Screen, copy: Screen, mark: Callable[[Image], Image] = lambda image: image
    ) -> None:
        """`mark` changes each picture before it is shown and written."""
        Resource.__init__(self, screen.description, screen.manager)
        self.screen, self.copy, self._mark = screen, copy, mark
        self.width, self.height = screen.width, screen.height

    def show(self, image: Image, time: float) -> None:
        marked = self._mark(image)
        self.screen.show(marked, time)
        self.copy.show(marked, time)

    def pressed_keys(self) -> list[str]:
        return self.screen.pressed_keys()

    @property
    def is_closed(self) -> bool:
        return self.screen.is_closed

    def _close(self) -> None:
        self.copy.deactivate()
        self.screen.deactivate()


class TeeSpeaker(Speaker):
    """Plays on a speaker and writes to another, such as a WAV file."""

    def __init__(self, speaker: Speaker, copy: Speaker) -> None:
        Resource.__init__(self, speaker.description, speaker.manager)
        self.speaker, self.copy = speaker, copy

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self.speaker.play(samples, rate, now)
        self.copy.play(samples, rate, now)

    def extend(self, samples: Samples, now: float) -> None:
        self.speaker.extend(samples, now)
        self.copy.extend(samples, now)

    def position(self, now: float) -> float | None:
        return self.speaker.position(now)

    def stop(self, now: float) -> None:
        self.speaker.stop(now)
        self.copy.stop(now)

    def _close(self) -> None:
        self.copy.deactivate()
        self.speaker.deactivate()
