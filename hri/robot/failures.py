"""A robot says when one of its tasks has failed: the one before it does not read its log."""

from __future__ import annotations

import math
import re

from hri.core.signals import Event
from hri.speech.behaviors import Voice
from hri.task.context import TaskContext

AGAIN_AFTER = 60.0
"""Seconds in which a task that fails again and again is told of once."""
PATIENCE = 10.0
"""Seconds for the sentence of a robot that then ends."""


class FailureTeller:
    """Says which task failed, each once a minute, unless the voice was asked for quiet."""

    def __init__(self, context: TaskContext) -> None:
        self._context = context
        self._told: dict[str, float] = {}
        context.events.subscribe("task.failed", self._hear)

    def _hear(self, event: Event) -> None:
        self.tell(str(event.properties["task"]))

    def tell(self, task: str) -> None:
        """Say it of a task, unless it was said of it just now."""
        now = self._context.clock.now()
        voice = self._context.find_behavior(Voice)
        if voice is None or now < voice.quiet_until:
            return
        if now - self._told.get(task, -math.inf) >= AGAIN_AFTER:
            self._told[task] = now
            voice.say(f"Sorry, my task {spoken(task)} failed.")

    async def finish(self) -> None:
        """Wait until it has been said, before the robot ends of it."""
        voice = self._context.find_behavior(Voice)
        with self._context.clock.move_on_after(PATIENCE):
            while voice is not None and not voice.is_idle:
                await self._context.clock.sleep(0.05)


def spoken(name: str) -> str:
    """The name of a task as words: "Hri.LearnObject" is "learn object", "wave_hand" "wave hand"."""
    words = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name.rpartition(".")[2]).replace("_", " ")
    return " ".join(words.lower().split())
