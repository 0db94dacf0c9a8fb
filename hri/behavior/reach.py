"""What a port can reach: whether what it sends may move the robot, let it speak or release it.

Static: it follows the links of all networks that run, and the slots of the board over which they
hand values to each other. A behavior says what it does with its inputs by `may_do`. One that says
nothing can only compute as long as it has neither a `start`, where it would get devices, slots and
events, nor an `__init__`; else it may do anything. So may the code that watches a port, and tasks,
which read whatever is on the board.
"""

from __future__ import annotations

from collections.abc import Iterable

from hri.behavior.behavior import Behavior
from hri.behavior.effects import ANYTHING, NOTHING, Effect
from hri.behavior.library.sharing import Share
from hri.behavior.runner import Runner

Port = tuple[Behavior, str]
"""A behavior and the name of one of its outputs."""


class Reach:
    """What can be reached in networks that run."""

    def __init__(self, runners: Iterable[Runner], has_tasks: bool) -> None:
        """`has_tasks`: tasks run beside the networks."""
        self._runners = tuple(runners)
        self._behaviors = [one for runner in self._runners for one in runner.network.behaviors]
        self._targets: dict[Port, list[Behavior]] = {}
        for runner in self._runners:
            for link in runner.network.links:
                self._targets.setdefault((link.source, link.output), []).append(link.target)
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
            if id(getattr(*port)) in self._watched:
                return ANYTHING
            for target in self._targets.get(port, ()):
                reached |= self._effects_of(target)
                ahead += [(one, name) for one in self._fed_by(target) for name in one.outputs]
        return reached

    def _effects_of(self, behavior: Behavior) -> frozenset[Effect]:
        is_read = isinstance(behavior, Share) and self._board_is_read
        return ANYTHING if is_read else _may_do(behavior)

    def _fed_by(self, behavior: Behavior) -> list[Behavior]:
        """Those whose outputs depend on what comes into a behavior."""
        if not isinstance(behavior, Share):
            return [behavior]
        slot = behavior.slot
        # Whoever else has a parameter `slot` reads it.
        readers = [one for one in self._behaviors if getattr(one, "slot", None) == slot]
        return [one for one in readers if not isinstance(one, Share)]


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
