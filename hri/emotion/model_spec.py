"""The emotion model as authored: one personality, all stimuli, and the words for them."""

from __future__ import annotations

from dataclasses import dataclass

from hri.emotion.display import Display, load_display
from hri.emotion.dynamics import Dynamics
from hri.emotion.personality import Personality, load_personality
from hri.emotion.stimulus import StimulusSpec, load_stimuli


@dataclass(frozen=True)
class EmotionModelSpec:
    """All that the files in `emotions/` say for one personality."""

    personality: Personality
    stimuli: dict[str, StimulusSpec]
    display: Display

    def dynamics(self) -> Dynamics:
        """The arithmetic of all this."""
        return Dynamics(self.personality, list(self.stimuli.values()))

    def words(self, label: str, intensity: float) -> str:
        """What the robot is, after "I am", for an intensity from 0 to 1."""
        return self.display.looks[label].said(intensity)


def load_emotions(personality: str) -> EmotionModelSpec:
    """Everything for a personality given by name or path.

    Raises HriError for an unknown name, AuthoringError with the place for a wrong file.
    """
    return EmotionModelSpec(load_personality(personality), load_stimuli(), load_display())
