"""The photo tasks of the 2003 tutorials, written as a user would."""

from pathlib import Path

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.hal.drivers.picture_file import write_picture
from hri.task import Parallel, get_task_manager, use
from hri.task.context import TaskContext
from hri.task.events import event, write_event
from hri.task.navigation import DriveMoveDelta
from hri.task.task import TaskStatus, task
from hri.task.units import UNIT_TIME, in_si
from hri.task.vision import GetImage

PHOTO = "Examples.PhotoEvent"


@task("Examples.PhotoShoot")
async def photo_shoot(context: TaskContext, delay: float, stop_count: float = 0.0) -> None:
    """Take photos at intervals; without a count until it is cancelled."""
    if stop_count < 0:
        context.fail("stop_count must be positive")
    context.task.result = 0
    while not stop_count or context.task.result < stop_count:
        frame = await GetImage(context)
        context.task.result += 1
        write_picture(f"image{context.task.result:03d}.jpg", frame.image, 0.9)
        await context.clock.sleep(in_si(UNIT_TIME, delay))


@task("Examples.PhotoEvent")
async def photo_event(context: TaskContext) -> float:
    """Take photos as events ask for them; how many."""
    total, current, shoot = 0, 0, None
    context.task.enable_event(f"{PHOTO}.*")
    while True:
        delay = shoot.get_property("delay", float) if shoot else float("inf")
        command = await context.task.wait_for_event(f"{PHOTO}.*", delay)
        if command is not None and command.name == f"{PHOTO}.Shoot":
            try:
                for name, kind in (("name", str), ("count", float), ("delay", float)):
                    command.get_property(name, kind)
            except HriError:
                error = event(f"{PHOTO}.Error", error="Invalid property type.")
                context.manager.raise_event(error)
                continue
            shoot, current = command, 0
        elif command is not None and command.name == f"{PHOTO}.StopShoot":
            shoot = None
        elif command is not None and command.name == f"{PHOTO}.End":
            return total
        if shoot is not None and (command is None or command is shoot):
            current, total = current + 1, total + 1
            name = shoot.get_property("name", str)
            frame = await GetImage(context)
            write_picture(f"{name}{current:03d}.jpg", frame.image, 0.9)
            if current >= shoot.get_property("count", float):
                shoot = None
                context.manager.raise_event(event(f"{PHOTO}.Done", name=name))


@task("Examples.PhotoEventTest")
async def photo_event_test(context: TaskContext) -> None:
    """Ask for three photos and then for the end."""
    context.task.enable_event(f"{PHOTO}.*")
    shoot = event(f"{PHOTO}.Shoot", name="a_", count="3.0", delay="1.0")
    print("test_event - raising event:", write_event(shoot))
    context.manager.raise_event(shoot)
    done = await context.task.wait_for_event(f"{PHOTO}.Done", timeout=60)
    print("test_event - received event:", write_event(done, context.clock))
    end = event(f"{PHOTO}.End")
    print("test_event - raising event:", write_event(end))
    context.manager.raise_event(end)
    context.task.disable_event(f"{PHOTO}.*")


@pytest.fixture(autouse=True)
def _stage(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    use("simulated", FakeClock())
    yield
    get_task_manager().shutdown()
    use()


@pytest.mark.proves("T11")
def test_photos_along_the_way():
    race = Parallel()
    driving = race.add_task(DriveMoveDelta, [20, 5, 20])
    photos = race.add_task(photo_shoot, [1])
    assert race.wait_for_first_task() is driving
    assert driving.status is TaskStatus.SUCCESS
    names = sorted(path.name for path in Path().glob("*.jpg"))
    assert names == [f"image{n + 1:03d}.jpg" for n in range(len(names))]
    assert photos.result == len(names) >= 4


@pytest.mark.proves("T11")
def test_arguments_of_the_photo_shoot():
    with pytest.raises(HriError, match="missing a required argument: 'delay'"):
        photo_shoot()
    with pytest.raises(HriError, match="delay is 'one' - give a number"):
        photo_shoot("one")
    with pytest.raises(HriError, match="stop_count must be positive"):
        photo_shoot(1, -2)


@pytest.mark.proves("T12", "T13", "T16", "T17", "E3")
def test_photos_by_events(capsys):
    both = Parallel()
    shooting = both.add_task(photo_event)
    both.add_task(photo_event_test)
    both.wait_for_all_tasks()
    print(f"{shooting.result} photos taken.")
    assert capsys.readouterr().out.splitlines() == [
        "test_event - raising event: {Event Examples.PhotoEvent.Shoot [time 0]"
        ' (count: 3.000000) (delay: 1.000000) (name: "a_")}',
        "test_event - received event: {Event Examples.PhotoEvent.Done [time 1.05593e+09]"
        ' (name: "a_")}',
        "test_event - raising event: {Event Examples.PhotoEvent.End [time 0]}",
        "3 photos taken.",
    ]
    assert sorted(path.name for path in Path().iterdir()) == ["a_001.jpg", "a_002.jpg", "a_003.jpg"]


@pytest.mark.proves("T17")
def test_an_order_with_a_wrong_property_is_answered_by_an_error():
    manager, errors = get_task_manager(), []
    manager.context.events.subscribe(f"{PHOTO}.Error", errors.append)
    shooting = manager.install(photo_event)
    manager.run(_order, event(f"{PHOTO}.Shoot", name=5, count=1, delay=1))
    manager.run(_order, event(f"{PHOTO}.End"))
    assert shooting.wait() is TaskStatus.SUCCESS
    assert [error.properties for error in errors] == [{"error": "Invalid property type."}]


async def _order(context: TaskContext, order: object) -> None:
    await context.clock.sleep(0.1)
    context.manager.raise_event(order)
