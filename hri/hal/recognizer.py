"""The speech recogniser interface: sound in, finished pieces of speech out, words on demand."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

from hri.core.signals import Samples
from hri.hal.resource import Resource


class Grammar(Protocol):
    """What an engine needs to know of a grammar (`hri.speech.grammar.Grammar` is one)."""

    @property
    def name(self) -> str: ...

    def words(self) -> frozenset[str]:
        """All words that can be said."""

    def flat_jsgf(self) -> str:
        """The grammar as JSGF with a single public rule, without tags, imports and quotes."""

    def sentences(self, limit: int) -> Iterable[str]:
        """Sentences of the grammar, at most `limit`."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A finished piece of speech: sound, or typed text in its place."""

    start: float
    """Seconds."""
    end: float
    samples: Samples | None = None
    text: str = ""


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """What an engine made of a segment, before our own parser has judged it."""

    text: str
    """Lower case words; empty when the engine found none."""
    confidence: float
    """0 to 1; 0.5 is the calibrated point of acceptance."""


class Recognizer(Resource):
    """Cuts sound into pieces of speech (cheap, in the loop) and decodes them (in a worker)."""

    rate: int = 16000
    """Samples a second that `listen` wants."""

    @abstractmethod
    def start(self, grammar: Grammar) -> None:
        """Load the models and take a grammar; may take a second, so call it from a worker."""

    @abstractmethod
    def listen(self, samples: Samples, end: float) -> list[Segment]:
        """Take the sound up to time `end`; the pieces of speech that ended in it."""

    @abstractmethod
    def flush(self) -> list[Segment]:
        """The piece of speech that is still open, at the end of all sound."""

    @abstractmethod
    def decode(self, segment: Segment) -> Hypothesis:
        """The words of a piece of speech; called from one worker at a time."""

    @property
    def is_hearing(self) -> bool:
        """True while a voice is going on."""
        return False
