"""A window with a moving face: keys choose its look, and it reloads saved drawings."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hri.core.clock import Clock
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.signals import Image
from hri.face import load_face
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel, stamps_of
from hri.face.renderers.captions import SMALL, add_caption, add_label
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from hri.face.vocabulary import LABELS, TURNS
from hri.hal.screen import Screen

FRAME_S = 1 / 30
FADE_S = 0.3
"""Seconds of the transition between looks."""
CYCLE_S = 2.0
"""Seconds that each look stays while all are shown in turn."""
WATCH_S = 0.25
"""Seconds between checks of the files."""
LEGEND = (
    "left, right, letters: expression; up, down, digits: viseme; space: all; tab: turn; F1: hide"
)
TURNED = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, 0.0), (-1.0, -1.0), (0.0, -1.0))
"""Yaw and pitch, as shares of their limits, that Tab goes through."""


@dataclass(frozen=True)
class ShownFace:
    """The chosen look."""

    expression: str = "neutral"
    viseme: str = ""
    turn: int = 0

    @property
    def label(self) -> str:
        return f"{self.expression}    {self.viseme}".rstrip()


@dataclass
class FaceWindow:
    """A moving face on a screen, controlled by keys; `frame` draws one picture and waits its
    time.
    """

    folder: Path
    screen: Screen
    clock: Clock
    is_watching: bool = False
    seed: int = 0
    is_open: bool = True
    is_cycling: bool = True
    has_legend: bool = True
    refusal: str = ""
    """Why the current drawings are refused; the last good ones are shown."""
    look: ShownFace = field(default_factory=ShownFace)

    def __post_init__(self) -> None:
        self._model = load_face(self.folder)
        self._stamps = self._seen = stamps_of(self.folder)
        self._renderer = self._new_renderer()
        self._before, self._changed = self.look, -FADE_S
        self._watched = self.clock.now()

    @property
    def model(self) -> FaceModel:
        """The last valid version of the face."""
        return self._model

    def frame(self) -> None:
        """Handle keys, check the files, draw, and wait for the next frame."""
        begun = self.clock.now()
        for key in self.screen.pressed_keys():
            self.press(key)
        if self.is_cycling and begun - self._changed >= CYCLE_S:
            self._turn_to(self._next_of_all())
        if self.is_watching and begun - self._watched >= WATCH_S:
            self._watched = begun
            self._watch()
        self.screen.show(self._picture(begun), begun)
        self.is_open = self.is_open and not self.screen.is_closed
        self.clock.advance(max(begun + FRAME_S - self.clock.now(), 0.0))

    def press(self, key: str) -> None:
        """Handle a key; unknown ones are ignored."""
        expressions, visemes = self._expressions, self._visemes
        look = self.look
        if key == "escape":
            self.is_open = False
        elif key == "f1":
            self.has_legend = not self.has_legend
        elif key == "space":
            self.is_cycling = not self.is_cycling
        elif key == "tab":
            self._hold(ShownFace(look.expression, look.viseme, (look.turn + 1) % len(TURNED)))
        elif key in ("left", "right"):
            step = 1 if key == "right" else -1
            self._hold(
                ShownFace(_beside(expressions, look.expression, step), look.viseme, look.turn)
            )
        elif key in ("up", "down"):
            step = 1 if key == "down" else -1
            self._hold(ShownFace(look.expression, _beside(visemes, look.viseme, step), look.turn))
        elif key.isdigit() and len(key) == 1:
            number = (int(key) or 10) % len(visemes)
            self._hold(ShownFace(look.expression, visemes[number], look.turn))
        elif len(key) == 1:
            fitting = [label for label in expressions if label.startswith(key)]
            if fitting:
                self._hold(ShownFace(_beside(fitting, look.expression, 1), look.viseme, look.turn))

    @property
    def _expressions(self) -> list[str]:
        """Without aliases, which look the same."""
        return [label for label in self._model.expressions if label in LABELS]

    @property
    def _visemes(self) -> list[str]:
        """None first, which lets the expression have the mouth."""
        return ["", *self._model.visemes]

    def _hold(self, look: ShownFace) -> None:
        """Show the user's choice."""
        self.is_cycling = False
        self._turn_to(look)

    def _turn_to(self, look: ShownFace) -> None:
        self._before, self.look, self._changed = self.look, look, self.clock.now()

    def _next_of_all(self) -> ShownFace:
        """All expressions, then all visemes on the neutral face, then from the start."""
        looks = [ShownFace(label) for label in self._expressions]
        looks += [ShownFace(viseme=viseme) for viseme in self._model.visemes]
        here = ShownFace(self.look.expression, self.look.viseme)
        return looks[(looks.index(here) + 1) % len(looks)] if here in looks else looks[0]

    def _watch(self) -> None:
        """Load saved drawings, once they do not change any longer."""
        try:
            stamps = stamps_of(self.folder)
        except HriError as error:
            self._stamps = self._seen = ()
            self._refuse(str(error))
            return
        is_settled, self._seen = stamps == self._seen, stamps
        if not is_settled or stamps == self._stamps:
            return
        self._stamps = stamps
        try:
            self._model = load_face(self.folder)
        except HriError as error:
            self._refuse(str(error))
            return
        self._renderer = self._new_renderer()
        self.refusal = ""
        self.look = self._known(self.look)
        self._before = self._known(self._before)
        report(f"{self.folder}: reloaded", flush=True)

    def _refuse(self, reason: str) -> None:
        if reason != self.refusal:
            self.refusal = reason
            report(reason, sys.stderr, flush=True)

    def _new_renderer(self) -> Renderer:
        return Renderer(self._model, (self.screen.width, self.screen.height))

    def _known(self, look: ShownFace) -> ShownFace:
        """The look, or neutral when the face has lost it."""
        return look if look.expression in self._model.expressions else ShownFace()

    def _picture(self, now: float) -> Image:
        share = min(max((now - self._changed) / FADE_S, 0.0), 1.0)
        share = share * share * (3 - 2 * share)
        vector = self._vector(self.look, now)
        if share < 1:
            vector = (share * vector + (1 - share) * self._vector(self._before, now)).astype(
                np.float32
            )
        picture = add_label(self._renderer.render(vector), self.look.label)
        if self.refusal:
            return add_caption(picture, self.refusal.replace(f"{self.folder}/", ""), SMALL)
        return add_caption(picture, LEGEND, SMALL) if self.has_legend else picture

    def _vector(self, look: ShownFace, now: float) -> Vector:
        weights = {
            name: share
            for name, share in zip(TURNS, TURNED[look.turn], strict=True)
            if share and name in self._model.names
        }
        return still_vector(
            self._model,
            look.expression,
            viseme=look.viseme or None,
            weights=weights,
            time=now,
            seed=self.seed,
        )


def _beside(names: Sequence[str], name: str, step: int) -> str:
    """The name before or after another, wrapping around; the first for an unknown name."""
    return names[(names.index(name) + step) % len(names)] if name in names else names[0]
