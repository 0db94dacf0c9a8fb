from pathlib import Path

import numpy as np
import pytest
from hri.simulation.behaviors import ObjRecRecognizer

from hri.core.errors import HriError
from hri.core.signals import Frame
from hri.hal.resource import Description
from hri.simulation.simulated_devices import DrawnFrame
from hri.simulation.world import SimulatedWorld
from hri.testing import context
from tests.behavior.library.ticking import tick

FRAME = DrawnFrame(np.zeros((1, 1, 3), np.uint8), 0.0, 0)


@pytest.fixture
def models(tmp_path: Path) -> str:
    path = tmp_path / "kitchen.mdl"
    path.write_text("# what stands on the table\ncup\nkey   # the spare one\n\n")
    return str(path)


@pytest.fixture
def lent():
    made = context(Description("world", "Hri.SimulatedWorld", {"voice": "mute"}))
    mute = Description("mute", "Hri.EspeakVoice")
    made.resources.declare(mute)
    yield made
    made.resources.close()


@pytest.fixture
def recognizer(models, lent):
    made = ObjRecRecognizer("see", modelset=models)
    made.check()
    made.start(lent)
    return made


@pytest.mark.proves("B19", "B23")
def test_objects_of_the_model_set_take_turns_picture_by_picture(recognizer, lent) -> None:
    world = lent.resources.obtain("world", SimulatedWorld)
    for name, x in (("cup", 0.5), ("key", 0.8), ("dog", 0.6)):
        world.place(name, x, 0.0)
    sent = [tick(recognizer, image=FRAME) for _ in range(3)]
    assert [(one["model_name"], round(one["distance"])) for one in sent] == [
        ("cup", 50),
        ("key", 80),
        ("cup", 50),
    ]


def test_without_a_picture_or_an_object_it_says_nothing(recognizer, lent) -> None:
    assert tick(recognizer, image=FRAME) == {}
    lent.resources.obtain("world", SimulatedWorld).place("cup", 0.5, 0.0)
    assert tick(recognizer) == {}


def test_in_the_picture_of_another_camera_it_recognizes_nothing_and_says_so_once(
    recognizer, lent, caplog
) -> None:
    lent.resources.obtain("world", SimulatedWorld).place("cup", 0.5, 0.0)
    reasons = []
    lent.events.subscribe("vision.failed", lambda e: reasons.append(e.properties["reason"]))
    black = Frame(np.zeros((48, 64, 3), np.uint8), 0.0, 0)

    assert [tick(recognizer, image=black) for _ in range(3)] == [{}, {}, {}]

    assert reasons == caplog.messages
    assert reasons == [
        "see cannot recognize objects in pictures of a real camera yet"
        " - link its image to a Hri.SimulatedCamera"
    ]
    assert tick(recognizer, image=FRAME)["model_name"] == "cup"


def test_it_needs_a_simulated_world(models) -> None:
    with pytest.raises(HriError, match=r"see cannot recognize .* real camera yet - add a bus"):
        ObjRecRecognizer("see", modelset=models).start(context())


def test_one_object_alone_is_told_with_its_bearing(models, lent) -> None:
    world = lent.resources.obtain("world", SimulatedWorld)
    world.place("cup", 0.5, 0.0)
    world.place("key", 0.8, 0.1)
    made = ObjRecRecognizer("see", modelset=models, only="key")
    made.check()
    made.start(lent)
    for _ in range(2):
        sent = tick(made, image=FRAME)
        assert sent["model_name"] == "key"
        assert sent["bearing"] == pytest.approx(np.arctan2(0.1, 0.8))


def test_an_object_that_is_in_no_model_set_is_refused(models) -> None:
    with pytest.raises(HriError, match=r'has no "kee" - did you mean "key"'):
        ObjRecRecognizer("see", modelset=models, only="kee").check()
