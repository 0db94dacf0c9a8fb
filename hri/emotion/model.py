"""The emotion model as authored: one personality, all stimuli, and the words for them."""

from __future__ import annotations

from dataclasses import dataclass

from hri.emotion.display import Display, load_display
from hri.emotion.dynamics import Affect, Dynamics
from hri.emotion.personality import Personality, load_personality
from hri.emotion.stimulus import TEMPERAMENT, StimulusSpec, load_stimuli

_WORTH_SAYING = 0.2
"""A cause with a smaller share is not mentioned."""
_MOST_CAUSES = 2


@dataclass(frozen=True)
class EmotionModelSpec:
    """All that the files in `emotions/` say for one personality."""

    personality: Personality
    stimuli: dict[str, StimulusSpec]
    display: Display

    def dynamics(self) -> Dynamics:
        return Dynamics(self.personality, list(self.stimuli.values()))

    def words(self, label: str) -> str:
        """What the robot is, after "I am"."""
        return self.display.looks[label].words

    def why_words(self, dynamics: Dynamics, affect: Affect) -> str:
        """One sentence: what the robot feels, and what made it so."""
        feeling = f"I am {self.words(dynamics.read(affect).label)}"
        causes = [name for name, share in dynamics.why(affect) if share >= _WORTH_SAYING]
        if not causes:
            return f"{feeling}, and there is no special reason."
        reasons = " and ".join(self._reason(name) for name in causes[:_MOST_CAUSES])
        return f"{feeling} because {reasons}."

    def _reason(self, cause: str) -> str:
        return "that is how I am" if cause == TEMPERAMENT else self.stimuli[cause].words


def load_emotions(personality: str) -> EmotionModelSpec:
    """Everything for a personality given by name or path.

    Raises HriError for an unknown name, AuthoringError with the place for a wrong file.
    """
    return EmotionModelSpec(load_personality(personality), load_stimuli(), load_display())
