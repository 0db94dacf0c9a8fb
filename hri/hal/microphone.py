"""The microphone interface."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING

from hri.core.signals import Samples
from hri.hal.ear import Ear
from hri.hal.resource import Description, Resource

if TYPE_CHECKING:
    from hri.hal.manager import ResourceManager


class Microphone(Resource):
    """Mono sound at a fixed rate, for as many ears as listen."""

    rate: int = 16000
    """Samples a second."""

    def __init__(self, description: Description, manager: ResourceManager) -> None:
        super().__init__(description, manager)
        self._ears: list[Ear] = []

    @abstractmethod
    def read(self, now: float) -> Samples:
        """All samples since the last call, possibly none; never waits.

        What one caller takes no other gets: programs use `listen`.
        """

    def listen(self, rate: int | None = None) -> Ear:
        """An ear of your own, at the rate you want; close it when you have heard enough."""
        return Ear(self, self._ears, rate or self.rate)

    @property
    def has_ended(self) -> bool:
        """True when no further sound will come (a file is spent)."""
        return False
