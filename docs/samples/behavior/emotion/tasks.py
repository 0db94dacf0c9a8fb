"""What happens to the face, and what it says about that."""

from hri.emotion import EmotionModel
from hri.task import TaskContext

STIMULI = ("person_seen", "praise", "bump", "scold", "ignored")
PAUSE = 4.0
"""Seconds to look at the face."""


async def live_through(context: TaskContext) -> None:
    """One thing after the other happens."""
    emotion = context.behavior(EmotionModel)
    for stimulus in STIMULI:
        context.events.raise_event("stimulus.felt", stimulus=stimulus)
        await context.clock.sleep(PAUSE / 2)
        print(f"{stimulus}: {emotion.why_words()}", flush=True)
        await context.clock.sleep(PAUSE / 2)
