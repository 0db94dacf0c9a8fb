"""Programs of the shapes that the guide of 2003 teaches, ported as docs/porting.md says."""

import numpy as np
import pytest
from PIL import Image

from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.drivers.picture_file import write_picture
from hri.hal.resource import Description
from hri.task.events import event, write_event
from hri.task.parallel import Parallel
from hri.task.task import TaskStatus, find_task, task
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
            write_picture(tmp_path / f"{taken}.jpg", frame.image, 0.9)
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
    assert printed == ['{Event Ported.Shoot [time 1.5] (count: 3.000000) (name: "a_")}']
