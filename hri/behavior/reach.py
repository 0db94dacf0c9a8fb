"""What a port can reach: whether what it sends may move the robot, let it speak or release it.

Static: it follows the links of all networks that run, and the slots of the board over which they
hand values to each other. A behavior says what it does with its inputs by `may_do`. One that says
nothing can only compute as long as it has neither a `start`, where it would get devices, slots and
events, nor an `__init__`; else it may do anything. So may the code that watches a port, and tasks,
which read whatever is on the board.
"""

from __future__ import annotations

from collections.abc import Iterable

from hri.behavior.behavior import Behavior, Running
from hri.behavior.board import BoardSink, BoardSource
from hri.behavior.effects import ANYTHING, NOTHING, Effect
from hri.behavior.library.sharing import Share

Port = tuple[Behavior, str]
"""A behavior and the name of one of its ports."""


class Reach:
    """What can be reached in networks that run."""

    def __init__(self, runners: Iterable[Running], has_tasks: bool) -> None:
        """`has_tasks`: tasks run beside the networks."""
        self._runners = tuple(runners)
        self._behaviors = [one for runner in self._runners for one in runner.network.behaviors]
        self._targets: dict[Port, list[Port]] = {}
        for runner in self._runners:
            for link in runner.network.links:
                targets = self._targets.setdefault((link.source, link.output), [])
                targets.append((link.target, link.input))
        self._watched = {id(port) for runner in self._runners for port in runner.watched}
        self._board_is_read = has_tasks or any(
            _may_do(one) == ANYTHING for one in self._behaviors if not isinstance(one, Share)
        )

    def of(self, behavior: Behavior, output: str) -> frozenset[Effect]:
        """What values that this output sends may do."""
        reached = NOTHING
        ahead, seen = [(behavior, output)], set[Port]()
        while ahead and reached != ANYTHING:
            port = ahead.pop()
            if port in seen:
                continue
            seen.add(port)
            if id(port[0].output_port(port[1])) in self._watched:
                return ANYTHING
            for target, input in self._targets.get(port, ()):
                if (slot := _written(target, input)) is None:
                    reached |= _may_do(target)
                    ahead += [(target, name) for name in target.outputs]
                else:
                    reached |= ANYTHING if self._board_is_read else NOTHING
                    ahead += self._readers(slot)
        return reached

    def _readers(self, slot: str) -> list[Port]:
        """The outputs that depend on what stands in a slot."""
        found: list[Port] = []
        for one in self._behaviors:
            if isinstance(one, BoardSource):
                found += [(one, slot)] if slot in one.outputs else []
            # Whoever else has a parameter `slot` reads it.
            elif getattr(one, "slot", None) == slot and not isinstance(one, Share):
                found += [(one, name) for name in one.outputs]
        return found


def _written(target: Behavior, input: str) -> str | None:
    """The slot of the board that an input writes."""
    if isinstance(target, Share):
        return target.slot
    return input if isinstance(target, BoardSink) else None


def _may_do(behavior: Behavior) -> frozenset[Effect]:
    """What a behavior declares, or anything where it declares nothing and does not only compute."""
    for owner in (behavior, *type(behavior).__mro__):
        if owner is Behavior:
            break
        if "may_do" in vars(owner):
            return behavior.may_do
        if "start" in vars(owner) or "__init__" in vars(owner):
            return ANYTHING
    return NOTHING
