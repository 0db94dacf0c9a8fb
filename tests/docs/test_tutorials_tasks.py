"""The tutorials of tasks and of Python, run on fake time in the simulated room."""

import io
import math
import sys
from pathlib import Path

import pytest

from hri.core.clock import FakeClock
from hri.hal.drivers.image_size import picture_size
from hri.simulation.world import SimulatedWorld
from hri.task import (
    UNIT_ANGLE,
    UNIT_DISTANCE,
    UNIT_TIME,
    TaskStatus,
    get_task_manager,
    navigation,
    set_default_units,
    use,
    util,
)
from hri.task.events import event
from tests.docs.tutorial import Tutorial

INCHES = 0.0254


@pytest.fixture(autouse=True)
def clock(tmp_path, monkeypatch):
    """A script's task manager in a folder of its own, on fake time."""
    monkeypatch.chdir(tmp_path)
    clock = FakeClock()
    use("simulated", clock)
    yield clock
    get_task_manager().shutdown()
    use()
    for quantity, unit in ((UNIT_DISTANCE, "cm"), (UNIT_ANGLE, "rad"), (UNIT_TIME, "sec")):
        set_default_units(quantity, unit)


@pytest.fixture
def world():
    return get_task_manager().context.resources.obtain("world", SimulatedWorld)


@pytest.fixture
def heard():
    """All events."""
    events = []
    get_task_manager().context.events.subscribe("*", events.append)
    return events


def load(monkeypatch, folder, program):
    """A program with its page; what lies beside it can be imported, as when it is run."""
    tutorial = Tutorial(folder)
    monkeypatch.syspath_prepend(tutorial.folder)
    for name in ("photo_shoot", "photo_event"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return tutorial, tutorial.load(program)


def photos():
    return sorted(path.name for path in Path().glob("*.jpg"))


@pytest.mark.proves("T01", "T04", "C05", "C06", "H24")
def test_drive_then_take_a_picture(monkeypatch, capsys, world, clock):
    tutorial, program = load(monkeypatch, "task-01-simple", "simple.py")
    start = world.base.pose
    program.main()
    assert world.base.pose.x - start.x == pytest.approx(20 * INCHES, abs=0.01)
    assert clock.now() == pytest.approx(20 / 5 + 5 / 20, abs=0.3)
    assert picture_size(Path("image.jpg")) == (320, 240)
    assert tutorial.prints(capsys.readouterr().out)


@pytest.mark.proves("T01", "T03", "T08")
def test_drive_and_take_a_picture_at_once(monkeypatch, capsys, world, clock):
    tutorial, program = load(monkeypatch, "task-02-parallel", "parallel.py")
    start = world.base.pose
    program.main()
    assert world.base.pose.x - start.x == pytest.approx(20 * INCHES, abs=0.01)
    assert clock.now() == pytest.approx(20 / 5 + 5 / 20, abs=0.3)
    assert photos() == ["image.jpg"]
    assert tutorial.prints(capsys.readouterr().out)


@pytest.mark.proves("T08", "T11")
def test_photos_along_the_way(monkeypatch, capsys, clock):
    tutorial, program = load(monkeypatch, "task-03-custom-task", "test_shoot.py")
    program.main()
    assert tutorial.prints(capsys.readouterr().out)
    assert photos() == [f"image{number:03d}.jpg" for number in range(1, 6)]
    assert clock.now() == pytest.approx(20 / 5 + 5 / 20, abs=0.3)


@pytest.mark.proves("T11")
def test_a_task_of_ones_own_checks_and_converts_its_arguments(monkeypatch, clock):
    _, module = load(monkeypatch, "task-03-custom-task", "photo_shoot.py")
    set_default_units(UNIT_TIME, "minutes")
    assert module.PhotoShoot(0.5, 2) == 2
    assert clock.now() == pytest.approx(60, abs=1)
    with pytest.raises(Exception, match="delay is 'soon' - give a number"):
        module.PhotoShoot("soon")
    with pytest.raises(Exception, match="stop_count must be positive"):
        module.PhotoShoot(1, 0)


@pytest.mark.proves("T12", "T13", "T14", "T15", "T16", "T17", "E2", "E3")
def test_photos_by_events(monkeypatch, capsys):
    tutorial, program = load(monkeypatch, "task-04-event", "test_event.py")
    program.main()
    printed = capsys.readouterr().out
    assert tutorial.prints(printed)
    assert "[time 1.05593e+09]" in printed
    assert photos() == ["a_001.jpg", "a_002.jpg", "a_003.jpg"]


@pytest.mark.proves("T15", "T17")
def test_the_photographer_stops_and_refuses_orders_it_cannot_read(monkeypatch, heard):
    _, module = load(monkeypatch, "task-04-event", "photo_event.py")
    manager = get_task_manager()
    photographer = manager.install(module.PhotoEvent)
    util.Wait(100)
    manager.raise_event(event("Examples.PhotoEvent.Shoot", name="b_", count=9, delay=1))
    util.Wait(1500)
    manager.raise_event(event("Examples.PhotoEvent.Shoot", name=5, count=1, delay=1))
    manager.raise_event("Examples.PhotoEvent.StopShoot")
    util.Wait(5000)
    manager.raise_event("Examples.PhotoEvent.End")
    assert photographer.wait() is TaskStatus.SUCCESS
    assert photographer.result == 2
    assert photos() == ["b_001.jpg", "b_002.jpg"]
    errors = [e.properties for e in heard if e.name == "Examples.PhotoEvent.Error"]
    assert errors == [{"error": "Invalid property type."}]


@pytest.mark.proves("T06", "T07", "T25", "E1")
def test_three_triangles_end_where_they_began(monkeypatch, capsys, world, heard):
    tutorial, program = load(monkeypatch, "python-01-simple", "triangles.py")
    start = world.base.pose
    program.main()
    printed = capsys.readouterr().out
    assert tutorial.prints(printed)
    spoken = [e.properties["text"] for e in heard if e.name == "speech.said"]
    assert spoken == printed.splitlines()
    assert len(spoken) == 15
    end = world.base.pose
    assert math.hypot(end.x - start.x, end.y - start.y) < 0.05
    assert abs(math.remainder(end.heading - start.heading, math.tau)) < 0.1


@pytest.mark.proves("T06", "E13")
def test_move_relative_takes_a_heading_and_then_an_array(world, clock):
    start = world.base.pose
    navigation.MoveRelative(math.pi / 2, [30, 1.0, 15])
    end = world.base.pose
    assert end.heading - start.heading == pytest.approx(math.pi / 2, abs=0.03)
    assert end.x - start.x == pytest.approx(0, abs=0.02)
    assert end.y - start.y == pytest.approx(0.3, abs=0.02)
    assert clock.now() == pytest.approx((math.pi / 2 / 1.0 + 1.0) + (30 / 15 + 15 / 30), abs=0.6)


def test_echo_ends_on_ctrl_d(monkeypatch, capsys):
    _, program = load(monkeypatch, "python-02-parallel", "echo.py")
    monkeypatch.setattr("sys.stdin", io.StringIO(""))
    program.main()
    assert capsys.readouterr().err == ""


@pytest.mark.proves("T08", "T26", "E10")
def test_echo_speaks_short_lines_and_cuts_long_ones(monkeypatch, capsys, heard):
    tutorial, program = load(monkeypatch, "python-02-parallel", "echo.py")
    lines = ["Hello.", "This is a line that nobody could possibly say within a second.", ""]
    monkeypatch.setattr("sys.stdin", io.StringIO("".join(f"{line}\n" for line in lines)))
    program.main()
    # Where the page has what was typed, there is nothing here: no terminal shows it.
    page = tutorial.blocks("text")[0]
    for line in filter(None, lines):
        assert page.count(line) == 1
        page = page.replace(f"{line}\n", "")
    assert capsys.readouterr().out == page.rstrip("\n")
    finished = [e for e in heard if e.name == "speech.finished"]
    assert [e.properties["cut"] for e in finished] == [False, True]
    said = [e for e in heard if e.name == "speech.said"]
    assert finished[1].time - said[1].time <= 1.05
