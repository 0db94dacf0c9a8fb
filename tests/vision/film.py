"""Films of one person for the tests: what a camera with some noise would take."""

from collections.abc import Callable
from functools import lru_cache

from hri.core.signals import Frame, Image
from hri.simulation.people.actors import Appearance, render_people
from hri.simulation.people.appearance import DEFAULT_ACTOR
from hri.simulation.people.body_motion import Angles, idle_angles
from hri.simulation.people.lens import Lens

Motion = Callable[[float], Angles]
"""The angles of the head at a time, on top of its idle sway."""
Place = Callable[[float], tuple[float, float]]
"""The middle of the head in pixels at a time."""

SIZE = (320, 240)


def still(time: float) -> Angles:
    return 0.0, 0.0, 0.0


def in_the_middle(time: float) -> tuple[float, float]:
    return 160.0, 120.0


@lru_cache(maxsize=8)
def film(
    motion: Motion = still,
    duration: float = 3.0,
    rate: float = 15.0,
    height: float = 105.0,
    place: Place = in_the_middle,
    seed: int = 1,
    actor: str = DEFAULT_ACTOR,
    noise: float = 2.5,
) -> tuple[Frame, ...]:
    """Frames of 320x240 pixels, drawn once for all chains that see the film."""
    lens, frames = Lens(noise, seed=seed), []
    for index in range(round(duration * rate)):
        time = index / rate
        pitch, yaw, roll = (
            a + b for a, b in zip(motion(time), idle_angles(time, seed), strict=True)
        )
        shown = Appearance(actor, pitch, yaw, roll, place(time), height)
        frames.append(Frame(lens.take(render_people([shown], SIZE), index), time, index))
    return tuple(frames)


def render_head(
    pitch: float,
    yaw: float,
    roll: float,
    *,
    center: tuple[float, float],
    height: float,
    size: tuple[int, int] = SIZE,
    mouth: float = 0.0,
    lids: float = 1.0,
) -> Image:
    """The picture of one person, the first of the actors, at home."""
    shown = Appearance(DEFAULT_ACTOR, pitch, yaw, roll, center, height, mouth, lids)
    return render_people([shown], size)
