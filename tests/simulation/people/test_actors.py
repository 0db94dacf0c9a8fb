import itertools
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hri.core.signals import Image
from hri.simulation.people.actors import ACTORS, Appearance, Optics, render_people
from hri.simulation.people.appearance import Outfit
from hri.simulation.people.body_motion import Posture
from hri.simulation.people.lens import Lens

EMPTY = render_people([])


def alone(actor: str, **changed: Any) -> Image:
    return render_people([replace(Appearance(actor, height=130.0), **changed)])


def apart(one: Image, other: Image) -> float:
    """Mean difference of two pictures."""
    return float(np.abs(one.astype(int) - other).mean())


def sharpness(picture: Image) -> float:
    """The largest step between two pixels side by side."""
    return float(np.abs(np.diff(picture.astype(int), axis=1)).max())


def test_there_are_several_faces_and_some_are_kept_for_tests() -> None:
    assert sum(looks.is_for_tests for looks in ACTORS.values()) >= 1
    assert sum(not looks.is_for_tests for looks in ACTORS.values()) >= 3
    assert any(looks.has_glasses for looks in ACTORS.values())
    assert any(looks.beard for looks in ACTORS.values())
    for one, other in itertools.combinations(ACTORS, 2):
        assert apart(alone(one), alone(other)) > 4, (one, other)


@pytest.mark.parametrize("part", ["mouth", "smile", "brows", "lids"])
@pytest.mark.parametrize("actor", ACTORS)
def test_each_part_of_each_face_moves(actor: str, part: str) -> None:
    neutral, moved = alone(actor), alone(actor, **{part: 0.0 if part == "lids" else 1.0})
    changed = np.abs(neutral.astype(int) - moved).max(axis=2) > 12
    rows = np.nonzero(changed)[0]
    middle = rows.mean()
    assert len(rows) > 20
    assert (middle < 130) == (part in ("brows", "lids"))


def test_people_are_painted_from_far_to_near() -> None:
    far = Appearance("chima", center=(140.0, 110.0), height=70.0)
    near = Appearance("mei", center=(170.0, 120.0), height=120.0)
    both = render_people([near, far])
    assert np.array_equal(both, render_people([far, near]))
    assert apart(both[80:160, 155:185], render_people([near])[80:160, 155:185]) == 0


def test_nobody_leaves_the_room_empty_and_each_scene_is_another_room() -> None:
    assert np.array_equal(EMPTY, render_people([]))
    assert np.array_equal(render_people([Appearance(center=(9000.0, 120.0))]), EMPTY)
    rooms = [render_people([], scene=scene) for scene in range(4)]
    assert all(apart(one, other) > 5 for one, other in itertools.combinations(rooms, 2))


def test_a_picture_is_not_changed_by_the_next_one() -> None:
    first = alone("ada")
    kept = first.copy()
    alone("bruno", mouth=1.0)
    assert np.array_equal(first, kept)
    assert np.array_equal(alone("ada"), kept)


def test_a_small_turn_moves_the_picture_by_a_little() -> None:
    """Motion is smooth: a tenth of a degree is seen, and no step is much larger than the rest."""
    turns = [alone("mei", yaw=math.radians(step / 10)) for step in range(20)]
    steps = [apart(one, other) for one, other in itertools.pairwise(turns)]
    assert min(steps) > 0
    assert max(steps) < 4 * np.median(steps)


def test_optics_show_people_where_they_stand() -> None:
    optics = Optics(640, 480, field_of_view=1.0)
    ahead = optics.show("ada", Posture(), right=0.0, distance=2.0)
    aside = optics.show("ada", Posture(), right=0.5, distance=2.0)
    focal = 320 / math.tan(0.5)
    assert ahead.center == (320.0, 240.0)
    assert ahead.height == pytest.approx(0.24 * focal / 2)
    assert aside.center[0] == pytest.approx(320 + focal / 4)
    nearer = optics.show("ada", Posture(nearer=1.0, down=0.1), right=0.0, distance=2.0)
    assert nearer.height == pytest.approx(2 * ahead.height)
    assert nearer.center[1] == pytest.approx(240 + 0.1 * focal)


def test_a_lens_gives_the_same_picture_for_the_same_number() -> None:
    picture = alone("ada")
    lens = Lens(noise=4, light=0.5, flicker=0.15, blur=0.8, jitter=1, seed=3)
    assert np.array_equal(lens.take(picture, 7), lens.take(picture, 7))
    assert not np.array_equal(lens.take(picture, 7), lens.take(picture, 8))
    assert not np.array_equal(
        lens.take(picture, 7), Lens(4, 0.5, 0.15, 0.8, 1, seed=4).take(picture, 7)
    )


def test_each_fault_does_what_it_says() -> None:
    flat = np.full((120, 160, 3), 120, np.uint8)
    assert np.array_equal(Lens(noise=0).take(flat, 0), flat)
    noisy = Lens(noise=5).take(flat, 1)
    assert noisy.std() == pytest.approx(5, rel=0.1)
    assert noisy.mean() == pytest.approx(120, abs=0.5)
    assert Lens(noise=0, light=0.4).take(flat, 0).mean() == pytest.approx(48, abs=1)
    flickering = [Lens(noise=0, flicker=0.15).take(flat, index).mean() for index in range(30)]
    assert np.ptp(flickering) == pytest.approx(36, rel=0.1)
    picture = alone("ada")
    blurred = Lens(noise=0, blur=2).take(picture, 0)
    assert sharpness(blurred) < 0.6 * sharpness(picture)
    trembling = [Lens(noise=0, jitter=1).take(picture, index) for index in range(5)]
    assert all(apart(picture, moved) > 0 for moved in trembling)
    assert picture.shape == trembling[0].shape
    assert picture.dtype == trembling[0].dtype


def test_someone_who_turns_away_shows_hair_and_a_back_and_is_narrower_from_the_side() -> None:
    size = (320, 240)
    bare = render_people([], size)
    widths = {}
    for degrees in (0, 90, 180):
        shown = Appearance(center=(160, 60), height=60.0, turn=math.radians(degrees))
        picture = render_people([shown], size)
        covered = (picture != bare).any(axis=2)
        widths[degrees] = int(covered[170].sum())
        if degrees == 180:
            hair = picture[55:65, 155:165].reshape(-1, 3).mean(axis=0)
            assert np.abs(hair - ACTORS["ada"].hair).max() < 40
    assert widths[180] == widths[0]
    assert widths[90] < 0.75 * widths[0]


def test_legs_part_with_a_stride_and_clothes_are_those_of_the_outfit() -> None:
    size = (320, 240)
    outfit = Outfit((200, 40, 40), (30, 160, 40))
    stands, walks = (
        render_people(
            [Appearance(center=(160, 40), height=28.0, turn=1.6, stride=s, outfit=outfit)]
        )
        for s in (0.0, 1.0)
    )
    assert stands.shape[:2] == size[::-1]
    assert (np.abs(stands[80:90, 158:162].astype(int) - (200, 40, 40)) < 30).all()
    green = (stands[..., 1] > stands[..., 0].astype(int) + 60)[200:225].sum(axis=1)
    apart = walks[200:225, :, 1] > walks[200:225, :, 0].astype(int) + 60
    assert green.max() > 0
    assert np.ptp(np.nonzero(apart)[1]) > 1.5 * green.max()
