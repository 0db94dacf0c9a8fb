"""The dynamics of WASABI, to compare with: emotion and mood as springs, stepped at a fixed rate.

C. Becker-Asano, "WASABI: Affect Simulation for Agents with Believable Interactivity", 2008. The
recurrence and the constants are those of its program, which adds the emotion to the mood at each
step whatever its length: what is felt depends on the rate at which the program runs.
"""

from __future__ import annotations

MASS = 1000.0
EMOTION_SPRING = 50.0
MOOD_SPRING = 10.0
SLOPE = 5.0
"""How much of the emotion goes into the mood, of the mass, a step."""
LARGEST = 100.0


class Spring:
    """A mass on a spring that stops where it crosses zero."""

    def __init__(self, stiffness: float) -> None:
        self._rate = stiffness / MASS
        self._velocity = 0.0
        self.value = 0.0

    def push(self, impulse: float) -> None:
        """Displace it and let it go."""
        self.value = min(max(self.value + impulse, -LARGEST), LARGEST)
        self._velocity = 0.0

    def step(self, dt: float, added: float = 0.0) -> None:
        """`dt` seconds later, displaced by `added` in this step."""
        self._velocity -= self._rate * self.value * dt
        value = self.value + self._velocity * dt + added
        if value * self.value < 0:
            value = self._velocity = 0.0
        self.value = min(max(value, -LARGEST), LARGEST)


class Wasabi:
    """Emotion and mood, each -100 to 100."""

    def __init__(self) -> None:
        self.emotion = Spring(EMOTION_SPRING)
        self.mood = Spring(MOOD_SPRING)

    def feel(self, impulse: float) -> None:
        """Something happened, -100 (bad) to 100 (good)."""
        self.emotion.push(impulse)
        self.mood.push(0.0)

    def step(self, dt: float) -> None:
        """`dt` seconds later."""
        self.emotion.step(dt)
        self.mood.step(dt, SLOPE * self.emotion.value / MASS)
