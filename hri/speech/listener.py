"""The ears of the robot as a behavior."""

from __future__ import annotations

from collections import deque

import numpy as np

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.clock import Worker
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Rejection, Utterance
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Hypothesis, Recognizer, Segment
from hri.speech.grammar import Grammar, load_grammar
from hri.speech.judgement import judge

MOST_WAITING = 20
"""Pieces of speech that wait for their turn; beyond it the oldest are forgotten."""

Decoded = tuple[Segment, bool, Hypothesis] | None
"""A piece of speech, whether the robot spoke meanwhile, its words; None when models are loaded."""


class Listener(Behavior):
    """Hears what the grammar allows: sound in, utterances out.

    Raises `speech.heard` (text, rule, tags, confidence) and `speech.rejected` (reason, text,
    confidence). Loads its models while the rest already runs; what is said meanwhile waits.
    """

    category = "speech"

    is_speaking = Input[bool](
        "boolean", "whether the robot speaks; then few rules count", is_optional=True
    )
    utterance = Output[Utterance]("utterance", "what was heard, when something was")
    is_hearing = Output[bool]("boolean", "whether a voice is going on")
    microphone_id = Param("microphone", "resource that hears")
    recognizer_id = Param("recognizer", "resource that finds the words")
    grammar = Param("companion", "name or path of the grammar")
    strictness = Param(0.5, "confidence from which words count", minimum=0.0, maximum=1.0)
    interrupting = Param("stop", "rules that count while the robot speaks, spaces between")
    latency_s = Param(0.15, "time that finding the words takes on a fake clock", minimum=0.0)

    loaded_grammar: Grammar
    """What is understood; there once the behavior has started."""
    is_muted = False
    """Set it to be deaf for a while."""

    def check(self) -> None:
        known = load_grammar(paths.find("grammars", self.grammar)).public_rules
        for rule in self.interrupting.split():
            if rule not in known:
                remedy = did_you_mean(rule, known)
                raise HriError(f'{self.id}: interrupting names no rule "{rule}" - {remedy}')

    def start(self, context: Context) -> None:
        self.loaded_grammar = load_grammar(paths.find("grammars", self.grammar))
        self._events = context.events
        self._recognizer = context.resources.obtain(self.recognizer_id, Recognizer)
        microphone = context.resources.obtain(self.microphone_id, Microphone)
        self._ear = microphone.listen(self._recognizer.rate)
        self._waiting: deque[tuple[Segment, bool]] = deque(maxlen=MOST_WAITING)
        self._has_spoken = False
        self._worker: Worker[Decoded] = context.clock.worker(self.latency_s)
        self._worker.submit(self._load)

    def _load(self) -> None:
        self._recognizer.start(self.loaded_grammar)

    @property
    def is_idle(self) -> bool:
        """True when nothing that was heard is still on its way to be understood."""
        return not (self._waiting or self._worker.is_busy or self._recognizer.is_hearing)

    def compute(self, now: float, dt: float) -> None:
        self._listen(now)
        for decoded in self._worker.poll():
            if decoded is not None:
                self._tell(*decoded)
        if self._waiting and not self._worker.is_busy:
            segment, has_spoken = self._waiting.popleft()
            self._worker.submit(lambda: self._decode(segment, has_spoken))
        self.is_hearing.send(self._recognizer.is_hearing)

    def _listen(self, now: float) -> None:
        """Feed the endpointer; remember whether the robot spoke during each piece."""
        samples = self._ear.read(now)
        if self.is_muted:
            samples = np.zeros_like(samples)
        is_speaking = bool(self.is_speaking.value)
        was_hearing = self._recognizer.is_hearing
        segments = self._recognizer.listen(samples, now)
        if self._ear.has_ended and self._recognizer.is_hearing:
            segments += self._recognizer.flush()
        if was_hearing or self._recognizer.is_hearing:
            self._has_spoken |= is_speaking
        self._waiting.extend((segment, self._has_spoken or is_speaking) for segment in segments)
        if not self._recognizer.is_hearing:
            self._has_spoken = False

    def _decode(self, segment: Segment, has_spoken: bool) -> Decoded:
        return segment, has_spoken, self._recognizer.decode(segment)

    def _tell(self, segment: Segment, has_spoken: bool, hypothesis: Hypothesis) -> None:
        only = self.interrupting.split() if has_spoken else None
        result = judge(self.loaded_grammar, segment, hypothesis, self.strictness, only)
        confidence = round(result.confidence, 3)
        if isinstance(result, Rejection):
            self._events.raise_event(
                "speech.rejected", reason=result.reason, text=result.text, confidence=confidence
            )
            return
        self.utterance.send(result)
        self._events.raise_event(
            "speech.heard",
            text=result.text,
            rule=result.rule,
            tags=dict(result.tags),
            confidence=confidence,
        )

    def stop(self) -> None:
        self._ear.close()
        self._worker.close()
