"""Where a person's turn ends, and what was said in it: decided in its pauses, by the grammar.

People pause within their sentences as long as between them. So each pause is looked at when it is
0.16 s old: a sentence that nothing can change ends soon, one that may go on after the usual pause,
and one that cannot end yet is waited for. Who goes on soon after that goes on with the same
sentence where the grammar has one: what was understood is then taken back. Where it has none, two
sentences were said.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from hri.core.signals import Rejection, Samples, Utterance
from hri.hal.recognizer import Recognizer, Segment
from hri.speech.endpoint import LONGEST
from hri.speech.grammar import Grammar
from hri.speech.grammar.continuation import may_go_on
from hri.speech.turn import Turn
from hri.speech.understanding import Heard, anticipate, explained

COMPLETE, UNFINISHED = 0.34, 2.0
"""Usual pauses, of 0.6 s, that end a sentence which nothing can change, and one that has only
begun."""
GOES_ON = 0.9
"""Seconds from the end of the voice to the first sample of the next piece within which someone goes
on; the voice of that begins up to 0.3 s later."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What was made of a piece of speech up to a pause."""

    heard: tuple[Heard, ...]
    """The sentences that nobody was told of yet, in order."""
    pauses: float = 1.0
    """Usual pauses after which the turn is over, unless the person goes on."""
    continues: bool = False
    """Whether the person went on with the sentence that was told last. Where nothing was
    understood, or heard is empty, that one counts as it was."""


@dataclass(frozen=True, eq=False, slots=True)
class _Sentence:
    """The last sentence that was understood: someone may go on with it."""

    heard: Utterance
    samples: Samples
    """Of all of it."""
    turn: Turn | None
    segment: Segment
    """The piece in which it ends, up to the pause behind it."""
    before: tuple[Heard, ...] = ()
    """The sentences before it that nobody was told of yet."""
    replaces: bool = False
    """Whether it stands in the place of one that was told."""
    is_told: bool = False
    """Whether its piece is over."""

    def new_in(self, segment: Segment) -> Samples | None:
        """What was said in a piece since, that may belong to it; None where nothing may."""
        assert segment.samples is not None
        assert self.segment.samples is not None
        if segment.number == self.segment.number:
            return None if self.is_told else segment.samples[len(self.segment.samples) :]
        ended = _voice_end(self.segment)
        is_soon = segment.start < ended + GOES_ON
        # Nobody goes on with one sentence for ever, and its sound is kept meanwhile.
        is_short = ended - self.heard.start < LONGEST
        return segment.samples if self.is_told and is_soon and is_short else None

    def extended(self, heard: Utterance, samples: Samples, segment: Segment) -> _Sentence:
        """The same sentence with more words."""
        replaces = self.is_told or self.replaces
        heard = replace(heard, continues=replaces)
        return _Sentence(heard, samples, self.turn, segment, self.before, replaces)

    def followed(
        self, heard: Utterance, samples: Samples, segment: Segment, turn: Turn | None
    ) -> _Sentence:
        """The sentence after it."""
        before = () if self.is_told else (*self.before, self.heard)
        return _Sentence(heard, samples, turn, segment, before, self.replaces)

    def goes_on_as(self, whole: Utterance, alone: Heard) -> bool:
        """Whether one sentence was said, and not this one and what is new `alone` after it."""
        if whole.is_among_others or _is_the_same(whole, self.heard):
            return False
        if isinstance(alone, Rejection) or not _is_the_same(whole, alone):
            return True
        # "Hello robot", "turn left": one sentence where it sounds like one.
        is_clear = whole.confidence >= min(self.heard.confidence, alone.confidence)
        return is_clear and not self.is_told

    def reading(self) -> Reading:
        return Reading((*self.before, self.heard), continues=self.replaces)


@dataclass(frozen=True, eq=False, slots=True)
class _Pause:
    """What is known of a piece at a pause."""

    segment: Segment
    grammar: Grammar
    turn: Turn | None
    reading: Reading
    sentence: _Sentence | None

    def is_in(self, segment: Segment, grammar: Grammar, turn: Turn | None) -> bool:
        """Whether nothing was said in a piece since."""
        is_same = self.segment.number == segment.number and self.turn == turn
        return is_same and self.grammar is grammar and not segment.goes_on_from(self.segment)


class TurnTaking:
    """Reads what people say, piece by piece; for the worker that decodes."""

    def __init__(self, engine: Recognizer) -> None:
        self._engine = engine
        self._pause: _Pause | None = None

    def has_read(self, segment: Segment, grammar: Grammar, turn: Turn | None) -> bool:
        """Whether nothing was said since the last `read`, so that `end` takes no time."""
        return self._pause is not None and self._pause.is_in(segment, grammar, turn)

    def read(
        self, segment: Segment, grammar: Grammar, strictness: float, turn: Turn | None
    ) -> Reading:
        """What was said up to a pause of an open piece."""
        pause = self._pause
        if pause is None or not pause.is_in(segment, grammar, turn):

            def judged(samples: Samples, turn: Turn | None) -> Heard:
                part = segment
                if samples is not segment.samples:
                    start = segment.end - len(samples) / self._engine.rate
                    part = replace(segment, samples=samples, start=start)
                return _finished(anticipate(self._engine, grammar, part, strictness, turn), grammar)

            is_interrupting = turn is not None and turn.is_speaking
            is_known = pause is not None and pause.grammar is grammar and not is_interrupting
            before = pause.sentence if pause is not None and is_known else None
            reading, sentence = _read(segment, before, turn, judged)
            reading = replace(reading, pauses=_pauses(reading))
            pause = self._pause = _Pause(segment, grammar, turn, reading, sentence)
        return pause.reading

    def end(
        self, segment: Segment, grammar: Grammar, strictness: float, turn: Turn | None
    ) -> Reading:
        """What was said in a piece that is over; the next one may go on with it."""
        reading = self.read(segment, grammar, strictness, turn)
        assert self._pause is not None
        if (sentence := self._pause.sentence) is not None:
            told = replace(sentence, before=(), replaces=False, is_told=True)
            self._pause = replace(self._pause, sentence=told)
        if reading.heard and isinstance(rejected := reading.heard[-1], Rejection):
            last = explained(self._engine, grammar, segment, strictness, turn, rejected)
            reading = replace(reading, heard=(*reading.heard[:-1], last))
        return reading


def _read(
    segment: Segment,
    sentence: _Sentence | None,
    turn: Turn | None,
    judged: Callable[[Samples, Turn | None], Heard],
) -> tuple[Reading, _Sentence | None]:
    """What a piece says where a sentence may have been understood before, and the last one now."""
    assert segment.samples is not None
    new = None if sentence is None else sentence.new_in(segment)
    if sentence is None or new is None:
        heard = judged(segment.samples, turn)
        if isinstance(heard, Rejection):
            return Reading((heard,)), None
        return Reading((heard,)), _Sentence(heard, segment.samples, turn, segment)
    both = np.concatenate([sentence.samples, new])
    whole, alone = judged(both, sentence.turn), judged(new, turn)
    if isinstance(whole, Utterance) and sentence.goes_on_as(whole, alone):
        last = sentence.extended(whole, both, segment)
        return last.reading(), last
    if isinstance(alone, Utterance):
        last = sentence.followed(alone, new, segment, turn)
        return last.reading(), last
    if sentence.is_told or sentence.replaces:
        added = () if isinstance(whole, Utterance) else (alone,)
        return Reading(added, continues=True), sentence
    return Reading((*sentence.before, whole)), sentence


def _is_the_same(one: Utterance, other: Utterance) -> bool:
    return (one.rule, one.tags) == (other.rule, other.tags)


def _finished(heard: Heard, grammar: Grammar) -> Heard:
    """The same, and whether the speaker may go on with it. Behind "please" nothing follows."""
    if isinstance(heard, Rejection) or heard.text.split()[-1:] != heard.command.split()[-1:]:
        return heard
    rule = heard.follow_up or heard.rule
    return replace(heard, may_go_on=may_go_on(grammar, rule, heard.text, heard.command))


def _pauses(reading: Reading) -> float:
    """Usual pauses after which a turn is over that was read so far."""
    if not reading.heard:
        return 1.0
    heard = reading.heard[-1]
    if heard.begun:
        return UNFINISHED
    return COMPLETE if isinstance(heard, Utterance) and not heard.may_go_on else 1.0


def _voice_end(segment: Segment) -> float:
    return segment.end - segment.quiet
