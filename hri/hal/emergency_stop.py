"""The emergency stop of a base: it stands, and only a person lets it move again."""

from __future__ import annotations

from abc import abstractmethod

from hri.hal.resource import Resource


class EmergencyStop(Resource):
    """What can be stopped for good.

    Neither time nor a command opens the latch, nor does closing and opening the resource: `unlatch`
    does, and it is for something that a person did.
    """

    @property
    @abstractmethod
    def is_latched(self) -> bool:
        """Whether it must not move until it is released."""

    @abstractmethod
    def stop_latched(self, because: str) -> None:
        """Stand still at once, until `unlatch`; `because` ends "I stopped because"."""

    def stop_spoken(self, because: str, said: float) -> None:
        """`stop_latched` for a word that a person said, which ended at that time, in seconds.

        Where nothing else has latched it, `unlatch_spoken` lifts that, too.
        """
        self.stop_latched(because)

    @property
    def is_spoken(self) -> bool:
        """Whether it is latched, and only for stops that a person said."""
        return False

    @abstractmethod
    def unlatch(self) -> None:
        """Someone says that it may move: never call this by yourself."""

    def unlatch_spoken(self, said: float) -> bool:
        """`unlatch` for an order to move that a person began to say at that time, in seconds.

        It counts only for stops that were spoken, and before the order; whether it does.
        """
        return False

    @abstractmethod
    def explain(self) -> str:
        """What to answer to "why did you stop?"."""
