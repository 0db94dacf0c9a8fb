"""The dynamics of WASABI, to compare with: emotion and mood as springs, stepped at a fixed rate.

C. Becker-Asano, "WASABI: Affect Simulation for Agents with Believable Interactivity", 2008. The
recurrence and the constants are those of its program, which adds the emotion to the mood at each
step whatever its length: the result depends on the rate at which the program runs.
"""

from __future__ import annotations

from typing import Any

MASS = 1000.0
EMOTION_SPRING = 50.0
MOOD_SPRING = 10.0
SLOPE = 5.0
"""How much of the emotion goes into the mood, of the mass, a step."""
LARGEST = 100.0
IMPULSE = 60.0
"""What it is given to feel, of LARGEST."""


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


def peaks(seconds: int) -> dict[str, Any]:
    """The highest mood after an impulse, by the rate at which it is stepped."""
    highest = {rate: _peak(rate, seconds) for rate in (10, 50, 1000)}
    return {
        "wasabi_peak_mood": {f"{rate}_hz": round(peak, 2) for rate, peak in highest.items()},
        "wasabi_50_hz_over_10_hz": round(highest[50] / highest[10], 2),
    }


def _peak(rate: int, seconds: int) -> float:
    wasabi, peak = Wasabi(), 0.0
    wasabi.feel(IMPULSE)
    for _ in range(seconds * rate):
        wasabi.step(1 / rate)
        peak = max(peak, wasabi.mood.value)
    return peak
