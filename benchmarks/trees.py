"""Behavior trees of py_trees, to compare with; `hri bench behavior` asks for them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import py_trees
from py_trees.common import ParallelPolicy, Status


class Leaf(py_trees.behaviour.Behaviour):
    """Does nothing, with the status it is given."""

    def __init__(self, name: str, status: Any) -> None:
        super().__init__(name)
        self.answer = status

    def update(self) -> Any:
        return self.answer


def sequence(count: int) -> Callable[[], object]:
    """One tick of a sequence of leaves that all succeed."""
    root = py_trees.composites.Sequence("root", memory=False)
    root.add_children([Leaf(str(number), Status.SUCCESS) for number in range(count)])
    return root.tick_once


def parallel(count: int) -> Callable[[], object]:
    """One tick of leaves that all run beside each other."""
    root = py_trees.composites.Parallel("root", policy=ParallelPolicy.SuccessOnAll())
    root.add_children([Leaf(str(number), Status.RUNNING) for number in range(count)])
    return root.tick_once
