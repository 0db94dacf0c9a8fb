"""Values handed from a network to plain code."""

from __future__ import annotations

from typing import Any, Protocol

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input


class Callback(Protocol):
    """A receiver of values."""

    def handle_input(self, behavior: CallbackBehavior, port: str, data: Any) -> None:
        """A value came in at a port of that behavior; called in the tick, so do not block."""


class CallbackBehavior(Behavior):
    """Passes each input value to its callbacks.

    network["tell"].add(self)    # self has handle_input(behavior, port, data)
    """

    input = Input[Any]("any", "values of any datatype, any count of links")

    def __init__(self, id: str = "", **parameters: Any) -> None:
        super().__init__(id, **parameters)
        self._callbacks: list[Callback] = []

    def add(self, callback: Callback) -> None:
        """Call this one from now on."""
        self._callbacks.append(callback)

    def remove(self, callback: Callback) -> None:
        """Stop calling it; ignored if it was never added."""
        if callback in self._callbacks:
            self._callbacks.remove(callback)

    def compute(self, now: float, dt: float) -> None:
        for value in self.input.values:
            for callback in tuple(self._callbacks):
                callback.handle_input(self, "input", value)
