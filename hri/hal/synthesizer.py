"""The speech synthesizer interface."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable

from hri.core.signals import Prosody, Speech
from hri.hal.resource import Resource

PLAIN = Prosody()


class Synthesizer(Resource):
    """Turns text into sound with the times of its phonemes.

    `synthesize` is all that a voice must have. One that makes its sound bit by bit overrides
    `stream` as well, so that the first of it is heard before the last is made.
    """

    @abstractmethod
    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        """The speech; may take a while, so call it from a worker. Safe from several threads."""

    def stream(
        self,
        text: str,
        prosody: Prosody,
        take: Callable[[Speech], object],
        is_wanted: Callable[[], bool],
    ) -> Speech:
        """The same speech, and what there is of it handed over while it is made.

        Each speech that `take` gets goes on where the one before ended; the whole one is returned
        and handed over last. It ends early, with what there is, as soon as `is_wanted` says no.
        """
        speech = self.synthesize(text, prosody)
        take(speech)
        return speech
