"""What all engines that hear sound share: the cutting into pieces of speech."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection
from typing import ClassVar

from hri.core.signals import Samples
from hri.hal.recognizer import Hypothesis, Recognizer, Segment
from hri.speech.echo import ECHO_TAIL
from hri.speech.endpoint import PAUSE, Endpointer
from hri.speech.recognizers.voice_activity import voice_detector


class EndpointedRecognizer(Recognizer):
    """Decodes the sound of pieces; a subclass says how, and its `_open` calls this one.

    `pause` is the seconds of quiet that end a piece which may go on or not: 0.2 to 3.
    """

    parameters: ClassVar[tuple[str, ...]] = ("pause",)

    def _open(self) -> None:
        pause = self.description.number_within("pause", PAUSE, 0.2, 3.0)
        self._endpointer = Endpointer(self.rate, voice_detector, pause)
        self._spoke = -ECHO_TAIL

    def mind(self, is_speaking: bool, now: float) -> None:
        if is_speaking:
            self._spoke = now
        self._endpointer.hold_level(now - self._spoke <= ECHO_TAIL)

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        return self._endpointer.listen(samples, end)

    def wait(self, segment: Segment, pauses: float) -> None:
        self._endpointer.wait(segment, pauses)

    def flush(self) -> list[Segment]:
        return self._endpointer.flush()

    @property
    def is_hearing(self) -> bool:
        return self._endpointer.is_hearing

    @property
    def open_segment(self) -> Segment | None:
        return self._endpointer.open_segment

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        if segment.samples is None:
            return Hypothesis(segment.text, 1.0)
        return self._decode(segment, segment.samples, rules)

    @abstractmethod
    def _decode(
        self, segment: Segment, samples: Samples, rules: Collection[str] | None
    ) -> Hypothesis:
        """The words of a piece of sound; `samples` are the segment's."""
