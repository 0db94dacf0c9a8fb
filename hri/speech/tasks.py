"""What tasks do with speech."""

from __future__ import annotations

from hri.speech.behaviors import Voice
from hri.task.context import TaskContext

LOOK_EVERY = 0.02
"""Seconds between looks at whether it has been said."""


async def say(context: TaskContext, text: str) -> None:
    """Say a text and wait until it has been said or cut; when cancelled, it is cut."""
    voice = context.behavior(Voice)
    saying = voice.say(text)
    try:
        while not saying.is_done:
            await context.clock.sleep(LOOK_EVERY)
    finally:
        voice.cancel(saying)
