"""The best recogniser this machine has."""

from __future__ import annotations

from hri.core.signals import Samples
from hri.hal.recognizer import Grammar, Hypothesis, Recognizer, Segment
from hri.speech.recognizers.pocketsphinx import PocketSphinxRecognizer
from hri.speech.recognizers.vosk import VoskRecognizer, find_model


class AutomaticRecognizer(Recognizer):
    """Vosk when a model directory is found, else PocketSphinx."""

    parameters = ("model",)

    def _open(self) -> None:
        folder = self.description.text("model")
        driver = VoskRecognizer if folder or find_model() else PocketSphinxRecognizer
        self.engine: Recognizer = driver(self.description, self.manager)
        self.engine.activate()

    def _close(self) -> None:
        self.engine.deactivate()

    def describe(self) -> str:
        return f"{type(self.engine).__name__}, chosen automatically"

    def start(self, grammar: Grammar) -> None:
        self.engine.start(grammar)

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        return self.engine.listen(samples, end)

    def flush(self) -> list[Segment]:
        return self.engine.flush()

    def decode(self, segment: Segment) -> Hypothesis:
        return self.engine.decode(segment)

    @property
    def is_hearing(self) -> bool:
        return self.engine.is_hearing
