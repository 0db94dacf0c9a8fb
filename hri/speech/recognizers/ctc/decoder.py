"""The default engine: phones by a small network, words by an exact search of the grammar."""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import compress

import numpy as np

from hri.core.signals import Samples
from hri.hal.recognizer import Alternative, Grammar, HeardSlot, HeardWord, Hypothesis, Segment
from hri.speech.grammar.words import free_words, listed, said
from hri.speech.language import require_english
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.confidence import (
    confidence,
    fit_of,
    phrase_fit,
    scores_of,
    shares,
)
from hri.speech.recognizers.ctc.conformer import FRAME, load_network
from hri.speech.recognizers.ctc.features import Sound
from hri.speech.recognizers.ctc.hesitations import hesitations, without
from hri.speech.recognizers.ctc.kept_graphs import compiled
from hri.speech.recognizers.ctc.key_phrases import (
    confidence_in_phrase,
    has_free,
    is_too_long,
    joined,
    said_beside,
)
from hri.speech.recognizers.ctc.lattice import Path
from hri.speech.recognizers.ctc.loudness import KEPT, leveled, noise_of, sounding
from hri.speech.recognizers.ctc.phone_graph import Floats, PhoneGraph
from hri.speech.recognizers.ctc.posterior_stream import PosteriorStream
from hri.speech.recognizers.ctc.ranking import ranked
from hri.speech.recognizers.ctc.rival_words import Rivals
from hri.speech.recognizers.ctc.search import Search
from hri.speech.recognizers.ctc.spoken_words import SpokenWords, Taught
from hri.speech.recognizers.ctc.word_evidence import word_chances
from hri.speech.recognizers.ctc.word_habits import Habits
from hri.speech.recognizers.endpointed import EndpointedRecognizer
from hri.speech.understanding import SILENT_AFTER

CLEARLY_BEGUN = 4.0
"""Natural log: how much better a sentence that has only begun must be than the best whole one. Of
64 begun sentences of the companion by four voices 60 are better by more, the words that usually end
a sentence cost up to 3.6."""
NEARLY_SAID = -1.0
"""Nearness of its words from which it counts: 61 of these 64, and 4 of 76 other sentences."""


CLEAR = 0.5
"""Confidence under which it is worth asking whether someone hesitated."""
SHORT = 4
"""Letters of an answer that is short."""
STILL = 1600
"""Samples of silence at the end of a piece that do not make a hesitation an earlier one."""

HearSlots = Callable[[Path, Floats], Mapping[int, HeardSlot]]
"""Finds what was said in the free slots of a path, by their places, in scores [frames, classes]."""


@dataclass
class Progress:
    """How far a piece of speech that still goes on has been worked through."""

    number: int
    rules: frozenset[str] | None
    stream: PosteriorStream
    search: Search
    taken: int = 0
    """Samples."""


@dataclass(frozen=True, eq=False)
class Early:
    """What was made of a piece of speech in the pause that may end it."""

    segment: Segment
    rules: frozenset[str] | None
    hypothesis: Hypothesis

    def holds_for(self, segment: Segment, samples: Samples, rules: frozenset[str] | None) -> bool:
        """Whether a piece is the same one, and nothing was said since."""
        mine = self.segment.samples
        assert mine is not None
        return (
            (self.segment.number, self.rules) == (segment.number, rules)
            and not segment.goes_on_from(self.segment)
            and len(mine) <= len(samples)
            and np.array_equal(mine, samples[: len(mine)])
        )


class CtcRecognizer(EndpointedRecognizer):
    """Hears what the grammar allows, by a small network that knows phones.

    `weights` names a file of other weights. Everything but the grammar's own graph is
    shared by all pieces; a new grammar takes its place between two of them.

    A piece is decoded as soon as the voice falls silent, within the pause that is waited for; when
    the voice stays silent, the result is there as soon as the pause is over.
    """

    parameters = ("weights", *EndpointedRecognizer.parameters)

    def _open(self) -> None:
        super()._open()
        self._network = load_network(self.description.text("weights"))
        self._work = threading.Lock()
        self._search: Search | None = None
        self._taught: Mapping[str, Taught] = {}
        self._progress: Progress | None = None
        self._early: Early | None = None

    def start(self, grammar: Grammar) -> None:
        require_english(grammar, self.manager.notice)
        # The same lexicon for both: it may have changed since the engine was opened.
        lexicon = load_lexicon()
        habits = Habits(lexicon)
        graph = grammar.graph()
        search, rivals = Search(compiled(graph, habits)), Rivals(habits)
        spoken = SpokenWords(graph.slots, lexicon, habits)
        with self._work:
            self._search, self._rivals, self._spoken = search, rivals, spoken
            self._progress = None
            self._early = None

    def know(self, slot: str, sounds: Mapping[str, tuple[str, ...]]) -> None:
        self._taught = {**self._taught, slot: tuple(sounds.items())}

    def advance(self, segment: Segment, rules: Collection[str] | None = None) -> str:
        active = None if rules is None else frozenset(rules)
        with self._work:
            if self._search is None or segment.samples is None:
                return ""
            if segment.quiet >= SILENT_AFTER:
                return listed(self._whole(segment, segment.samples, active, self._search).text)
            progress = self._progress_of(segment, active, self._search)
            new = leveled(segment.samples)[progress.taken :]
            progress.taken += len(new)
            progress.search.advance(scores_of(progress.stream.push(new)))
            return listed(said(progress.search.partial()))

    def _progress_of(
        self, segment: Segment, rules: frozenset[str] | None, search: Search
    ) -> Progress:
        """What is known of a piece; nothing as yet when it is a new one."""
        progress = self._progress
        if progress is None or progress.number != segment.number or progress.rules != rules:
            search.begin(rules)
            progress = Progress(segment.number, rules, PosteriorStream(self._network), search)
            self._progress = progress
        return progress

    def _decode(
        self, segment: Segment, samples: Samples, rules: Collection[str] | None
    ) -> Hypothesis:
        active = None if rules is None else frozenset(rules)
        with self._work:
            if self._search is None:
                raise self.not_available("it has no grammar", "call start with a grammar first")
            return self._whole(segment, samples, active, self._search)

    def _whole(
        self,
        segment: Segment,
        samples: Samples,
        rules: frozenset[str] | None,
        search: Search,
    ) -> Hypothesis:
        """Decode all of a piece, unless that has been done since the voice fell silent."""
        early = self._early
        if early is None or not early.holds_for(segment, samples, rules):
            self._progress = None  # Its search is used for the whole.
            sound = leveled(samples)
            part = sounding(sound)
            heard = self._network.posteriors(sound[part])
            found = self._decoded(sound[part], heard, rules, noise_of(sound), search)
            hypothesis = later(found, part.start / self.rate)
            early = Early(segment, rules, hypothesis)
            self._early = early
        return early.hypothesis

    def _hear_slots(self, path: Path, scores: Floats) -> Mapping[int, HeardSlot]:
        return self._spoken.heard(path, scores, self._taught)

    def _decoded(
        self,
        sound: Sound,
        heard: Floats,
        rules: frozenset[str] | None,
        noise: float,
        search: Search,
    ) -> Hypothesis:
        """What a piece says; where that is not clear, without what is only "um"."""
        found = decoded(search, self._rivals, heard, rules, noise, self._hear_slots)
        if found.confidence >= CLEAR or not (parts := hesitations(sound, heard)):
            return found
        rest = decoded(search, self._rivals, without(heard, parts), rules, noise, self._hear_slots)
        if rest.confidence <= found.confidence and not rest.begun:
            return found
        is_at_end = parts[-1].stop * round(FRAME * self.rate) >= len(sound) - KEPT - STILL
        return replace(rest, begun=rest.begun or rest.text) if is_at_end else rest


def decoded(
    search: Search,
    rivals: Rivals,
    log_probabilities: Floats,
    rules: Collection[str] | None = None,
    noise: float = 0.0,
    hear_slots: HearSlots | None = None,
) -> Hypothesis:
    """The best sentence of a whole piece of speech, and what else it may have been.

    `noise` is how noisy the piece is, 0 to 1; `hear_slots` makes words of free slots.
    """
    scores = scores_of(log_probabilities)
    search.begin(rules)
    search.advance(scores)
    begun = _begun(search, log_probabilities)
    found = sorted(ranked(search, scores, rivals), key=lambda one: is_too_long(one.path))
    if not found:
        return Hypothesis("", 0.0, begun=begun)
    phones = search.graph.phones
    if has_free(found[0].path):
        sure = confidence_in_phrase(found[0].path, log_probabilities, phones, noise)
        beside = said_beside(found[0].path, search, log_probabilities, rules, noise)
        found, sure, held = joined(found, sure, list(beside))
    else:
        rival = rivals.score(scores, found[0].path.words) + unproven(found[0].path, search.graph)
        sure, held = confidence(fit_of(found[0].path, rival, scores, phones), noise), []
    best = found[0].path
    slots = hear_slots(best, scores) if hear_slots is not None else {}
    chances = shares([candidate.score for candidate in found])
    alternatives = [
        Alternative(said(candidate.path.words), float(chance))
        for candidate, chance in zip(found[1:], chances[1:], strict=True)
    ]
    alternatives += [Alternative(said(one.path.words), one.confidence) for one in held]
    spelled = [
        slots[place].text if place in slots else word for place, word in enumerate(best.words)
    ]
    return Hypothesis(
        said(spelled),
        sure,
        _words(best, word_chances(best, log_probabilities, phones)),
        tuple(alternatives),
        begun,
        slots=tuple(slots.values()),
    )


def _begun(search: Search, log_probabilities: Floats) -> str:
    """The words of a sentence that cannot end yet, where that is what was said."""
    path = search.begun()
    if path is None or not path.words or path.score < CLEARLY_BEGUN or has_free(path):
        return ""
    fit = phrase_fit(path, log_probabilities, search.graph.phones)
    return said(path.words) if fit.nearness >= NEARLY_SAID else ""


def unproven(path: Path, graph: PhoneGraph) -> float:
    """Natural log: what a sentence is worth because it is expected, which does not show that it was
    said: all of it for a short one, since noise sounds like "no", too; nothing for a longer one.
    """
    letters = sum(map(len, path.words))
    return graph.head_start(span.place for span in path.spans) * float(
        np.clip(2.0 - letters / SHORT, 0.0, 1.0)
    )


def later(hypothesis: Hypothesis, seconds: float) -> Hypothesis:
    """The same, with its words shifted later by an offset, seconds."""
    words = tuple(
        replace(word, start=round(word.start + seconds, 3), end=round(word.end + seconds, 3))
        for word in hypothesis.words
    )
    return replace(hypothesis, words=words)


def _words(path: Path, chances: Sequence[float]) -> tuple[HeardWord, ...]:
    """The words with their chances and the times of their phones; pauses and free words belong to
    none.
    """
    heard = []
    listed = [free_words(word) is None for word in path.words]
    parts = zip(compress(path.words, listed), compress(path.spans, listed), chances, strict=True)
    for word, span, chance in parts:
        sounding = [index for index, state in enumerate(span.states) if state >= 0]
        start, end = span.start + sounding[0], span.start + sounding[-1] + 1
        heard.append(
            HeardWord(word, round(start * FRAME, 3), round(end * FRAME, 3), round(chance, 4))
        )
    return tuple(heard)
