"""Objects are learned, looked for, gone to, and followed in the simulated room."""

import math
from dataclasses import replace

import pytest

from hri.behavior.device_behaviors import BumperSwitch, CameraFrames
from hri.behavior.drive_command import DriveCommand
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.core import paths
from hri.core.errors import HriError
from hri.core.geometry import seen_from
from hri.drive.behaviors import CommandGate
from hri.drive.following import Reason
from hri.hal.resource import Description
from hri.robot import finding
from hri.simulation.navigation_trips import BODY, SENSORS, devices
from hri.simulation.world import SimulatedWorld
from hri.task.context import TaskFailed
from hri.vision.objects import object_tasks
from hri.vision.objects.model_file import load_models, own_models, save_models
from hri.vision.objects.object_behaviors import ObjRecRecognizer
from tests.task.stage import Stage
from tests.vision.objects.pictures import learned

ROOM = """
[robot]
start = [1, 2]
[[wall]]
from = [0, 0]
to = [6, 0]
[[wall]]
from = [0, 4]
to = [6, 4]
"""


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))


class Room(Stage):
    """A robot with a camera and range sensors; it knows a cup and a key."""

    def __init__(self, folder, models="kitchen.mdl", networks=None):
        path = folder / "room.toml"
        path.write_text(ROOM)
        (folder / "kitchen.mdl").write_text("cup\nkey\n")
        camera = Description(
            "camera", "Hri.SimulatedCamera", {"width": "320", "height": "240"}, "world"
        )
        super().__init__(*devices(path, 0, SENSORS["three sensors"]), camera)
        self.context.resources.dimensions = BODY
        self.world = self.context.resources.obtain("world", SimulatedWorld)
        for network in networks or [self._seeing(folder, models)]:
            self.context.networks.start(network)

    def _seeing(self, folder, models):
        """Sees objects, and lets the gate drive."""
        gate, drive, bumper = CommandGate("gate"), DriveCommand("drive"), BumperSwitch("bumper")
        drive.velocity.sources.append(gate.velocity)
        gate.bump.sources.append(bumper.is_pressed)
        eye = CameraFrames("camera")
        modelset = models if models == "objects.mdl" else str(folder / models)
        recognizer = ObjRecRecognizer("objects", modelset=modelset, interval=0.25)
        recognizer.image.sources.append(eye.raw_image)
        return Network("moving", 0.05, behaviors=[bumper, gate, drive, eye, recognizer])

    def put(self, name, x, y):
        self.things = {**getattr(self, "things", {}), name: (x, y)}
        self.world.place(name, x, y)

    def from_robot(self, name):
        """Bearing and distance of a thing."""
        x, y = seen_from(self.world.base.pose, *self.things[name])
        return math.atan2(y, x), math.hypot(x, y)


@pytest.mark.proves("R08")
def test_it_turns_looks_and_goes_to_what_is_behind_it(tmp_path):
    room = Room(tmp_path)
    room.put("cup", 3.0, 2.2)
    room.world.base.pose = type(room.world.base.pose)(1.0, 2.0, math.radians(170))
    assert room.run(finding.find_object, "cup")
    bearing, distance = room.from_robot("cup")
    assert distance == pytest.approx(finding.BEFORE, abs=0.15)
    assert abs(bearing) < 0.2
    assert not room.world.base.is_touching


def test_what_is_not_there_is_looked_for_once_around(tmp_path):
    room = Room(tmp_path)
    room.put("key", 2.0, 2.0)
    with pytest.raises(TaskFailed, match="did not find cup - put it where the camera sees it"):
        room.run(finding.find_object_task, "cup")
    assert room.clock.now() < 20
    assert room.world.base.pose.x == pytest.approx(1.0, abs=0.02)


def test_something_of_unknown_size_is_turned_to(tmp_path):
    models = learned("cup")
    view = models.objects[0].views[0]
    save_models(tmp_path / "sizeless.mdl", _with_scale(models, view, 0.0))
    room = Room(tmp_path, "sizeless.mdl")
    room.put("cup", 1.0, 3.2)
    assert room.run(finding.find_object, "cup")
    bearing, _ = room.from_robot("cup")
    assert abs(bearing) < 0.2
    assert room.world.base.pose.x == pytest.approx(1.0, abs=0.02)


def test_an_object_that_is_carried_away_is_followed(tmp_path):
    room = Room(tmp_path)
    room.put("cup", 2.0, 2.0)
    for number in range(30):
        x = 2.0 + 0.05 * number
        room.clock.call_at(2.0 + 0.25 * number, lambda x=x: room.put("cup", x, 2.0 + 0.2 * (x - 2)))
    ending = room.run(finding.follow_object, "cup", 100.0, 14.0)
    assert ending
    assert (ending.reason, ending.person) == (Reason.TIME, "cup")
    assert room.from_robot("cup")[1] == pytest.approx(1.0, abs=0.3)
    assert "target.found" in room.names()


def test_without_something_that_recognizes_it_says_what_to_add(tmp_path):
    stage = Stage()
    with pytest.raises(HriError, match=r"add an Hri.ObjRecRecognizer to a network"):
        stage.run(finding.find_object, "cup")


@pytest.mark.proves("R08")
def test_what_is_shown_is_learned_seen_and_forgotten(tmp_path):
    room = Room(tmp_path, "objects.mdl")
    room.put("my cup", 1.9, 2.0)

    async def live(context):
        assert await object_tasks.wait_for_object(context, timeout=1.5) is None
        views = await object_tasks.learn_object(context, "cup")
        seen = await object_tasks.wait_for_object(context, timeout=4.0)
        await object_tasks.forget_object(context, "cup")
        await context.clock.sleep(5.0)
        return views, seen, object_tasks.objects_of(context)

    views, seen, after = room.run(live)
    assert views >= 1
    assert seen == "cup"
    assert after == ()
    assert load_models(own_models()).objects == ()
    shown = [event for event in room.events if event.name == "object.learning"]
    assert len(shown) > 3
    assert shown[0].properties["is_new"]
    assert "object.seen" in room.names()


def test_an_empty_room_teaches_nothing(tmp_path):
    room = Room(tmp_path, "objects.mdl")
    room.world.base.pose = type(room.world.base.pose)(1.0, 2.0, 1.5)
    with pytest.raises(TaskFailed, match="no picture shows enough of it"):
        room.run(object_tasks.learn_object, "cup", 2.0)
    assert not own_models().exists()


def test_a_stand_in_for_a_missing_camera_teaches_nothing(tmp_path, monkeypatch):
    room = Room(tmp_path, "objects.mdl")
    room.put("my cup", 1.9, 2.0)

    async def learn(context):
        monkeypatch.setattr(type(room.clock), "is_fake", False)
        try:
            await object_tasks.learn_object(context, "cup")
        finally:
            monkeypatch.setattr(type(room.clock), "is_fake", True)

    monkeypatch.setattr(room.context.resources, "stand_in_of", {"camera": "simulated"}.get)
    with pytest.raises(object_tasks.NoCamera, match="camera: a simulated one stands in for it"):
        room.run(learn)
    assert not own_models().exists()


def test_a_camera_that_is_off_teaches_nothing(tmp_path):
    room = Room(tmp_path, "objects.mdl")
    room.context.resources.obtain("camera", object_tasks.Camera).switch(False)
    with pytest.raises(TaskFailed, match="no picture shows enough of it"):
        room.run(object_tasks.learn_object, "cup", 1.0)


@pytest.mark.parametrize("name", ["", "x" * 61])
def test_a_name_that_cannot_be_is_refused(tmp_path, name):
    with pytest.raises(TaskFailed, match="a name is a line"):
        Room(tmp_path).run(object_tasks.learn_object, name)


def test_forgetting_what_was_not_learned_says_what_is_known(tmp_path):
    save_models(own_models(), learned("cup"))
    with pytest.raises(TaskFailed, match='no object "cap" was learned - did you mean "cup"'):
        Stage().run(object_tasks.forget_object, "cap")


def _with_scale(models, view, scale):
    model = replace(models.objects[0], views=(replace(view, scale=scale),))
    return replace(models, objects=(model,))


@pytest.mark.proves("R08")
def test_the_network_follows_what_it_sees_and_stops_before_it(tmp_path):
    room = Room(
        tmp_path, networks=[load_network(paths.find("config/networks", "follow_object.xml"))]
    )
    room.put("dollar_front.jpg", 3.5, 2.4)

    async def watch(context):
        await context.clock.sleep(10.0)
        first = room.from_robot("dollar_front.jpg")
        room.put("dollar_front.jpg", 4.0, 1.6)
        await context.clock.sleep(14.0)
        return first, room.from_robot("dollar_front.jpg")

    for bearing, distance in room.run(watch):
        assert distance == pytest.approx(0.8, abs=0.2)
        assert abs(bearing) < 0.15
    assert not room.world.base.is_touching
