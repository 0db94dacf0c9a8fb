"""Objects are recognized in the pictures of the simulated camera, and reported."""

from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.core.signals import FoundObject, Frame
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.simulation.world import SimulatedWorld
from hri.testing import context
from hri.vision.objects.object_behaviors import ObjRecRecognizer
from hri.vision.objects.object_presence import ObjectPresence
from tests.behavior.library.ticking import tick


@pytest.fixture
def models(tmp_path: Path) -> str:
    path = tmp_path / "kitchen.mdl"
    path.write_text("# what stands on the table\ncup\nkey   # the spare one\n\n")
    return str(path)


@pytest.fixture
def lent():
    made = context(Description("world", "Hri.SimulatedWorld", {"voice": "mute"}))
    made.resources.declare(Description("mute", "Hri.EspeakVoice"))
    made.resources.declare(Description("camera", "Hri.SimulatedCamera", bus="world"))
    yield made
    made.resources.close()


@pytest.fixture
def world(lent) -> SimulatedWorld:
    return lent.resources.obtain("world", SimulatedWorld)


def started(lent, models, **parameters) -> ObjRecRecognizer:
    made = ObjRecRecognizer("see", modelset=models, **parameters)
    made.check()
    made.start(lent)
    return made


def looked(recognizer, lent, seconds: float, frames: bool = True) -> list[dict]:
    """What it sends in each tick in which it has something to send."""
    camera = lent.resources.obtain("camera", Camera)
    sent = []
    for _ in range(round(seconds / 0.1)):
        lent.clock.advance(0.1)
        picture = camera.read(lent.clock.now()) if frames else None
        inputs = {} if picture is None else {"image": picture}
        sent.append(tick(recognizer, now=lent.clock.now(), **inputs))
    return [one for one in sent if one]


@pytest.mark.proves("B19", "B23", "R08")
def test_objects_of_the_model_set_take_turns_with_their_place_and_distance(
    lent, world, models
) -> None:
    for name, x, y in (("cup", 1.0, 0.15), ("key", 1.4, -0.25), ("dog", 2.0, 0.0)):
        world.place(name, x, y)
    named = {one["model_name"]: one for one in looked(started(lent, models), lent, 0.6)}
    assert set(named) == {"cup", "key"}
    assert named["cup"]["distance"] == pytest.approx(100, rel=0.03)
    assert named["key"]["distance"] == pytest.approx(140, rel=0.03)
    assert named["cup"]["bearing"] == pytest.approx(np.arctan2(0.15, 1.0), abs=0.01)
    assert named["cup"]["x"] < 160 < named["key"]["x"]
    assert named["cup"]["y"] == pytest.approx(120, abs=3)
    assert all(0.5 < one["confidence"] <= 1 for one in named.values())


def test_without_a_picture_or_an_object_it_says_nothing(lent, world, models) -> None:
    recognizer = started(lent, models)
    assert all(set(one) == {"objects"} for one in looked(recognizer, lent, 0.5))
    world.place("cup", 1.0, 0.0)
    assert looked(recognizer, lent, 0.3, frames=False)[1:] == []


@pytest.mark.proves("R08")
def test_what_comes_and_goes_is_an_event(lent, world, models) -> None:
    happened: list[str] = []
    for name in ("object.seen", "object.lost"):
        lent.events.subscribe(name, lambda e: happened.append(f"{e.name} {e.properties['object']}"))
    recognizer = started(lent, models)
    world.place("cup", 1.0, 0.0)
    looked(recognizer, lent, 1.0)
    assert [one.name for one in recognizer.present] == ["cup"]
    world.place("cup", -1.0, 0.0)
    world.place("key", 1.0, 0.0)
    looked(recognizer, lent, 3.0)
    assert happened == ["object.seen cup", "object.seen key", "object.lost cup"]
    looked(recognizer, lent, 3.0, frames=False)
    assert happened[-1] == "object.lost key"


def test_black_pictures_of_any_size_show_nothing(lent, models) -> None:
    recognizer = started(lent, models)
    for number, shape in enumerate([(48, 64, 3), (1, 1, 3), (7, 333, 3)]):
        frame = Frame(np.zeros(shape, np.uint8), lent.clock.now(), number)
        tick(recognizer, now=lent.clock.now(), image=frame)
        lent.clock.advance(0.1)
        assert tick(recognizer, now=lent.clock.now())["objects"].found == ()


def test_one_object_alone_is_looked_for(lent, world, models) -> None:
    world.place("cup", 1.0, 0.2)
    world.place("key", 1.0, -0.2)
    sent = looked(started(lent, models, only="key"), lent, 0.5)
    assert {one["model_name"] for one in sent if "model_name" in one} == {"key"}


def test_an_object_that_is_in_no_model_set_is_refused(models) -> None:
    with pytest.raises(HriError, match=r'has no "kee" - did you mean "key"'):
        ObjRecRecognizer("see", modelset=models, only="kee").check()


def test_an_object_that_is_missed_in_a_picture_is_still_there() -> None:
    presence = ObjectPresence()
    cup = FoundObject("cup", 1.0, 2.0, (), 0.9)
    pictures = [(cup,), (cup,), (), (cup,), (), ()]
    told = [presence.update(0.5 * n, found) for n, found in enumerate(pictures)]
    assert told == [([], []), ([cup], []), *[([], [])] * 4]
    assert presence.update(4.0, ()) == ([], ["cup"])
    assert presence.present == ()


def test_what_is_seen_once_by_chance_has_not_come() -> None:
    presence = ObjectPresence()
    cup = FoundObject("cup", 1.0, 2.0, (), 0.9)
    for number in range(12):
        assert presence.update(0.2 * number, (cup,) if number % 4 == 0 else ()) == ([], [])
