"""Tasks as plain functions, in a script without a robot."""

import signal
import subprocess
import sys
import threading
from functools import partial

import pytest
import trio

from hri.core import registry
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.drive import Odometry
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.task import (
    UNIT_ANGLE,
    UNIT_DISTANCE,
    Parallel,
    TaskStatus,
    face,
    find_task,
    get_task_manager,
    navigation,
    net,
    resource,
    set_default_units,
    speech,
    use,
    util,
    vision,
)
from hri.task.task import TaskType, task


@pytest.fixture
def clock():
    """A script on fake time with simulated devices; the default units afterwards."""
    clock = FakeClock()
    use(config="simulated", clock=clock)
    yield clock
    get_task_manager().shutdown()
    use()
    set_default_units(UNIT_DISTANCE, "cm")
    set_default_units(UNIT_ANGLE, "rad")


def pose():
    manager = get_task_manager()
    return manager.context.resources.obtain("odometry", Odometry).pose(manager.clock.now())


@pytest.mark.proves("T04", "T06")
def test_tasks_are_called_like_functions(clock):
    util.Wait(1500)
    assert clock.now() == 1.5
    navigation.DriveMoveDelta(50, 20, 20)
    assert pose().x == pytest.approx(0.5, abs=0.01)
    assert clock.now() == pytest.approx(1.5 + 50 / 20 + 20 / 20, abs=0.3)
    navigation.TurnRelative(1.5)
    assert pose().heading == pytest.approx(1.5, abs=0.03)
    navigation.MoveRelative(-1.5, [10, 0, 20])
    assert pose().x == pytest.approx(0.6, abs=0.02)
    navigation.Stop()


def test_a_script_goes_to_a_place_with_no_network_around_it(clock):
    find_task("Hri.GoBy")(30, 0)
    assert pose().x == pytest.approx(0.3, abs=0.01)
    assert clock.now() < 15
    find_task("Hri.GoBy")(20, 0)
    assert pose().x == pytest.approx(0.5, abs=0.01)


@pytest.mark.proves("T04", "C05", "C06")
def test_tasks_take_default_units(clock):
    set_default_units(UNIT_DISTANCE, "inches")
    set_default_units(UNIT_ANGLE, "degrees")
    find_task("Evolution.DriveMoveDelta")(20, 5, 20)
    assert pose().x == pytest.approx(20 * 0.0254, abs=0.01)
    assert clock.now() == pytest.approx(20 / 5 + 5 / 20, abs=0.3)
    navigation.TurnRelative(-90)
    assert pose().heading == pytest.approx(-1.571, abs=0.03)


@pytest.mark.proves("T04", "H31")
def test_the_first_camera_is_found_and_takes_a_picture(clock):
    assert resource.FindResource("ICamera") == "camera"
    with pytest.raises(HriError, match='no device is a "Camra" - did you mean "Camera"'):
        resource.FindResource("Camra")
    assert isinstance(vision.GetImage("camera"), Frame)
    assert isinstance(vision.GetImage(), Frame)
    with pytest.raises(HriError, match='no device "camera9"'):
        vision.GetImage("camera9")


CATEGORIES = (face, navigation, net, resource, speech, util, vision)


@pytest.mark.proves("T05")
@pytest.mark.parametrize("category", CATEGORIES)
def test_a_category_knows_its_tasks_and_shows_nothing_else(category):
    assert dir(category) == sorted(category.__all__)
    for name in dir(category):
        assert isinstance(getattr(category, name), TaskType), name
    with pytest.raises(AttributeError, match=r"has no task \"Nothing\" - known are: "):
        category.Nothing  # noqa: B018
    assert not hasattr(category, "__path__")


@pytest.mark.proves("T05")
def test_each_task_of_the_library_is_in_one_category():
    known = sorted(name.partition(".")[2] for name in registry.known("hri.tasks"))
    listed = sorted(name for category in CATEGORIES for name in dir(category))
    assert listed == sorted(set(known))


@pytest.mark.parametrize(
    ("category", "name", "meant"),
    [
        (speech, "Speek", "Speak"),
        (navigation, "goto", "GoTo"),
        (navigation, "FollowPersn", "FollowPerson"),
        (vision, "FindObjekt", "FindObject"),
        (vision, "getImage", "GetImage"),
        (util, "wait", "Wait"),
    ],
)
def test_a_misspelt_task_is_told_its_name(category, name, meant):
    with pytest.raises(AttributeError, match=rf'no task "{name}" - did you mean "{meant}"\?'):
        getattr(category, name)


@pytest.mark.proves("T05", "C02")
def test_a_script_goes_to_a_place_by_its_module(clock):
    navigation.GoTo(5, 5)
    assert (pose().x, pose().y) == pytest.approx((0.05, 0.05), abs=0.01)
    with pytest.raises(HriError, match=r"Hri\.GoTo: .* it takes"):
        navigation.GoTo()


@pytest.mark.proves("T04", "T08", "T26")
def test_speaking_is_cut_when_something_else_is_first(clock):
    spoken = []
    get_task_manager().context.events.subscribe("speech.finished", spoken.append)
    race = Parallel()
    speaking = race.add_task(speech.Speak, ["This is a sentence that takes longer than a second."])
    waiting = race.add_task(util.Wait, [1000])
    assert race.wait_for_first_task() is waiting
    assert speaking.status is TaskStatus.CANCELLED
    assert spoken[0].properties["cut"] is True
    assert clock.now() == pytest.approx(1.0, abs=0.05)
    speech.Speak("Yes.")
    assert spoken[1].properties["cut"] is False


def test_a_question_without_a_network_hears_its_answer(clock):
    context = get_task_manager().context
    world = context.resources.obtain("world", SimulatedWorld)
    context.events.subscribe("question.asked", lambda _: world.say("yes", clock.now() + 0.8))

    assert speech.Ask("Do you like me?", timeout=5) is True


def test_a_script_chooses_what_may_be_heard(clock, tmp_path):
    path = tmp_path / "base.jsgf"
    path.write_text(
        "#JSGF V1.0;\ngrammar base;\npublic <go> = go (forward {dir=1} | back {dir=-1});\n"
    )
    world = get_task_manager().context.resources.obtain("world", SimulatedWorld)
    world.say("go back", clock.now() + 1.0)
    heard = speech.Listen(8, str(path))
    assert (heard.text, heard.rule, dict(heard.tags)) == ("go back", "go", {"dir": -1})
    world.say("go forward", clock.now() + 1.0)
    assert speech.WaitForSpeech("go", 8, str(path)).tags["dir"] == 1
    with pytest.raises(HriError, match="nowhere"):
        speech.Listen(1, "nowhere")


@pytest.mark.proves("T09", "T12")
def test_installed_tasks_and_events(clock):
    manager = get_task_manager()
    waiting = manager.install(util.WaitForEvent, "door.*", 5000)
    endless = manager.install(util.Wait, 1e9)
    util.Wait(100)
    manager.raise_event("door.opened", width=80.0)
    assert waiting.wait() is TaskStatus.SUCCESS
    assert waiting.result.get_property("width", float) == 80.0
    util.RaiseEvent("Door.Opened?count=2")
    endless.cancel()
    manager.wait()
    assert endless.status is TaskStatus.CANCELLED


@pytest.mark.proves("T07")
def test_shutdown_may_be_called_twice_and_the_next_task_begins_anew(clock):
    first = get_task_manager()
    endless = first.install(util.Wait, 1e9)
    util.Wait(100)
    first.shutdown()
    first.shutdown()
    assert endless.status is TaskStatus.CANCELLED
    assert get_task_manager() is not first
    with pytest.raises(RuntimeError, match="has ended"):
        first.run(util.Wait, 1)


def test_the_second_to_run_is_refused(clock):
    get_task_manager()
    with pytest.raises(RuntimeError, match="runs already"):
        use()
    with pytest.raises(RuntimeError, match="runs already"), Robot(clock=FakeClock()):
        pass


@task("Examples.Failing")
async def failing(context):
    context.fail("nothing works")


@pytest.mark.proves("T03")
def test_a_failure_is_an_exception(clock):
    with pytest.raises(HriError, match="nothing works"):
        failing()


@pytest.mark.proves("T07")
def test_a_script_that_forgets_the_shutdown_still_ends():
    script = (
        "from hri.core.clock import FakeClock\n"
        "from hri.task import use, util, get_task_manager\n"
        "use('simulated', FakeClock())\n"
        "get_task_manager().install(util.Wait, 1e9)\n"
        "util.Wait(100)\n"
        "print('done')\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "done\n", "")


def test_a_picture_leaves_no_camera_reserved(clock):
    resources = get_task_manager().context.resources
    camera = resources.obtain("camera", Camera)
    for _ in range(3):
        vision.GetImage("camera")
    resources.release(camera)
    assert not camera.is_active


def interrupt_at(clock, when):
    """Ctrl-C in the script at a time of the clock, which then stands still until it is released."""

    def interrupt():
        clock.hold()
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    clock.call_at(when, interrupt)


def drive_together():
    both = Parallel()
    both.add_task(navigation.DriveMoveDelta, [1000, 20, 20])
    both.add_task(util.Wait, [1e9])
    both.wait_for_all_tasks()


@pytest.mark.parametrize(
    "drive", [partial(navigation.DriveMoveDelta, 1000, 20, 20), drive_together]
)
def test_what_a_script_catches_of_ctrl_c_has_ended_its_task(clock, drive):
    manager = get_task_manager()
    interrupt_at(clock, 3.0)
    with pytest.raises(KeyboardInterrupt):
        drive()
    clock.release()
    assert manager.running == []
    util.Wait(2000)  # it brakes
    before = pose().x
    assert 0.4 < before < 0.9
    util.Wait(5000)
    assert pose().x == pytest.approx(before, abs=0.001)


def test_a_script_that_waits_in_a_thread_is_told_of_the_shutdown(clock):
    manager, begun, told = get_task_manager(), threading.Event(), []

    async def wait_for_ever(context):
        begun.set()
        await trio.sleep_forever()

    def wait():
        both = Parallel()
        for _ in range(2):
            both.add_task(wait_for_ever)
        try:
            both.wait_for_all_tasks()
        except RuntimeError as error:
            told.append(str(error))

    thread = threading.Thread(target=wait)
    thread.start()
    assert begun.wait(10)
    manager.shutdown()
    thread.join(10)
    assert told == ["the task manager has ended"]


def test_what_nobody_hears_is_printed_by_a_plain_script(tmp_path):
    config = tmp_path / "silent.xml"
    config.write_text(
        '<Resources><Devices><Device id="speaker" type="Hri.SilentSpeaker"/>'
        '<Device id="voice" type="Hri.EspeakVoice"/></Devices></Resources>'
    )
    script = (
        "from hri.task.script import use\nfrom hri.task.speech import Speak\n"
        f'use({str(config)!r})\nSpeak("Hi.")\n'
    )
    run = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False, timeout=300
    )
    assert (run.stdout, run.returncode) == ("said: Hi.\n", 0), run.stderr
