"""The samples, each run on fake time in a simulated room."""

import re
from pathlib import Path

import numpy as np
import pytest

from hri.behavior.behavior import Context
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.cli import behave
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.python_file import load_module
from hri.face.model import load_face
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.task import get_task_manager, use
from hri.testing import live, live_for
from tests.net.conftest import WITHIN, Taken

SAMPLES = paths.house() / "docs" / "samples"
GROUPS = [
    *("driver/base", "driver/face", "driver/speech"),
    *("behavior/emotion", "behavior/navigation", "behavior/tracking", "behavior/network"),
    "behavior/resource",
    *("behavior/speech", "behavior/unit_test", "behavior/vision"),
    *("task", "task/custom", "task/parallel", "task/events", "task/primitive"),
    "objrec",
    "color",
]


def load(sample):
    """A program as a module."""
    return load_module(re.sub(r"\W", "_", sample), SAMPLES / sample)


@pytest.fixture
def simulated():
    """A context with the devices that everybody gets, on fake time."""
    with ResourceManager.load("resource-config", FakeClock()) as resources:
        yield Context(resources.clock, EventBus(resources.clock), resources)


def run(network, context, seconds):
    """Run a network file of the samples; the runner."""
    loaded = load_network(SAMPLES / network)
    loaded.check()
    runner = Runner(loaded, context)
    live(context, [runner], seconds)
    assert runner.statistics.failures == 0
    return runner


@pytest.mark.proves("P07", "P08")
def test_the_page_names_a_sample_for_each_group_and_all_links_are_there():
    page = (SAMPLES / "README.md").read_text()
    rows = re.findall(r"^\| \[([\w/]+)\]\(([^)]+)\) \|.*\| `.+` \|$", page, re.MULTILINE)
    assert [group for group, _ in rows] == GROUPS
    for link in re.findall(r"\]\(([^)]+)\)", page):
        assert (SAMPLES / link).exists(), link
    for command in re.findall(r"docs/samples/[\w./-]+", page):
        assert (SAMPLES.parents[1] / command).exists(), command


@pytest.mark.proves("P08")
def test_the_base_reports_drives_and_comes_back(capsys):
    load("driver/base/base.py").main(FakeClock())
    printed = capsys.readouterr().out
    way = [float(text) for text in re.findall(r"odometry +(\S+) cm ahead", printed)]
    assert way == pytest.approx([0, 20, 0], abs=0.2)
    assert printed.count("battery ") == printed.count("range_front ") == 3


@pytest.mark.proves("P08", "R08")
def test_a_program_teaches_a_set_by_pictures_and_recognizes_by_it(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    teaching = load("objrec/teach.py")
    teaching.main([])
    told = capsys.readouterr().out
    found = re.findall(r"room.jpg: (\w+) at \(\d+, \d+\), (\d+) cm away, (\S+) euros", told)
    assert {(name, price) for name, _, price in found} == {("coffee", "1.50"), ("rocket", "2.00")}
    assert all(30 < int(distance) < 200 for _, distance, _ in found)
    assert (tmp_path / "cards.mdl").stat().st_mode & 0o77 == 0
    page = (paths.house() / "docs" / "objects.md").read_text()
    program = (SAMPLES / "objrec/teach.py").read_text()
    for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL):
        for line in block.splitlines():
            assert line.strip() in program, line


@pytest.mark.proves("P08")
def test_the_screen_shows_each_expression(monkeypatch, capsys):
    pictures = []
    monkeypatch.setattr(OffscreenScreen, "show", lambda _, image, time: pictures.append(image))
    load("driver/face/faces.py").main(FakeClock())
    assert capsys.readouterr().out.split() == list(load_face("robot").expressions)
    assert len({picture.tobytes() for picture in pictures}) >= len(pictures) - 1 > 5


@pytest.mark.proves("P08")
def test_the_robot_understands_its_own_voice(capsys):
    load("driver/speech/parrot.py").main(FakeClock())
    lines = re.findall(r"said '(.+)', heard '(.+)'", capsys.readouterr().out)
    assert len(lines) == 3
    assert sum(heard.rstrip("s") == said.rstrip("s") for said, heard in lines) >= 2


@pytest.mark.proves("P08", "P11")
def test_the_face_shows_what_it_feels_and_messages_say_why(capsys):
    robot = Robot(str(SAMPLES / "behavior/emotion"), "simulated", clock=FakeClock())
    screen = robot.resources.obtain("screen", OffscreenScreen)
    pictures = []

    async def look(context):
        while True:
            await context.clock.sleep(4.0)
            pictures.append(screen.image)

    events = live_for(robot, 20.5, *robot.app.load_tasks(), look)
    felt = [event.properties["label"] for event in events if event.name == "emotion.changed"]
    assert {"joy", "anger", "sadness"} <= set(felt)
    messages = capsys.readouterr().out.splitlines()
    assert messages[0] == "person_seen: I am happy because I saw you."
    assert [message.partition(":")[0] for message in messages] == [
        "person_seen",
        "praise",
        "bump",
        "scold",
        "ignored",
    ]
    happy, angry = pictures[1], pictures[2]
    assert np.mean(happy != angry) > 0.001


@pytest.mark.proves("P08")
def test_the_devices_are_told_while_the_robot_turns(simulated, capsys):
    run("behavior/resource/devices.xml", simulated, 4.0)
    printed = capsys.readouterr().out
    for device in ("battery ", "bumper false", "range ", "pose "):
        assert printed.count(f"\n{device}") >= 15, device
    headings = [float(text) for text in re.findall(r"heading (\S+)", printed)]
    assert headings[-1] > 1.0


@pytest.mark.proves("P08")
def test_what_the_person_says_is_printed(simulated, capsys):
    simulated.resources.obtain("world", SimulatedWorld).say("hello robot", at=1.0)
    run("behavior/speech/listening.xml", simulated, 4.0)
    assert 'heard: "hello robot" is greet {}' in capsys.readouterr().out


@pytest.mark.proves("P08")
def test_the_head_is_followed_and_its_nod_is_seen(simulated, capsys):
    world = simulated.resources.obtain("world", SimulatedWorld)
    world.person.nod(at=2.0)
    run("behavior/vision/head.xml", simulated, 5.0)
    printed = capsys.readouterr().out
    assert printed.count("head: time ") > 30
    assert re.search(r"gesture: kind \w*nod", printed)


@pytest.fixture
def script(tmp_path, monkeypatch):
    """The task manager of plain scripts, simulated and on fake time."""
    monkeypatch.chdir(tmp_path)
    use("simulated", FakeClock())
    yield get_task_manager
    get_task_manager().shutdown()
    use()


@pytest.mark.proves("P08")
def test_the_square_is_driven_once_around(script, capsys):
    corners = []
    manager = script()
    base = manager.context.resources.obtain("world", SimulatedWorld).base
    manager.events.subscribe("patrol.turned", lambda _: corners.append((base.pose.x, base.pose.y)))
    load("task/patrol.py").main()
    assert capsys.readouterr().out == "corner 1\ncorner 2\ncorner 3\ncorner 4\nback again\n"
    square = [(0.5, 0.0), (0.5, 0.5), (0.0, 0.5), (0.0, 0.0)]
    assert np.array(corners) == pytest.approx(np.array(square), abs=0.03)


@pytest.mark.proves("P08", "T11")
def test_the_custom_task_counts_and_refuses(script, capsys):
    load("task/custom.py").main()
    *counted, too_few, no_number = capsys.readouterr().out.splitlines()
    assert counted == ["counted 3", "counted 2"]
    assert too_few == "refused: cannot count down from 0 - give 1 or more"
    assert no_number == "refused: Examples.Countdown: start is 'many' - give a whole number"


@pytest.mark.proves("P08", "T08")
def test_tasks_run_at_once_and_one_ends_the_other(script, capsys):
    load("task/parallel.py").main()
    assert capsys.readouterr().out.splitlines() == [
        "drive: SUCCESS speech: SUCCESS",
        "over first: the second",
        "turn: CANCELLED",
    ]


@pytest.mark.proves("P08", "T12", "T13")
def test_tasks_ask_and_answer_by_events(script, capsys):
    load("task/events.py").main()
    *received, answers = capsys.readouterr().out.splitlines()
    assert [line.partition("(")[2] for line in received] == [
        f"number: {n}.000000) (seconds: {n}.000000)}}" for n in range(3)
    ]
    assert answers == "answers: 3"


@pytest.mark.proves("P08", "T20")
def test_the_primitive_creeps_until_it_has_come_far_enough(script, monkeypatch, capsys):
    monkeypatch.setenv("HRI_PATH", str(SAMPLES / "task"))
    base = script().context.resources.obtain("world", SimulatedWorld).base
    load("task/primitive.py").main()
    assert capsys.readouterr().out == "crept 0.30 m\n"
    assert base.pose.x == pytest.approx(0.3, abs=0.05)


@pytest.mark.proves("P08", "B25")
@pytest.mark.slow
def test_the_recognized_object_is_followed_around(simulated):
    world = simulated.resources.obtain("world", SimulatedWorld)

    def apart(x, y):
        pose = world.base.pose
        return np.hypot(pose.x - x, pose.y - y)

    name = "dollar_front.jpg"
    world.place(name, 2.2, -0.3)
    assert run("behavior/tracking/tracking.xml", simulated, 6.0)
    assert apart(2.2, -0.3) == pytest.approx(1.0, abs=0.2)
    world.place(name, 3.5, -0.8)
    run("behavior/tracking/tracking.xml", simulated, 6.5)
    assert apart(3.5, -0.8) == pytest.approx(1.0, abs=0.2)


@pytest.mark.proves("P08")
def test_the_objects_of_the_model_set_are_recognized_and_no_others(monkeypatch, capsys):
    monkeypatch.setenv("HRI_PATH", str(SAMPLES / "objrec"))
    options = ["--config", str(SAMPLES / "objrec/resource-config.xml"), "--fast", "--duration=0.5"]
    assert behave.main([str(SAMPLES / "objrec/recognize.xml"), *options]) == 0
    names = re.findall(r"Input seen  string: (\w+)", capsys.readouterr().out)
    assert names in (["apple", "pear"] * 2, ["pear", "apple"] * 2)


@pytest.mark.proves("P08")
@pytest.mark.parametrize("name", ["wander", "unit_test"])
def test_the_networks_of_the_house_run_as_the_page_says(name, capsys):
    assert f"`behave networks/{name}`" in (SAMPLES / "README.md").read_text()
    assert behave.main([f"networks/{name}", "--fast", "--duration=2"]) == 0


@pytest.mark.proves("P08")
def test_the_two_networks_talk_over_tcp(simulated, capsys):
    server, client = load_network("networks/server"), load_network("networks/client")
    server["server"].set_parameter("tcp_port", 0)
    runners, taken = [Runner(server, simulated), Runner(client, simulated)], Taken()
    try:
        runners[0].start()
        client["client"].set_parameter("tcp_port", server["server"].port_in_use)
        runners[1].start()
        assert server["server"]._link.wait_for_peers(1, WITHIN)
        client["client"]._link.subscribe("tutorial", taken)
        runners[0].tick(0.1)
        taken.wait_for(1)
        runners[1].tick(0.2)
    finally:
        for runner in runners:
            runner.stop()
    assert capsys.readouterr().out == "Input client_received  double: 5\n"


def test_samples_are_short():
    for path in Path(SAMPLES).rglob("*.*"):
        if path.suffix in (".py", ".xml", ".toml"):
            assert len(path.read_text().splitlines()) <= 70, path


@pytest.mark.proves("P08", "R09", "R10")
def test_a_red_ball_is_found_and_nothing_moves(capsys):
    options = ["--config", str(SAMPLES / "color/resource-config.xml"), "--fast", "--duration=1"]
    assert behave.main([str(SAMPLES / "color/colors.xml"), *options]) == 0
    printed = capsys.readouterr().out
    assert "string: red_ball" in printed
    assert re.search(r"double: 2\.[12]", printed)
    assert "boolean: true" not in printed
