"""The behaviors of speech: ears and mouth."""

from __future__ import annotations

from hri.behavior.behavior import Context
from hri.behavior.effects import Effect
from hri.behavior.ports import Input, Param
from hri.core.origin import caused_by
from hri.speech.listener import Listener
from hri.speech.voice import Saying, Voice

__all__ = ["Listener", "Saying", "SpeakOn", "Voice"]


class SpeakOn(Voice):
    """Says its text each time its input becomes true."""

    may_do = frozenset({Effect.SPEAKS})
    trigger = Input[bool]("boolean", "what makes it speak when it becomes true")
    text = Param("hello", "what it says")

    def start(self, context: Context) -> None:
        super().start(context)
        self._was_true = False

    def compute(self, now: float, dt: float) -> None:
        is_true = bool(self.trigger.value)
        if is_true and not self._was_true:
            with caused_by(self.trigger.origin):
                self.say(self.text)
        self._was_true = is_true
        super().compute(now, dt)
