"""The speech recognizer interface: sound in, finished pieces of speech out, words on demand."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from hri.core.signals import Alternative, HeardSlot, HeardWord, Samples
from hri.hal.resource import Resource

if TYPE_CHECKING:
    from hri.hal.word_graph import WordGraph

__all__ = [
    "Alternative",
    "Grammar",
    "HeardSlot",
    "HeardWord",
    "Hypothesis",
    "Recognizer",
    "Segment",
]


class Grammar(Protocol):
    """What an engine needs to know of a grammar (`hri.speech.grammar.Grammar` is one)."""

    @property
    def name(self) -> str: ...

    @property
    def locale(self) -> str:
        """The language that it says it is in, such as "en-US"; empty when it says nothing."""

    def words(self) -> frozenset[str]:
        """All words that can be said."""

    def flat_jsgf(self, rules: Collection[str] | None = None) -> str:
        """The grammar, or only these of its public rules, as JSGF with a single public rule,
        without tags, imports and quotes.
        """

    def sample(self, most: int) -> list[str]:
        """Sentences of the grammar: all when there are not more, else some of all kinds."""

    def graph(self) -> WordGraph:
        """Which word may follow which; made once."""


SAME_END = 0.01
"""Seconds by which the end of one voice may be found at different times."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A piece of speech: sound, or typed text in its place."""

    start: float
    """Seconds of the clock, of the first sample: a little before the voice."""
    end: float
    """Seconds, of the last sample; a finished piece has the pause that ended it inside."""
    samples: Samples | None = None
    text: str = ""
    number: int = 0
    """The same for all snapshots of one piece, of which each one begins the next."""
    quiet: float = 0.0
    """Seconds at its end in which no voice was found any more."""
    noise_db: float | None = None
    """Level of the noise before it, dB against full scale; None when nothing is known of it."""
    level_db: float | None = None
    """Level of its loudest tenth of a second, likewise, before anything was amplified."""
    origin: str = ""
    """Who typed it, as `hri.core.origin` has it; empty for what was said."""

    def goes_on_from(self, earlier: Segment) -> bool:
        """Whether a voice was found in it since an earlier snapshot of the same piece."""
        ended, before = self.end - self.quiet, earlier.end - earlier.quiet
        return abs(ended - before) >= SAME_END


@dataclass(frozen=True, slots=True)
class Hypothesis:
    """What an engine made of a segment, before our own parser has judged it."""

    text: str
    """Lower case words, those of a free slot as they were typed; empty when the engine found
    none."""
    confidence: float
    """0 to 1: the chance that a sentence of the grammar, this one or one that sounds like it, was
    said; 0.5 is the calibrated point of acceptance."""
    words: tuple[HeardWord, ...] = ()
    """In order, their times from the start of the segment; empty when the engine gives none."""
    alternatives: tuple[Alternative, ...] = ()
    """Likeliest first; empty when the engine gives none."""
    begun: str = ""
    """The words of a sentence that has only begun, where that is likelier than any whole one;
    empty else, and from engines that cannot tell."""
    paraphrase: str = ""
    """What was said, where that means `text` in other words; empty else."""
    slots: tuple[HeardSlot, ...] = ()
    """Its free slots; the words of each stand in `text`, too."""


class Recognizer(Resource):
    """Cuts sound into pieces of speech (cheap, in the loop) and decodes them (in a worker)."""

    rate: int = 16000
    """Samples a second that `listen` wants."""

    @abstractmethod
    def start(self, grammar: Grammar) -> None:
        """Load the models and take a grammar; may take a second, so call it from a worker.

        Called again, the new grammar takes the place of the old one, which stays in force when the
        new one is refused. Raises NotAvailable without a model, HriError for a grammar that the
        engine cannot take.
        """

    def know(self, slot: str, sounds: Mapping[str, tuple[str, ...]]) -> None:
        """Told what people said in a free slot before, each text with its phones: it is likelier
        there than what is listed. It takes the place of what was told before of the slot.

        Phones are those of the CMU dictionary, without stress. Cheap, called in the loop; an engine
        without free slots need not mind.
        """

    @abstractmethod
    def listen(self, samples: Samples, end: float) -> list[Segment]:
        """Take the sound up to time `end`; the pieces of speech that ended in it."""

    def mind(self, is_speaking: bool, now: float) -> None:
        """Told whether the robot speaks, before each `listen`.

        For those whose pieces can wait, and those that must not learn from its voice.
        """

    def wait(self, segment: Segment, pauses: float) -> None:
        """Told in the loop, in a pause of the piece that a snapshot is of, when to end it.

        That is after this many of the usual pauses, as long as the voice does not go on. For those
        that cut sound into pieces.
        """

    @abstractmethod
    def flush(self) -> list[Segment]:
        """The piece of speech that is still open, at the end of all sound."""

    @abstractmethod
    def decode(self, segment: Segment, rules: Collection[str] | None = None) -> Hypothesis:
        """The words of a finished piece; called from one worker at a time.

        Uses what `advance` has done for the same piece. `rules` are the public rules that may be
        heard now, where the engine can tell them apart; None is all.
        """

    def advance(self, segment: Segment, rules: Collection[str] | None = None) -> str:
        """Work through an open piece as far as it goes; the words so far, "" when there are none.

        For the worker that decodes. Engines that decode at the end do nothing here.
        """
        return ""

    @property
    def is_hearing(self) -> bool:
        """True while a voice is going on."""
        return False

    @property
    def open_segment(self) -> Segment | None:
        """A snapshot of the piece that is still going on; None while there is none."""
        return None
