"""The tutorials of behaviors, run on fake time in simulated rooms."""

import itertools
import re

import pytest

from hri.behavior.behavior import Context
from hri.behavior.catalog import find_behavior, type_of
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.network_writer import save_network
from hri.behavior.runner import Runner
from hri.behavior.schema import schema_of
from hri.cli import behave
from hri.cli.main import main
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld
from hri.testing import live
from tests.behavior.library.ticking import tick
from tests.docs.tutorial import Tutorial


@pytest.fixture
def network_tutorial():
    return Tutorial("behavior-01-network")


@pytest.fixture
def behavior_tutorial(monkeypatch):
    tutorial = Tutorial("behavior-02-custom-behavior")
    monkeypatch.chdir(tutorial.folder)
    monkeypatch.setenv("HRI_PATH", ".")
    return tutorial


@pytest.fixture
def robot():
    """Makes a context with the devices of a configuration."""
    made = []

    def make(config="resource-config"):
        resources = ResourceManager.load(config, FakeClock())
        made.append(resources)
        return Context(resources.clock, EventBus(resources.clock), resources)

    yield make
    for resources in made:
        resources.close()


def run(network, context, seconds):
    """Run a network; the simulated base."""
    network.check()
    base = context.resources.obtain("world", SimulatedWorld).base
    live(context, [Runner(network, context)], seconds)
    return base


def test_excerpts_are_those_of_the_files(network_tutorial, behavior_tutorial):
    for tutorial in (network_tutorial, behavior_tutorial):
        assert tutorial.strangers("python") == tutorial.strangers("xml") == []


# --- 01-network ---


@pytest.mark.proves("B10", "B23")
def test_the_object_and_its_distance_are_printed_as_the_page_shows(network_tutorial, capsys):
    assert behave.main(["networks/objrec_network", "--duration=5", "--fast"]) == 0
    printed = capsys.readouterr().out
    assert network_tutorial.prints(printed)
    assert printed.count("string: dollar_front.jpg") >= 48


@pytest.mark.proves("B23")
def test_the_robot_keeps_80_cm_away_from_the_object(network_tutorial, capsys):
    assert behave.main(["networks/objrec_tut_final", "--duration=10", "--fast"]) == 0
    distances = [float(text) for text in re.findall(r"double: (\S+)", capsys.readouterr().out)]
    assert distances[0] > 170
    assert all(later < earlier + 0.5 for earlier, later in itertools.pairwise(distances))
    assert distances[-1] == pytest.approx(80, abs=0.5)


@pytest.mark.proves("B23")
@pytest.mark.slow
def test_it_follows_an_object_that_moves_and_stops_without_one(robot, capsys):
    context, network = robot(), load_network("networks/objrec_tut_final")
    world = context.resources.obtain("world", SimulatedWorld)
    for x in (1.3, 0.9):
        world.place("dollar_front.jpg", x, 0.0)
        base = run(network, context, 6.0)
        assert x - base.pose.x == pytest.approx(0.8, abs=0.01)
    world.place("dollar_front.jpg", 2.0, 0.0)
    assert run(network, context, 1.5).velocity.linear == pytest.approx(0.3)
    world.place("dollar_front.jpg", -3.0, 0.0)
    assert run(network, context, 1.5).velocity.linear == 0.0


@pytest.mark.proves("P03")
def test_the_network_can_be_written_in_python_kept_as_xml_and_drawn(robot, tmp_path, capsys):
    written = load_network("networks/objrec_tut_final")
    made = Network("made")
    for behavior in written.behaviors:
        same = made.add(find_behavior(type_of(behavior))(behavior.id))
        for name in behavior.parameters:
            same.set_parameter(name, getattr(behavior, name))
    for link in written.links:
        made.connect(f"{link.source.id}.{link.output}", f"{link.target.id}.{link.input}")
    made.sort()
    save_network(made, tmp_path / "made.xml")

    ends = [
        run(network, robot(), 3.0).pose
        for network in (written, made, load_network(tmp_path / "made.xml"))
    ]
    assert ends[0] == ends[1] == ends[2]
    drawing = tmp_path / "made.svg"
    assert main(["network", "draw", str(tmp_path / "made.xml"), "--out", str(drawing)]) == 0
    assert all(f">{behavior.id}<" in drawing.read_text() for behavior in written.behaviors)


def test_the_first_step_of_the_page_runs_by_itself(network_tutorial, robot, tmp_path):
    behaviors, link = network_tutorial.blocks("xml")[:2]
    path = tmp_path / "net.xml"
    path.write_text(f"<BehaviorNetwork>{behaviors}{link}</BehaviorNetwork>")
    runner = Runner(load_network(path), context := robot())
    live(context, [runner], 1.0)
    assert (runner.statistics.ticks, runner.statistics.failures) == (10, 0)


# --- 02-custom-behavior ---


@pytest.mark.proves("B15")
def test_a_copy_of_the_skeleton_under_another_name_is_a_behavior(tmp_path, monkeypatch, capsys):
    skeleton = paths.house() / "hri/behavior/library/skeleton.py"
    copied = skeleton.read_text().replace("Skeleton", "StopCrash")
    (tmp_path / "stop_crash.py").write_text(copied)
    schema = tmp_path / "behavior" / "Mine" / "StopCrashBehavior.xml"
    schema.parent.mkdir(parents=True)
    schema.write_text(
        '<BehaviorSchema type="Mine.StopCrashBehavior" driver="Mine.StopCrashBehavior"'
        ' library="../../stop_crash.py"/>'
    )
    network = tmp_path / "net.xml"
    network.write_text(
        '<BehaviorNetwork><Behavior id="three" type="Hri.Constant">'
        '<Parameter name="parsed_value" value="3"/></Behavior>'
        '<Behavior id="copy" type="Mine.StopCrashBehavior">'
        '<Parameter name="gain" value="2"/></Behavior>'
        '<Behavior id="show" type="Hri.InputCollector"/>'
        '<Link from="three.value" to="copy.input"/><Link from="copy.output" to="show.input"/>'
        "</BehaviorNetwork>"
    )
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    options = ["--without-resources", "--fast", "--invocation-count=1"]
    assert behave.main([str(network), *options]) == 0
    assert capsys.readouterr().out.endswith("Input show  double: 6\n")


@pytest.mark.proves("B14", "E11")
@pytest.mark.parametrize("name", ["StopCrashBehavior", "StopCrashSelective"])
def test_the_schema_says_what_the_class_declares(behavior_tutorial, name):
    cls = find_behavior(f"Examples.{name}")
    declared = schema_of(cls.__mro__[1])
    written = schema_of(cls)
    for kind in ("parameters", "inputs", "outputs"):
        names = [port.name for port in getattr(declared, kind)]
        assert [port.name for port in getattr(written, kind)] == names
    assert len(find_behavior("Examples.StopCrashBehavior").inputs) == 2
    assert len(find_behavior("Examples.StopCrashBehavior").outputs) == 1


COMMAND = ["check_stopcrash.xml", "--config", "resource-config.xml", "--duration=6", "--fast"]


@pytest.mark.proves("B17")
def test_the_command_of_the_page_prints_what_it_shows(behavior_tutorial, capsys):
    assert f"behave {' '.join(COMMAND[:-1])}\n" in behavior_tutorial.page
    assert behave.main(COMMAND) == 0
    assert behavior_tutorial.prints(capsys.readouterr().out)


@pytest.mark.proves("B16", "B17")
def test_the_robot_stands_where_a_reading_first_falls_below_the_limit(behavior_tutorial, robot):
    base = run(load_network("./check_stopcrash.xml"), robot("./resource-config.xml"), 15.0)
    # The sensor is 20 cm ahead, the board at 90; readings are off by 1 %, that is 0.6 cm.
    assert base.pose.x == pytest.approx(0.10, abs=0.02)
    assert base.velocity.linear == 0.0


@pytest.mark.proves("B18")
@pytest.mark.parametrize(("velocity", "end"), [("-3", -0.15), ("3", 0.0)])
def test_the_exercise_backs_off_from_an_obstacle_ahead(behavior_tutorial, robot, velocity, end):
    network = load_network("./check_selective.xml")
    network["constant"].set_parameter("parsed_value", velocity)
    base = run(network, robot("./resource-config.xml"), 5.0)
    assert base.pose.x == pytest.approx(end, abs=0.01)


@pytest.mark.proves("B16", "B18")
@pytest.mark.parametrize(
    ("velocity", "front", "rear", "plain", "selective"),
    [
        (3.0, 100.0, 100.0, 3.0, 3.0),
        (3.0, 50.0, 100.0, 0.0, 0.0),
        (3.0, 60.0, 100.0, 3.0, 3.0),
        (-3.0, 50.0, 100.0, 0.0, -3.0),
        (-3.0, 100.0, 50.0, -3.0, 0.0),
        (None, 100.0, 100.0, 0.0, 0.0),
    ],
)
def test_what_comes_out(behavior_tutorial, velocity, front, rear, plain, selective):
    stop_crash = find_behavior("Examples.StopCrashBehavior")()
    assert tick(stop_crash, forward_velocity=velocity, range_sensor=front) == {"velocity": plain}
    both = find_behavior("Examples.StopCrashSelective")()
    ports = {"forward_velocity": velocity, "front_sensor": front, "rear_sensor": rear}
    assert tick(both, **ports) == {"velocity": selective}
