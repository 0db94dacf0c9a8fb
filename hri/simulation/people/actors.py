"""People for tests and demonstrations: some faces, how one of them appears, and the picture."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Protocol

from hri.core.signals import Image
from hri.simulation.people.appearance import DEFAULT_ACTOR, Looks, Outfit
from hri.simulation.people.backdrop import STRIDES, back_hair, body, room
from hri.simulation.people.body_motion import Posture
from hri.simulation.people.drawn_hand import DrawnHand
from hri.simulation.people.hand_motion import HeldHand
from hri.simulation.people.head import paint_head
from hri.simulation.people.portrait import Mien

ACTORS: Mapping[str, Looks] = {
    DEFAULT_ACTOR: Looks(),
    "bruno": Looks(
        skin=(238, 190, 166),
        hair=(120, 100, 84),
        brows=(104, 78, 60),
        iris=(92, 116, 140),
        shirt=(120, 72, 66),
        width=1.06,
        jaw=1.12,
        nose=1.15,
        eyes=0.92,
        mouth=1.05,
        hairline=-0.70,
        beard=0.75,
    ),
    "chima": Looks(
        skin=(122, 82, 62),
        hair=(28, 24, 24),
        brows=(26, 20, 20),
        lips=(124, 66, 66),
        iris=(52, 34, 26),
        shirt=(206, 178, 92),
        width=1.02,
        nose=1.05,
        brow=1.25,
        mouth=1.12,
        hairline=-0.66,
    ),
    "mei": Looks(
        skin=(232, 192, 160),
        hair=(34, 28, 30),
        brows=(44, 34, 32),
        lips=(190, 96, 98),
        iris=(58, 40, 30),
        shirt=(86, 120, 92),
        width=0.97,
        jaw=0.94,
        nose=0.88,
        brow=0.7,
        eyes=0.96,
        mouth=0.95,
        hairline=-0.58,
        hair_length=0.9,
        has_glasses=True,
    ),
    "kofi": Looks(
        skin=(146, 100, 78),
        hair=(92, 90, 92),
        brows=(52, 46, 46),
        lips=(140, 80, 78),
        iris=(60, 40, 30),
        shirt=(224, 224, 218),
        width=1.04,
        jaw=1.06,
        nose=0.95,
        brow=0.5,
        mouth=1.1,
        hairline=-0.74,
        beard=0.35,
        has_glasses=True,
        is_for_tests=True,
    ),
    "tove": Looks(
        skin=(244, 204, 184),
        hair=(206, 170, 112),
        brows=(150, 114, 76),
        lips=(206, 112, 108),
        iris=(104, 138, 160),
        shirt=(96, 82, 128),
        width=0.95,
        jaw=1.04,
        nose=1.05,
        eyes=1.06,
        hairline=-0.60,
        hair_length=0.55,
        is_for_tests=True,
    ),
}
"""The faces; those that are for tests are seen by nothing that is tuned."""


@dataclass(frozen=True, slots=True)
class Appearance:
    """Someone in a picture. Angles as in HeadPose, radians, all 0 face the camera."""

    actor: str = DEFAULT_ACTOR
    """A key of `ACTORS`."""
    pitch: float = 0.0
    yaw: float = 0.0
    roll: float = 0.0
    center: tuple[float, float] = (160.0, 120.0)
    """Middle of the head, pixels."""
    height: float = 105.0
    """Chin to crown, pixels."""
    mouth: float = 0.0
    """0 shut to 1 open."""
    lids: float = 1.0
    """0 shut to 1 open."""
    smile: float = 0.0
    """0 to 1."""
    brows: float = 0.0
    """-1 drawn together and down, 0 at rest, 1 raised."""
    turn: float = 0.0
    """How far body and head are turned to the person's left, radians; pi shows the back."""
    stride: float = 0.0
    """How far the left leg is before the right one, -1 to 1."""
    outfit: Outfit | None = None
    """What they wear instead of the clothes of the actor."""

    def paint(self, image: Image) -> None:
        """Draw them into a picture."""
        looks, yaw = ACTORS[self.actor], self.yaw + self.turn
        is_away = math.cos(self.turn) < 0
        if not is_away:
            self._paint_hair(image, looks, yaw)
        aside = abs(math.sin(self.turn))
        stride = round(STRIDES * min(1.0, max(-1.0, self.stride)))
        clothed = body(looks, self.outfit, stride, aside > ASIDE)
        wide = math.hypot(math.cos(self.turn), DEPTH * aside)
        clothed.on(image, self.center, self.height / 2, 0.0, wide)
        if is_away:
            self._paint_hair(image, looks, yaw)
        mien = Mien.of(self.mouth, self.lids, self.smile, self.brows)
        paint_head(image, looks, mien, (self.pitch, yaw, self.roll), self.center, self.height)

    def _paint_hair(self, image: Image, looks: Looks, yaw: float) -> None:
        if looks.hair_length:
            # It hangs on the head, so it swings to the side where the face does not look.
            scale = self.height / 2
            x = self.center[0] - 0.25 * scale * math.sin(yaw)
            back_hair(looks).on(image, (x, self.center[1]), scale, self.roll)


HEAD_HEIGHT = 0.24
"""Meters from chin to crown, of an adult."""
PALM_WIDTH = 0.085
"""Meters, of an adult."""
DEPTH = 0.62
"""Of a body from front to back, as a part of its breadth."""
ASIDE = 0.5
"""Sine of a turn from which on legs are seen from the side."""
NEAREST = 0.4
"""Meters; someone who is nearer leans back."""


@dataclass(frozen=True, slots=True)
class Optics:
    """How a camera casts its picture."""

    width: int = 320
    """Pixels."""
    height: int = 240
    field_of_view: float = 0.6
    """Radians, across."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.width, self.height

    def show(
        self,
        actor: str,
        held: Posture,
        right: float,
        distance: float,
        lids: float = 1.0,
        turn: float = 0.0,
        outfit: Outfit | None = None,
    ) -> Appearance:
        """Appearance of a person at a place in meters, ahead and to the right, at eye level.

        `turn` and `outfit` are those of `Appearance`.
        """
        focal = self.width / 2 / math.tan(self.field_of_view / 2)
        meter = focal / max(NEAREST, distance - held.nearer)
        return Appearance(
            actor,
            held.pitch,
            held.yaw,
            held.roll,
            center=(
                self.width / 2 + (right + held.right) * meter,
                self.height / 2 + held.down * meter,
            ),
            height=HEAD_HEIGHT * meter,
            mouth=held.mouth,
            lids=lids,
            smile=held.smile,
            brows=held.brows,
            turn=turn,
            stride=held.stride,
            outfit=outfit,
        )

    def show_hand(self, actor: str, held: HeldHand, of: Appearance) -> DrawnHand:
        """The left hand of someone who looks so."""
        meter = of.height / HEAD_HEIGHT
        x, y = of.center
        center = x + held.aside * meter, y + held.down * meter
        palm, skin = PALM_WIDTH * meter, ACTORS[actor].skin
        return DrawnHand(center, palm, of.height, held.straight, held.turn, skin=skin)


class Drawable(Protocol):
    """What can stand in a picture."""

    @property
    def height(self) -> float:
        """Of a head at its distance, pixels: what is smaller is farther away."""

    def paint(self, image: Image) -> None:
        """Draw it into a picture."""


def render_people(
    appearances: Iterable[Drawable], size: tuple[int, int] = (320, 240), scene: int = 0
) -> Image:
    """The picture of people, and things, in a room, the far ones first; the same for the same
    arguments.

    `size` is width and height; each number of a `scene` is another room.
    """
    return render_before(room(size, scene), appearances)


def render_before(backdrop: Image, appearances: Iterable[Drawable]) -> Image:
    """The picture of people, and things, before a backdrop, the far ones first."""
    image = backdrop.copy()
    for shown in sorted(appearances, key=lambda shown: shown.height):
        shown.paint(image)
    return image
