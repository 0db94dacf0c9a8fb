"""Recognizes the gestures of hands in the looks at them: one that is held, or one that swings."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Sequence

import numpy as np

from hri.core.signals import Hand, HandGesture, People
from hri.vision.gestures.oscillation import Swing, ZigZag
from hri.vision.hands.hand_patterns import HandPattern

KEPT = 3.0
"""Seconds of looks that are remembered."""
MOST = 100
"""Looks that are remembered, whatever their rate."""
LEAST_LOOKS = 3
"""Looks that show a gesture: one or two may be wrong."""
GAP = 0.7
"""Seconds between two looks, after which what was seen before does not count."""
AGAIN = 0.9
"""Seconds for which a hand must not have shown a gesture before the same counts again."""
MIDDLE, TIP = 9, 12
"""The knuckle and the tip of the middle finger."""


class HandMemory:
    """What one hand did of late."""

    def __init__(self, patterns: Sequence[HandPattern]) -> None:
        self._patterns = patterns
        self._looks: deque[Hand] = deque(maxlen=MOST)
        self._swings = ZigZag()
        self._least = min((row.width for row in patterns if row.swings), default=1.0)
        self._shown = {row.gesture: -math.inf for row in patterns}
        """Seconds, when each gesture was told, or shown since then."""

    def update(self, hand: Hand) -> list[HandPattern]:
        """Take a look at the hand; the gestures that are complete with it."""
        if self._looks and hand.time - self._looks[-1].time > GAP:
            self._looks.clear()
            self._swings = ZigZag()
        self._looks.append(hand)
        while hand.time - self._looks[0].time > KEPT:
            self._looks.popleft()
        size = _palm(self._looks)
        if not (math.isfinite(size) and size > 0):
            return []
        # Seen from the wrist: who talks with the hands moves them, and who waves turns them.
        x = float(hand.landmarks[TIP, 0] - hand.landmarks[0, 0]) / size
        self._swings.update(hand.time, x, self._least)
        found = []
        for row in self._patterns:
            is_shown = self._swings_fit(row) if row.swings else self._is_held(row, size)
            was_shown = hand.time - self._shown[row.gesture] < AGAIN
            if is_shown or (was_shown and row.fits(hand)):
                self._shown[row.gesture] = hand.time
            if is_shown and not was_shown:
                found.append(row)
        return found

    def began(self, row: HandPattern) -> float:
        """Seconds, when a gesture that is complete now began."""
        if row.swings:
            return self._last_swings(row)[0].start
        return self._held(row)[0].time

    def _held(self, row: HandPattern) -> list[Hand]:
        """The looks of the time for which the shape must be kept, and the one before."""
        now = self._looks[-1].time
        inside = [look for look in self._looks if now - look.time < row.hold]
        before = [look for look in self._looks if now - look.time >= row.hold]
        return [*before[-1:], *inside]

    def _is_held(self, row: HandPattern, size: float) -> bool:
        looks = self._held(row)
        if len(looks) < LEAST_LOOKS or looks[-1].time - looks[0].time < row.hold:
            return False
        fitting = [look for look in looks if row.fits(look)]
        if not row.fits(looks[-1]) or len(fitting) < row.share * len(looks):
            return False
        if len({look.fingers for look in fitting}) > 1 and row.shape == "any":
            return False
        places = np.array([look.landmarks[[MIDDLE, TIP], :2] for look in looks])
        knuckle, tip = np.ptp(places, axis=0).max(axis=1)
        # A hand that waves turns about the wrist, from which the tip is twice as far away.
        return bool(max(knuckle, tip / 2) <= row.still * size)

    def _last_swings(self, row: HandPattern) -> list[Swing]:
        return self._swings.swings()[-row.swings :]

    def _swings_fit(self, row: HandPattern) -> bool:
        swings = self._last_swings(row)
        now = self._looks[-1].time
        if len(swings) < row.swings or now - swings[-1].end > row.duration:
            return False
        if not all(
            abs(swing.width) >= row.width and swing.end - swing.start <= row.duration
            for swing in swings
        ):
            return False
        looks = [look for look in self._looks if look.time >= swings[0].start]
        return sum(map(row.fits, looks)) >= max(LEAST_LOOKS, row.share * len(looks))


class PeopleHands:
    """Recognizes the gestures of each hand of each person by itself."""

    def __init__(self, patterns: Iterable[HandPattern]) -> None:
        self._patterns = tuple(patterns)
        self._hands: dict[tuple[str, int], tuple[float, HandMemory]] = {}

    def update(self, people: People) -> list[HandGesture]:
        """The gestures that are complete now; a hand that was not looked at again shows none."""
        found, hands = [], {}
        for person in people.persons:
            for hand in person.hands:
                key = person.id, hand.number
                looked, memory = self._hands.get(key, (-math.inf, None))
                memory = memory or HandMemory(self._patterns)
                if hand.time > looked and np.isfinite(hand.landmarks).all():
                    for row in memory.update(hand):
                        latency = hand.time - memory.began(row)
                        told = HandGesture(row.gesture, hand.time, hand, person.id, latency)
                        found.append(told)
                hands[key] = max(looked, hand.time), memory
        self._hands = hands
        return found


def _palm(looks: Iterable[Hand]) -> float:
    """Pixels of the palm from the wrist, when it was seen longest; in depth too, for a fist that
    is held to the camera."""
    return max(float(np.linalg.norm(look.landmarks[MIDDLE] - look.landmarks[0])) for look in looks)
