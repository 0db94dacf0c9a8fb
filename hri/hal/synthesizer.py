"""The speech synthesiser interface."""

from abc import abstractmethod

from hri.core.signals import Prosody, Speech
from hri.hal.resource import Resource

PLAIN = Prosody()


class Synthesizer(Resource):
    """Turns text into sound with the times of its phonemes."""

    @abstractmethod
    def synthesize(self, text: str, prosody: Prosody = PLAIN) -> Speech:
        """The speech; may take a while, so call it from a worker. Safe from several threads."""
