"""`hri drive`: keys, the picture, and driving an emulated base through its supervisor."""

import argparse
import math
import os
import select
import termios
import tty
from dataclasses import replace

import pytest
from hypothesis import given, strategies as st

from hri.cli.drive import add_arguments, base_of, keys, opened, run
from hri.cli.drive.keys import DEAD_MAN, KeyReader, Steering
from hri.cli.drive.teleop import Teleop
from hri.cli.drive.terminal_view import FORMER_SCREEN, TerminalView
from hri.cli.drive.text_map import COLUMNS, ROWS, TextMap
from hri.cli.drive.view import Snapshot, View
from hri.cli.drive.window_view import ALARM, WindowView
from hri.core import registry
from hri.core.clock import FakeClock
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Pose2D, Twist
from hri.drive.bases.protocol import BaseReport
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.supervisor.base_devices import BaseOdometry
from hri.drive.supervisor.base_registry import Create2Bus
from hri.drive.supervisor.link import State
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.motion import REST, Way
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.bases.emulated_base import Create2Line

FASTEST = Twist(0.4, 1.0)
PATIENCE = 5.0


def options(*words):
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return parser.parse_args(words)


# --- keys ---


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"w", ["w"]),
        (b"\x1b[A\x1bOD", ["up", "left"]),
        (b"\x03", ["ctrl-c"]),
        (b"\x1b[1;5Cw", ["w"]),
        (b"W", ["w"]),
        (b"\x00\xff", []),
    ],
)
def test_what_a_terminal_sends_is_read_as_keys(data, expected):
    assert KeyReader().feed(data) == expected


@given(st.binary(max_size=64))
def test_no_bytes_of_a_terminal_do_harm(data):
    reader = KeyReader()
    assert all(isinstance(key, str) for key in reader.feed(data))
    reader.feed(b"~~")
    assert reader.feed(b"w") == ["w"]


@given(st.integers(1, 2))
def test_an_arrow_that_comes_in_parts_is_an_arrow(size):
    reader = KeyReader()
    assert reader.feed(b"\x1b[A"[:size]) == []
    assert reader.feed(b"\x1b[A"[size:] + b"w") == ["up", "w"]


def test_a_key_counts_for_the_dead_mans_time_and_no_longer():
    steering = Steering()
    steering.press("up", 1.0)
    assert steering.twist(FASTEST, 0.2, 1.0 + DEAD_MAN - 0.01).linear > 0
    assert steering.twist(FASTEST, 0.2, 1.0 + DEAD_MAN + 0.01) == REST


def test_letting_go_stops_at_once():
    steering = Steering()
    steering.press("up", 1.0)
    steering.let_go()
    assert steering.twist(FASTEST, 0.2, 1.0) == REST


def test_keys_that_mean_nothing_leave_it_as_it_is():
    steering = Steering()
    steering.press("up", 1.0)
    before = steering.twist(FASTEST, 0.2, 1.1)
    steering.press("z", 1.1)
    assert steering.twist(FASTEST, 0.2, 1.1) == before


@given(
    st.lists(st.sampled_from([*keys.DIRECTIONS, *keys.FASTER, *keys.SLOWER]), max_size=30),
    st.floats(0, 0.5),
    st.floats(0, 4),
    st.floats(0, 0.5),
)
def test_keys_never_ask_for_more_than_is_allowed(pressed, forward, angular, backward):
    steering = Steering()
    for key in pressed:
        steering.press(key, 1.0)
        twist = steering.twist(Twist(forward, angular), backward, 1.0)
        assert -backward <= twist.linear <= forward
        assert abs(twist.angular) <= angular


# --- the picture ---


def standing(pose):
    return Snapshot(State(0.0), pose, REST, 0.5, 0.0)


def test_the_picture_tells_pose_sensors_and_why_it_stands():
    report = BaseReport(
        time=1.0,
        rolled=Way(),
        velocity=Twist(0.1, 0.0),
        bumps={"left": True, "right": False},
        cliffs={"front_left": False},
        buttons={"clean": True, "spot": False},
        ranges={"left": 0.25, "right": math.inf},
        battery=0.5,
        voltage=14.4,
        is_charging=True,
        mode="safe",
    )
    state = State(1.0, report=report, is_open=True, faults=("my left bumper is stuck",))
    moment = Snapshot(state, Pose2D(1.0, -0.5, 0.0), Twist(0.2, 0.0), 0.5, 1.0)
    shown = "\n".join(TextMap("A base").lines(moment))
    odd = replace(report, battery=None, battery_fault="says 65529 of 2696 mAh")
    told = TextMap("A base").lines(replace(moment, state=replace(state, report=odd)))
    assert "unknown: it says 65529 of 2696 mAh   14.4 V" in "\n".join(told)
    for words in (
        "A base",
        "x +1.00 m   y -0.50 m   +0 degrees",
        "left PRESSED   right .",
        "front left .",
        "buttons clean PRESSED\n",
        "left 0.25 m   right -",
        "50%   14.4 V   charging",
        "press r to release it",
        "my left bumper is stuck",
    ):
        assert words in shown
    assert "→" in shown


def test_the_map_shows_where_the_base_came_from():
    picture = TextMap("A base")
    for step in range(11):
        lines = picture.lines(standing(Pose2D(step * 0.1, 0.0, math.pi / 2)))
    middle = lines[2 + ROWS // 2]
    assert middle[1 + COLUMNS // 2] == "↑"
    assert middle[1 : 1 + COLUMNS // 2].endswith("··········")


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
def test_the_map_is_of_one_size_wherever_the_base_is(x, y, heading):
    lines = TextMap("A base").lines(standing(Pose2D(x, y, heading)))
    assert [len(line) for line in lines[1 : ROWS + 3]] == [COLUMNS + 2] * (ROWS + 2)


@pytest.mark.parametrize("most", [5, 12, 24, 60])
def test_the_map_leaves_room_for_what_is_known(most):
    lines = TextMap("A base").lines(standing(Pose2D()), most)
    assert any("its port is closed" in line for line in lines)
    assert len(lines) <= max(most, 8)


# --- driving ---


@pytest.fixture
def base():
    """The bus of an emulated base, its odometry, and the fake clock."""
    clock = FakeClock()
    manager = ResourceManager([], clock)
    bus = Create2Bus(Description("base", "Hri.Create2", {"port": "simulated"}), manager)
    line = Create2Line(Description("base_line", "Hri.EmulatedCreate2"), manager)
    odometry = BaseOdometry(Description("odometry", "Hri.BaseOdometry", bus="base"), manager)
    manager.substitute("base_line", line)
    manager.substitute("base", bus)
    odometry.activate()
    yield bus, odometry, clock
    odometry.deactivate()
    manager.close()


class Script(View):
    """Presses keys at times, in seconds from the beginning, and keeps what it was shown."""

    def __init__(self, script, clock):
        self._left = sorted(script.items())
        self._clock, self._begun = clock, clock.now()
        self._picture = TextMap("A base")
        self.shown = []

    def read_keys(self):
        pressed = []
        while self._left and self._left[0][0] <= self._clock.now() - self._begun + 1e-6:
            pressed += self._left.pop(0)[1]
        return pressed

    def show(self, moment):
        self.shown.append("\n".join(self._picture.lines(moment)))


def drive(base, script):
    """Press keys at times, in seconds, then quit; the pictures that were shown."""
    bus, odometry, clock = base
    view = Script(script, clock)
    Teleop(bus, odometry, [view]).run(clock)
    return view.shown


def held(key, start, end, period=0.03):
    """A key with the repetitions that a terminal sends."""
    count = round((end - start) / period)
    return {round(start + i * period, 3): [key] for i in range(count)}


def test_nothing_moves_before_it_is_released(base):
    shown = drive(base, {**held("up", 0.5, 2.0), 2.5: ["x"]})
    assert base[1].pose(0.0).x == 0.0
    assert "press r to release it" in shown[-1]


def test_a_held_key_drives_and_letting_go_stops(base):
    shown = drive(base, {1.0: ["r"], **held("up", 1.5, 3.5), 5.0: ["x"]})
    bus, odometry, clock = base
    way = odometry.pose(clock.now()).x
    assert 0.05 < way < 1.0
    assert bus.state.report.velocity == REST
    assert "by teleop" in "".join(shown)
    # What rolls on after the last key is its dead man's time and the braking.
    at_last_key = next(i for i, text in enumerate(shown) if i * 0.05 >= 3.5)
    assert way - pose_in(shown[at_last_key]) < 0.4 * (DEAD_MAN + 0.5)


def pose_in(text):
    return float(text.split("pose    x ")[1].split(" m")[0])


def test_the_space_bar_stops_and_latches_until_it_is_released(base):
    script = {1.0: ["r"], **held("up", 1.5, 4.0), 2.2: [" "], 4.5: ["r"]}
    shown = drive(base, {**script, **held("left", 5.0, 6.0), 7.0: ["x"]})
    assert "you pressed the space bar" in shown[round(3.0 / 0.05)]
    assert base[1].pose(0.0).heading > 0.05


def test_while_its_supervisor_is_gone_the_picture_goes_on(base, monkeypatch):
    def refuse(twist):
        raise NotAvailable("its supervisor does not answer")

    monkeypatch.setattr(base[0], "teleop", refuse)
    shown = drive(base, {1.0: ["r"], **held("up", 1.5, 2.5), 3.0: ["x"]})
    assert len(shown) > 55


def test_quitting_lets_the_base_rest(base):
    drive(base, {1.0: ["r"], **held("up", 1.5, 2.5), 2.5: ["x"]})
    base[2].advance(1.0)
    assert base[0].state.report.velocity == REST


def test_a_base_that_is_closed_is_left_standing_and_silent(base):
    bus, odometry, clock = base
    drive(base, {1.0: ["r"], **held("up", 1.5, 2.0), 2.0: ["x"]})
    odometry.deactivate()
    bus.deactivate()
    emulator = bus.manager.obtain("base_line", Create2Line).port.line.emulator
    assert not emulator.is_rolling
    emulator.feed(b"", clock.now() + 0.1)
    assert emulator.feed(b"", clock.now() + 0.5) == b""


# --- which base ---


@pytest.fixture
def registered():
    if "Hri.Create2" not in registry.known("hri.resources"):
        pytest.skip("this checkout was installed before there were bases - install it again")


CONFIGURATION = """\
<Resources>
  <Devices>
    <DeviceBus id="wheels" type="Hri.ArduinoBridge">
      <Parameter name="port" value="/dev/ttyACM0"/>
      <Parameter name="bumps" value="left:2 right:3"/>
    </DeviceBus>
  </Devices>
</Resources>
"""


@pytest.mark.usefixtures("registered")
def test_a_configuration_gives_the_base_and_the_command_its_port(tmp_path):
    path = tmp_path / "robot.xml"
    path.write_text(CONFIGURATION)
    resources = opened(options("--config", str(path), "--simulated"), FakeClock())
    bus = resources.obtain("wheels", BaseBus)
    assert bus.description.parameters == {"port": "simulated", "bumps": "left:2 right:3"}
    resources.close()


@pytest.mark.usefixtures("registered")
@pytest.mark.parametrize(("words", "is_latched"), [(["--simulated"], False), ([], True)])
def test_the_simulated_base_starts_released_and_a_configured_one_latched(words, is_latched):
    clock = FakeClock()
    with opened(options(*words, "--config", "create2.xml"), clock) as resources:
        bus = base_of(resources, options(*words))
        clock.advance(1.0)
        assert bus.is_latched is is_latched


@pytest.mark.usefixtures("registered")
def test_a_configuration_without_a_base_is_refused(tmp_path):
    path = tmp_path / "robot.xml"
    path.write_text("<Resources><Devices/></Resources>")
    with pytest.raises(HriError, match="no base in it"):
        opened(options("--config", str(path)), FakeClock())


@pytest.mark.usefixtures("registered")
@pytest.mark.parametrize(
    ("words", "kind"),
    [(["--simulated"], "Create2Bus"), (["/dev/ttyX", "--base", "arduinobridge"], "ArduinoBus")],
)
def test_a_base_may_be_named(words, kind):
    resources = opened(options(*words), FakeClock())
    (id,) = resources.ids(BaseBus)
    assert resources.driver_of(resources.descriptions[id]).__name__ == kind


def test_a_base_that_nobody_names_is_asked_for():
    with pytest.raises(HriError, match="give its port"):
        opened(options(), FakeClock())


def test_a_port_without_a_base_says_why():
    with pytest.raises(HriError, match="/nowhere: it is not there"):
        opened(options("/nowhere"), FakeClock())


# --- the terminal ---


def test_a_terminal_is_put_back_as_it_was():
    ours, theirs = os.openpty()
    tty.setraw(ours)
    before = termios.tcgetattr(theirs)
    with TerminalView(theirs, theirs, "A base") as terminal:
        os.write(ours, b"w\x1b[A")
        assert terminal.read_keys() == ["w", "up"]
        assert terminal.read_keys() == []
        terminal.show(standing(Pose2D()))
    assert termios.tcgetattr(theirs) == before
    shown = ""
    while not shown.endswith(FORMER_SCREEN) and select.select([ours], [], [], PATIENCE)[0]:
        shown += os.read(ours, 4096).decode()
    assert "A base" in shown
    assert shown.endswith(FORMER_SCREEN)
    os.close(theirs)
    os.close(ours)


# --- the window ---


@pytest.fixture
def screen():
    screen = OffscreenScreen(Description("screen", "Test"), ResourceManager([], FakeClock()))
    screen.activate()
    yield screen
    screen.deactivate()


def alarms(image):
    return int((image == ALARM).all(axis=2).sum())


def test_the_window_shows_what_presses_and_where_the_floor_ends(screen):
    view = WindowView(screen, "A base", 0.17)

    def shown(**sensed):
        report = BaseReport(time=0.0, rolled=Way(), velocity=REST, **sensed)
        view.show(Snapshot(State(0.0, report=report), Pose2D(), REST, 0.5, screen.count * 1.0))
        return alarms(screen.image)

    assert shown(bumps={"left": False}, cliffs={"left": False}) == 0
    touched = shown(bumps={"left": True}, cliffs={"left": False})
    assert 0 < touched < shown(bumps={"left": True}, cliffs={"left": True})


def test_the_window_takes_keys_by_the_names_of_the_terminal(screen, monkeypatch):
    view = WindowView(screen, "A base", 0.17)
    monkeypatch.setattr(screen, "pressed_keys", lambda: ["up", "space", "="])
    assert view.read_keys() == ["up", " ", "+"]


def test_pictures_are_drawn_ten_times_a_second_at_most(screen):
    view = WindowView(screen, "A base", 0.17)
    for step in range(100):
        view.show(Snapshot(State(0.0), Pose2D(), REST, 0.5, step * 0.01))
    assert screen.count <= 11


def test_without_a_terminal_it_says_so():
    with pytest.raises(HriError, match="needs a terminal"):
        run(options("--simulated"))
