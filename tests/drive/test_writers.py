"""Several who write one drive: the second is refused, or the ranks decide."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from hri.behavior.behavior import Context
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.running import Networks
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event, Twist
from hri.drive.behaviors import COMMAND
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import PATIENCE, DriveSystem
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.pending import Interrupted
from hri.hal.rank import Outranked
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld

WORLD = Description("world", "Hri.SimulatedWorld", {"voice": "mute"})
MUTE = Description("mute", "Hri.EspeakVoice")
DRIVE = Description("drive", "Hri.SimulatedDrive")

DRIVER = """\
  <Behavior id="{id}_speed" type="Hri.Constant">
    <Parameter name="parsed_value" value="{speed}"/>
  </Behavior>
  <Behavior id="{id}" type="Hri.DriveSystem"><Parameter name="rank" value="{rank}"/></Behavior>
  <Link from="{id}_speed.value" to="{id}.linear_velocity"/>
"""
GATED = """\
  <Behavior id="gate" type="Hri.CommandGate"/>
  <Behavior id="wheels" type="Hri.DriveSystem"/>
  <Link from="gate.velocity" to="wheels.velocity"/>
"""


def driver(id: str, speed: float, rank: str = "behaviors") -> str:
    return DRIVER.format(id=id, speed=speed, rank=rank)


def written(folder: Path, name: str, *parts: str) -> Path:
    path = folder / f"{name}.xml"
    inside = "".join(parts)
    path.write_text(f'<BehaviorNetwork invocation_interval="0.05">\n{inside}</BehaviorNetwork>\n')
    return path


class Stage:
    """A simulated base and the networks that run on it."""

    def __init__(self, folder: Path) -> None:
        self.clock = FakeClock()
        self.resources = ResourceManager([WORLD, MUTE, DRIVE], self.clock)
        self.context = Context(self.clock, EventBus(self.clock), self.resources)
        self.networks = Networks(self.context)
        self.drive = self.resources.obtain("drive", DriveSystem)
        self._folder = folder

    def start(self, name: str, *parts: str) -> Network:
        network = load_network(written(self._folder, name, *parts))
        self.networks.start(network)
        return network

    def run(self, seconds: float) -> float:
        """Tick all networks; how fast the base is in the end."""
        for _ in range(round(seconds / 0.05)):
            for runner in self.networks.runners.values():
                runner.tick(self.clock.now())
            self.clock.advance(0.05)
        world = self.resources.obtain("world", SimulatedWorld)
        world.advance(self.clock.now())
        return world.base.velocity.linear


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[Stage]:
    stage = Stage(tmp_path)
    yield stage
    stage.networks.close()
    stage.resources.close()


def test_two_of_one_network_are_refused_at_load_with_the_places_of_both(tmp_path: Path) -> None:
    path = written(tmp_path, "both", driver("ahead", 20), driver("back", -10))
    with pytest.raises(AuthoringError) as error:
        load_network(path)
    words = str(error.value)
    assert words.startswith(
        f'{path}:10:3: "back" steers "drive" with the rank "behaviors", as "ahe'
    )
    assert f'"ahead" ({path}:5:3) does - take one out' in words
    assert "\n" not in words


def test_two_networks_of_one_app_are_refused_before_anything_is_opened(tmp_path: Path) -> None:
    written(tmp_path, "first", driver("ahead", 20))
    written(tmp_path, "second", driver("back", -10))
    (tmp_path / "app.toml").write_text('networks = ["first.xml", "second.xml"]\n')
    with pytest.raises(AuthoringError, match=r'second.xml:5:3: "back" .* as "ahead" \(.*first.xml'):
        Robot(str(tmp_path), config="simulated", clock=FakeClock())


def test_a_network_that_is_started_later_is_refused_and_the_first_drives_on(stage: Stage) -> None:
    stage.start("first", driver("ahead", 20))
    assert stage.run(1.0) == pytest.approx(0.2)
    with pytest.raises(HriError, match=r'"ahead" steers it already.*"back" - stop one'):
        stage.start("second", driver("back", -10))
    assert stage.run(1.0) == pytest.approx(0.2)
    stage.networks.stop("first")
    stage.start("second", driver("back", -10))
    assert stage.run(1.0) == pytest.approx(-0.1)


def test_the_higher_rank_drives_and_the_lower_goes_on_after_it(stage: Stage) -> None:
    refused: list[Event] = []
    stage.context.events.subscribe("drive.refused", refused.append)
    stage.start("low", driver("ahead", 20))
    stage.start("high", driver("hand", -10, "teleop"))
    speeds = {round(stage.run(0.05), 3) for _ in range(20)}
    assert max(speeds) <= 0.0
    assert stage.run(1.0) == pytest.approx(-0.1)
    assert ['the behavior "hand" steers it' in e.properties["words"] for e in refused] == [True]
    stage.networks.stop("high")
    assert stage.run(1.5) == pytest.approx(0.2)


def test_a_stick_at_rest_steers_nothing(stage: Stage) -> None:
    stage.start("low", driver("ahead", 20))
    stage.start("high", driver("hand", 0, "teleop"))
    assert stage.run(1.0) == pytest.approx(0.2)


def test_a_network_that_ends_leaves_the_drive_to_whoever_steers_it(stage: Stage) -> None:
    stage.start("low", driver("ahead", 20))
    stage.start("high", driver("hand", 30, "teleop"))
    stage.run(1.0)
    stage.networks.stop("low")
    assert stage.run(0.05) == pytest.approx(0.3)


def test_a_script_moves_the_base_while_the_gate_of_a_network_is_idle(stage: Stage) -> None:
    stage.start("moving", GATED)
    stage.run(0.2)
    pending = stage.drive.move_delta(0.2, 0.2, 0.4)
    assert stage.run(0.7) == pytest.approx(0.2)
    stage.run(1.8)
    pending.result()


def test_a_script_that_drove_freely_and_stopped_holds_the_drive_no_longer(stage: Stage) -> None:
    stage.start("moving", GATED)
    stage.drive.move_and_turn(0.2, 0.4, 0.0, 1.0)
    assert stage.run(1.0) == pytest.approx(0.2)
    stage.drive.move_and_turn(0.0, 0.4, 0.0, 1.0)
    assert stage.run(1.5) == 0.0
    for _ in range(20):
        stage.context.board.slot(COMMAND).set(Twist(-0.1), stage.clock.now())
        speed = stage.run(0.05)
    assert speed == pytest.approx(-0.1)


def test_a_script_does_not_undo_what_a_network_wants(stage: Stage) -> None:
    stage.start("moving", driver("ahead", 20))
    stage.run(1.0)
    with pytest.raises(Outranked, match=r'the behavior "ahead" steers it .* - wait'):
        stage.drive.move_delta(-0.5, 0.2, 0.4)
    with pytest.raises(Outranked):
        stage.drive.set_velocity(Twist(-0.2), stage.clock.now())
    assert stage.run(0.5) == pytest.approx(0.2)
    stage.drive.halt().wait(3)
    assert stage.run(0.0) == 0.0


def test_what_a_network_wants_goes_before_the_motion_of_a_script(stage: Stage) -> None:
    pending = stage.drive.move_delta(-1.0, 0.2, 0.4)
    stage.start("moving", driver("ahead", 20))
    stage.run(1.5)
    with pytest.raises(Interrupted, match="a velocity came in between"):
        pending.result()
    assert stage.run(0.5) == pytest.approx(0.2)


# --- several drives of one base ---

OTHER = Description("other", "Hri.SimulatedDrive", bus="world")


@pytest.fixture
def other(stage: Stage) -> DriveSystem:
    """A second drive on the base of the stage."""
    stage.resources.declare(OTHER)
    return stage.resources.obtain("other", DriveSystem)


def elsewhere(id: str, speed: float, rank: str = "behaviors") -> str:
    drive = '<Parameter name="drive_id" value="other"/>'
    return driver(id, speed, rank).replace(
        '<Parameter name="rank"', drive + '<Parameter name="rank"'
    )


def test_two_networks_on_two_drives_of_one_base_are_refused_with_one_rank(
    stage: Stage, other: DriveSystem
) -> None:
    stage.start("first", driver("ahead", 20))
    with pytest.raises(HriError, match=r'"ahead" steers it already.*"back" - stop one'):
        stage.start("second", elsewhere("back", -10))
    assert stage.run(1.0) == pytest.approx(0.2)
    stage.start("third", elsewhere("hand", -10, "teleop"))
    assert stage.run(1.5) == pytest.approx(-0.1)
    stage.networks.stop("third")
    assert stage.run(1.5) == pytest.approx(0.2)


def test_the_motion_of_one_drive_ends_that_of_another_on_the_same_base(
    stage: Stage, other: DriveSystem
) -> None:
    first = stage.drive.move_delta(1.0, 0.2, 0.4)
    stage.run(1.0)
    second = other.move_delta(-1.0, 0.2, 0.4)
    with pytest.raises(Interrupted, match="another command took its place"):
        first.result()
    assert stage.run(2.0) == pytest.approx(-0.15)
    stage.drive.halt().wait(3)
    assert stage.run(0.0) == 0.0
    with pytest.raises(Interrupted, match="another command took its place"):
        second.result()


def test_a_velocity_that_has_expired_ends_no_later_one_of_another_drive(
    stage: Stage, other: DriveSystem
) -> None:
    for _ in range(20):
        now = stage.clock.now()
        stage.drive.set_velocity(Twist(0.1), now, now + 0.05)
        other.set_velocity(Twist(0.2), now, now + PATIENCE)
        stage.run(0.05)
    stage.resources.release(stage.drive)
    assert stage.run(0.1) == pytest.approx(0.2)
    assert stage.run(0.3) < 0.1


def test_a_stop_of_one_drive_latches_its_base(stage: Stage, other: DriveSystem) -> None:
    assert isinstance(stage.drive, EmergencyStop)
    assert isinstance(other, EmergencyStop)
    pending = other.move_delta(1.0, 0.2, 0.4)
    stage.run(1.0)
    stage.drive.stop_latched("you said stop")
    assert pending.is_done
    assert other.is_latched
    with pytest.raises(HriError, match="you said stop - unlatch"):
        other.move_delta(0.2, 0.2, 0.4).wait(1.0)
    assert stage.run(0.5) == 0.0


# --- what arrives at a supervisor ---


def create2(folder: Path) -> Robot:
    """An app of nothing but a gate, on an emulated Create 2."""
    written(folder, "moving", GATED)
    (folder / "app.toml").write_text('networks = ["moving.xml"]\n')
    return Robot(str(folder), config="create2", clock=FakeClock())


def test_each_command_arrives_at_the_supervisor_with_the_rank_it_has(tmp_path: Path) -> None:
    levels: dict[str, set[str]] = {}
    with create2(tmp_path) as robot:
        bus = robot.resources.obtain("base", BaseBus)
        bus.unlatch()
        robot.wait(1.0)
        kind = "at rest"
        bus.watch(lambda state: levels.setdefault(kind, set()).add(str(state.level)))
        robot.wait(1.0)
        kind = "move"
        robot.move(0.3)
        robot.wait(1.0)

        async def ask(context):
            end = context.clock.now() + 0.5
            while context.clock.now() < end:
                context.networks.inject("moving", "gate", "twist", Twist(0.1))
                await context.clock.sleep(0.02)

        kind = "network"
        robot.run(ask)
        kind = "script"
        robot.wait(1.0)
        robot.resources.obtain("drive", DriveSystem).move_delta(0.1, 0.1, 0.4).wait(10)
    assert levels["at rest"] == {"nobody"}
    assert levels["move"] == {"tasks", "nobody"}
    assert "behaviors" in levels["network"]
    assert "tasks" not in levels["network"]
    assert "tasks" in levels["script"]


def test_a_network_that_takes_the_place_of_another_takes_over_its_drive(
    stage: Stage, tmp_path: Path
) -> None:
    stage.start("first", driver("ahead", 20))
    assert stage.run(1.0) == pytest.approx(0.2)
    ends = []
    stage.drive.deactivate = lambda: ends.append("closed")  # type: ignore[method-assign]
    next_one = load_network(written(tmp_path, "next", driver("ahead", 10)))
    next_one.name = "first"
    stage.networks.swap("first", next_one)
    assert stage.run(1.0) == pytest.approx(0.1)
    assert ends == []


def test_one_that_cannot_take_the_place_leaves_the_drive_where_it_was(
    stage: Stage, tmp_path: Path
) -> None:
    stage.start("first", driver("ahead", 20))
    missing = '  <Behavior id="eye" type="Hri.Camera"/>\n'
    next_one = load_network(written(tmp_path, "next", driver("ahead", 10), missing))
    next_one.name = "first"
    with pytest.raises(HriError, match="camera"):
        stage.networks.swap("first", next_one)
    assert stage.run(1.0) == pytest.approx(0.2)
    with pytest.raises(HriError, match="steers it already"):
        stage.start("second", driver("back", -10))
