"""Programs of the shapes that the guide of 2003 teaches, ported as docs/porting.md says."""

import numpy as np
import pytest
from PIL import Image

from hri.behavior.behavior import Behavior
from hri.behavior.library.constant import Constant
from hri.behavior.network import Network
from hri.behavior.ports import DBL_MAX, LINEAR_VELOCITY, Input, Output, Param
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.drivers.image_size import picture_size, write_picture
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.task.events import event, write_event
from hri.task.parallel import Parallel
from hri.task.task import find_task, task
from hri.task.task_run import TaskStatus
from hri.testing import context as lend
from tests.task.stage import Stage


@pytest.fixture
def camera(tmp_path):
    """A camera that has a hundred pictures to show."""
    folder = tmp_path / "shown"
    folder.mkdir()
    for number in range(100):
        write_picture(folder / f"{number}.png", np.full((12, 16, 3), number, np.uint8))
    settings = {"folder": str(folder), "rate": "30"}
    return Description("camera", "Hri.ImageFolderCamera", settings)


def test_a_task_takes_pictures_until_it_is_told_to_end(camera, tmp_path):
    @task("Ported.Photographer")
    async def photographer(context, pause: float) -> float:
        eye, taken = context.resources.obtain("camera0", Camera), 0
        while not context.termination_requested():
            frame = await eye.take()
            assert isinstance(frame, Frame)
            frame.write_file(tmp_path / f"{taken}.jpg", 0.9)
            taken += 1
            context.task.result = taken
            await context.clock.sleep(pause)
        return taken

    @task("Ported.Program")
    async def program(context) -> float:
        race = Parallel(context)
        photos = race.add_task(find_task("Ported.Photographer"), [0.5])
        race.add_task(find_task("Evolution.Wait"), [1700])
        await race.wait_for_first_task()
        assert photos.status is TaskStatus.CANCELLED
        return photos.result

    assert Stage(camera).run(program) == 4
    assert len(list(tmp_path.glob("*.jpg"))) == 4
    assert np.asarray(Image.open(tmp_path / "0.jpg")).ndim == 3


def test_an_event_starts_and_another_ends_the_photographer_and_prints_when_it_came(camera):
    printed = []

    @task("Ported.Shooter")
    async def shooter(context) -> float:
        eye = context.resources.obtain("camera", Camera)
        context.task.enable_event("Ported.*")
        order = await context.task.wait_for_event("Ported.Shoot")
        printed.append(write_event(order))
        for _ in range(int(order.get_property("count", float))):
            await eye.take()
        await context.task.wait_for_event("Ported.End")
        return order.get_property("count", float)

    @task("Ported.Director")
    async def director(context) -> float:
        shooting = context.manager.install(find_task("Ported.Shooter"))
        await context.clock.sleep(1.5)
        context.manager.raise_event(event("Ported.Shoot", count="3.0", name="a_"))
        await context.clock.sleep(0.5)
        context.manager.raise_event("Ported.End")
        await shooting.wait()
        return shooting.result

    assert Stage(camera).run(director) == 3.0
    assert printed == ['{Event Ported.Shoot [time 1.05593e+09] (count: 3.000000) (name: "a_")}']


class Guarded(Behavior):
    stop_limit = Param(60.0, "cm")
    speed = Input[float]("double", "cm/s", LINEAR_VELOCITY)
    ranges = Input[float]("double", "cm, from any count of sensors")
    allowed = Output[float]("double", "cm/s", LINEAR_VELOCITY)

    def compute(self, now: float, dt: float) -> None:
        wanted = self.speed.sources[0].value if self.speed.sources else None
        is_near = any(reading < self.stop_limit for reading in self.ranges.values)
        self.allowed.send(0.0 if wanted is None or is_near else wanted)


class Script(Behavior):
    is_sensor = True
    reading = Output[float]("double", "cm")
    said = (DBL_MAX, 60.0, 59.9, None, 200.0)

    def compute(self, now: float, dt: float) -> None:
        value = self.said[round(now / 0.1) - 1]
        if value is not None:
            self.reading.send(value)


def test_a_behavior_of_ones_own_stops_before_what_is_near():
    """The shape of the guide's StopCrash: two inputs, a parameter given as text, one output."""
    network = Network("ported", 0.1)
    for behavior in (Constant("wish", parsed_value="7"), Script("eye"), Guarded("stop")):
        network.add(behavior)
    network["stop"].set_parameter("stop_limit", "60")
    network.connect("wish.value", "stop.speed")
    network.connect("eye.reading", "stop.ranges")
    runner, sent = Runner(network, lend()), []
    runner.watch("stop", "allowed", lambda value, now: sent.append(value))
    runner.start()
    for number in range(1, 6):
        runner.tick(0.1 * number)
    runner.stop()
    # 60 itself is free, nothing said is no reading, and what is beyond reach is far away.
    assert sent == [7.0, 7.0, 0.0, 7.0, 7.0]


def test_a_program_without_tasks_takes_a_picture_and_gives_the_camera_back(tmp_path):
    """The shape of the guide's camera program: obtain by id and interface, wait, write, release."""
    config = paths.find("config", "simulated")
    with ResourceManager.load(config, FakeClock()) as resources:
        eye = resources.obtain("camera0", "ICamera")
        picture = eye.take()
        picture.write_file(tmp_path / "room.jpg", 0.9)
        resources.release(eye)
        assert not eye.is_active
    assert picture_size(tmp_path / "room.jpg") == (picture.width, picture.height)


def test_a_task_of_ones_own_fails_with_a_reason_and_counts_its_photos(camera, tmp_path):
    """The shape of the guide's PhotoShoot: a pause, an optional count, a result or a failure."""

    @task("Ported.Shoot")
    async def shoot(context, pause: float, count: float = 3.0) -> float:
        if count <= 0:
            context.fail("nothing to take")
        for number in range(int(count)):
            frame = await find_task("Evolution.GetImage")(context, "camera0")
            frame.write_file(tmp_path / f"shot{number}.png")
            await context.clock.sleep(pause)
        return count

    @task("Ported.Both")
    async def both(context):
        race = Parallel(context)
        tasks = [race.add_task(shoot, given) for given in ([0.2], [0.2, 0])]
        await race.wait_for_all_tasks()
        return [(one.status, one.result) for one in tasks]

    assert Stage(camera).run(both) == [(TaskStatus.SUCCESS, 3.0), (TaskStatus.FAILURE, None)]
    assert len(list(tmp_path.glob("shot*.png"))) == 3


def test_an_event_is_made_empty_and_given_its_properties_one_by_one():
    @task("Ported.Sender")
    async def sender(context):
        order = event("Ported.Order")
        order.set_property("count", "3.0")
        order.set_property("name", "a_")
        context.task.enable_event("Ported.*")
        context.manager.raise_event(order)
        return await context.task.wait_for_event("Ported.Order")

    received = Stage().run(sender)
    assert (received.get_property("count", float), received.get_property("name", str)) == (3, "a_")
