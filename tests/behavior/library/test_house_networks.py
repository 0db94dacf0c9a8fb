"""The networks of `config/networks`, run in a simulated room."""

import re

import pytest

from hri.behavior.behavior import Context
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.hal.configuration import load_configuration
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld
from hri.testing import live

WORLD = """\
[robot]
start = [0, 0]
[person]
at = [-3, 3]
[[wall]]
from = [1, -5]
to = [1, 5]
[[object]]
name = "dollar_front.jpg"
at = [0.95, 0.05]
[[object]]
name = "cup"
at = [0.98, -0.25]
[[object]]
name = "dollar_back.jpg"
at = [3, 0]
"""
NETWORKS = [
    "check_stopcrash",
    "config-ir",
    "objrec_network",
    "objrec_tut_final",
    "unit_test",
    "wander",
]
CONFIGURATION = """\
<Resources>
  <Dimensions>
    <Shape id="body" type="rectangular">
      <Parameter name="lx" value="{lx}"/>
      <Parameter name="ly" value="38"/>
      <Parameter name="lz" value="50"/>
      <Parameter name="x" value="{shape_x}"/>
    </Shape>
  </Dimensions>
  <Devices>
    <DeviceBus id="world" type="Hri.SimulatedWorld">
      <Parameter name="file" value="{world}"/>
      <Parameter name="voice" value="mute"/>
      <Device id="camera" type="Hri.SimulatedCamera"/>
      <Device id="drive" type="Hri.SimulatedDrive"/>
      <Device id="range_front" type="Hri.SimulatedRangeSensor">
        <Parameter name="x" value="20"/>
        <Parameter name="y" value="{y}"/>
        <Parameter name="yaw" value="{yaw}"/>
        <Parameter name="max_range" value="2"/>
        <Parameter name="noise" value="0"/>
      </Device>
    </DeviceBus>
    <Device id="mute" type="Hri.EspeakVoice"/>
    <Device id="screen" type="Hri.BlankScreen"/>
  </Devices>
</Resources>
"""


@pytest.fixture
def robot(tmp_path):
    """Makes a context with the sensor and the body of the guide's tutorial, a wall ahead."""
    made = []

    def make(*, lx=48, shape_x=0, y=0, yaw="0"):
        world = tmp_path / "world.toml"
        world.write_text(WORLD)
        path = tmp_path / "config.xml"
        path.write_text(CONFIGURATION.format(lx=lx, shape_x=shape_x, y=y, yaw=yaw, world=world))
        configuration, clock = load_configuration(path), FakeClock()
        resources = ResourceManager(configuration.devices, clock, shapes=configuration.shapes)
        made.append(resources)
        return Context(clock, EventBus(clock), resources)

    yield make
    for resources in made:
        resources.close()


@pytest.fixture
def house():
    """A context with the devices that everybody gets, on fake time."""
    configuration, clock = load_configuration(paths.find("config", "resource-config")), FakeClock()
    resources = ResourceManager(configuration.devices, clock, shapes=configuration.shapes)
    yield Context(clock, EventBus(clock), resources)
    resources.close()


@pytest.mark.parametrize("name", NETWORKS)
def test_each_network_runs_with_the_devices_that_everybody_gets(name, house):
    network = load_network(f"networks/{name}")
    network.check()
    runner = Runner(network, house)
    live(house, [runner], 1.0)
    assert runner.statistics.ticks >= 10
    assert runner.statistics.failures == 0


def run(name, context, seconds):
    network = load_network(f"networks/{name}")
    network.check()
    live(context, [Runner(network, context)], seconds)
    return network


RING = re.compile(r"Input (back|front|left|right)  double: (\S+)")


def ring_after(context, capsys):
    """What each side printed at the first tick, in the order in which it was printed."""
    run("config-ir", context, 0.05)
    lines = capsys.readouterr().out.splitlines()
    return {match[1]: match[2] for match in map(RING.fullmatch, lines)}


@pytest.mark.proves("B10", "B21", "B22")
def test_the_ring_prints_each_side_in_the_order_of_the_guide(robot, capsys):
    sides = ring_after(robot(), capsys)
    assert list(sides.items()) == [
        ("back", "1.79769e+308"),
        ("front", "76"),
        ("left", "1.79769e+308"),
        ("right", "1.79769e+308"),
    ]


@pytest.mark.proves("B21")
@pytest.mark.parametrize(
    ("changes", "sides"),
    [
        ({"yaw": "pi/4"}, {"front"}),
        ({"yaw": "pi/4", "y": 10}, {"front", "left"}),
        ({"yaw": "pi/2", "y": 10}, set()),
    ],
)
def test_where_the_sensor_sits_and_looks_decides_the_sides(changes, sides, robot, capsys):
    values = ring_after(robot(**changes), capsys)
    assert {side for side, value in values.items() if value != "1.79769e+308"} == sides


@pytest.mark.proves("B21")
@pytest.mark.parametrize(("changes", "front"), [({"lx": 68}, 66), ({"shape_x": -10}, 86)])
def test_the_box_around_the_robot_changes_the_distance(changes, front, robot, capsys):
    assert float(ring_after(robot(**changes), capsys)["front"]) == pytest.approx(front, abs=0.1)


@pytest.mark.proves("B17")
def test_check_stopcrash_stops_the_base_before_the_obstacle(robot, capsys):
    context = robot()
    base = context.resources.obtain("world", SimulatedWorld).base
    network = run("check_stopcrash", context, 15.0)
    # The front sensor is 20 cm ahead and the wall at 100 cm: less than 60 are free from 20 on.
    assert base.pose.x == pytest.approx(0.20, abs=0.01)
    assert base.velocity.linear == 0.0
    assert network["stop_crash"].velocity.value == 0.0
    readings = [line.split()[-1] for line in capsys.readouterr().out.splitlines()]
    assert readings[0] == "80"
    assert float(readings[-1]) < 60


@pytest.mark.proves("B10", "B23")
def test_objrec_network_shows_the_picture_and_prints_name_and_distance(robot, capsys):
    context = robot()
    network = run("objrec_network", context, 0.25)
    assert network["behavior1"].raw_image.value is not None
    printed = capsys.readouterr().out.splitlines()
    assert printed[::2] == ["Input behavior4  string: dollar_front.jpg"] * (len(printed) // 2)
    distances = [float(line.split()[-1]) for line in printed[1::2]]
    assert len(distances) >= 2
    assert distances == pytest.approx([95.1] * len(distances), abs=1.0)


def test_a_model_set_that_is_not_there_is_told_before_anything_opens(tmp_path):
    path = tmp_path / "net.xml"
    path.write_text(
        '<BehaviorNetwork><Behavior id="see" type="Hri.ObjRecRecognizer">'
        '<Parameter name="modelset" value="defult.mdl"/></Behavior></BehaviorNetwork>'
    )
    with pytest.raises(HriError, match=r'no "defult\.mdl" in config/models - did you mean'):
        load_network(path).check()


@pytest.mark.proves("P08")
def test_the_network_that_tests_behaviors_passes_and_would_notice_an_error(robot, capsys):
    run("unit_test", robot(), 0.05)
    assert capsys.readouterr().out == "Input passed  boolean: true\n"
    network = load_network("networks/unit_test")
    network["two"].set_parameter("parsed_value", "2.5")
    live(context := robot(), [Runner(network, context)], 0.05)
    assert capsys.readouterr().out == "Input passed  boolean: false\n"


@pytest.mark.proves("B29", "P08")
def test_wander_drives_about_for_minutes_and_touches_nothing(house):
    base = house.resources.obtain("world", SimulatedWorld).base
    touched = []

    def look():
        touched.append(base.is_touching)
        house.clock.call_at(house.clock.now() + 0.1, look)

    look()
    run("wander", house, 120.0)
    assert len(touched) >= 1200
    assert not any(touched)
    assert base.way > 12.0
