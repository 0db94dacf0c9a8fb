"""Gestures of the hands of everyone who is seen, in a network."""

from __future__ import annotations

from collections import deque
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.signals import Hand, HandGesture, People
from hri.vision.gestures.gesture_file import HAND_GESTURE, chosen
from hri.vision.hands.hand_gestures import PeopleHands
from hri.vision.hands.hand_patterns import ANY, FILE, load_hand_patterns
from hri.vision.hands.hand_shape import POINTING, THUMB

MOST = 16
"""Gestures that wait to be sent."""
ALL = "all"


class HandGestures(Behavior):
    """Recognizes gestures of hands, and reports them.

    The events are those of the file of patterns, such as `hand.waved`, each with the `person`, the
    `hand` ("left" or "right", the person's), and `latency`, the seconds since the gesture began.
    A thumb has its `direction`, "up" or "down"; fingers that are held up have their number,
    `fingers`; a hand that points has `bearing` and `elevation`, where to, in radians from the
    robot's ahead to the left, and up.
    """

    category = "vision"

    gestures = Param(ALL, "which ones, with spaces between; all of the file for all")
    patterns = Param(FILE, "the file that says what counts as which gesture")

    people = Input[People]("people", "everyone who is seen, with their hands")
    gesture = Output[HandGesture]("handgesture", "what a hand shows, when it is clear; one a tick")

    def start(self, context: Context) -> None:
        self._events = context.events
        known = load_hand_patterns(paths.find("config", self.patterns))
        names = known if self.gestures.strip() == ALL else self.gestures.split()
        self._rows = {row.gesture: row for row in chosen(known, names, HAND_GESTURE)}
        self._recognizer = PeopleHands(self._rows.values())
        self._unsent: deque[HandGesture] = deque(maxlen=MOST)

    def compute(self, now: float, dt: float) -> None:
        if (people := self.people.value) is not None:
            for gesture in self._recognizer.update(people):
                self._unsent.append(gesture)
                row, hand = self._rows[gesture.kind], gesture.hand
                self._events.raise_event(
                    row.event,
                    person=gesture.person,
                    hand=hand.side,
                    latency=round(gesture.latency, 3),
                    **_shown(row.shape, hand),
                )
        if self._unsent:
            self.gesture.send(self._unsent.popleft())


def _shown(shape: str, hand: Hand) -> dict[str, Any]:
    """What a hand says beside that it has a shape."""
    if shape == THUMB:
        is_up = hand.landmarks[4, 1] < hand.landmarks[2, 1]
        return {"direction": "up" if is_up else "down"}
    if shape == POINTING:
        to, up = hand.pointing_bearing, hand.pointing_elevation
        return {"bearing": round(to, 3), "elevation": round(up, 3)}
    return {"fingers": hand.fingers} if shape == ANY else {}
