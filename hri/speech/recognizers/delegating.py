"""A recognizer that leaves the work to another one."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment


class DelegatingRecognizer(Recognizer):
    """Passes everything on to `engine`, which a subclass opens."""

    engine: Recognizer

    def start(self, grammar: Grammar) -> None:
        self.engine.start(grammar)

    def know(self, slot: str, sounds: Mapping[str, tuple[str, ...]]) -> None:
        self.engine.know(slot, sounds)

    def mind(self, is_speaking: bool, now: float) -> None:
        self.engine.mind(is_speaking, now)

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        return self.engine.listen(samples, end)

    def wait(self, segment: Segment, pauses: float) -> None:
        self.engine.wait(segment, pauses)

    def flush(self) -> list[Segment]:
        return self.engine.flush()

    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        return self.engine.decode(segment, rules)

    def advance(self, segment: Segment, rules: Collection[str] | None = None) -> str:
        return self.engine.advance(segment, rules)

    @property
    def is_hearing(self) -> bool:
        return self.engine.is_hearing

    @property
    def open_segment(self) -> Segment | None:
        return self.engine.open_segment
