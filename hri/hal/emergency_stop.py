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

    @abstractmethod
    def unlatch(self) -> None:
        """Someone says that it may move: never call this by yourself."""

    @abstractmethod
    def explain(self) -> str:
        """What to answer to "why did you stop?"."""
