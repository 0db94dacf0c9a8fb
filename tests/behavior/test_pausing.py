"""A network is paused, goes on, ticks once, and pauses by itself; meanwhile the base stands."""

import pytest
import trio
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior, Context
from hri.behavior.breakpoint import COMPARISONS, Breakpoint, parse_condition
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.running import Networks
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Twist
from hri.drive.behaviors import COMMAND
from hri.hal.drive import Odometry
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot

INTERVAL = 0.02


class Rising(Behavior):
    """Counts its ticks."""

    number = Output[float]("double", "the count")
    name = Output[str]("string", "even or odd")

    def start(self, context):
        self.count = 0

    def compute(self, now, dt):
        self.count += 1
        self.number.send(float(self.count))
        self.name.send("odd" if self.count % 2 else "even")


class Kept(Behavior):
    """Keeps what came last."""

    number = Input[float]("double", "a number")

    def start(self, context):
        self.kept = []

    def compute(self, now, dt):
        self.kept.append(self.number.value)


def rising():
    network = Network("rising", INTERVAL)
    network.add(Rising("it"))
    network.add(Kept("end"))
    network.connect("it.number", "end.number")
    network.connect("it.number", "board.count")
    network.sort()
    return network


def reading():
    network = Network("reading", INTERVAL)
    network.add(Kept("end"))
    network.connect("board.count", "end.number")
    network.sort()
    return network


def lived(script, *networks):
    """Run networks on fake time with a script (coroutine function) beside."""
    clock = FakeClock()
    context = Context(clock, EventBus(clock), ResourceManager((), clock))
    running = Networks(context)
    runners = [running.start(network) for network in networks]

    async def live():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(running.run)
            await script(clock, context, *runners)
            nursery.cancel_scope.cancel()

    async def both():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            await live()
            nursery.cancel_scope.cancel()

    trio.run(both)
    running.close()


def test_a_paused_network_computes_nothing_and_goes_on_where_it_was():
    told = []

    async def script(clock, context, runner):
        context.events.subscribe("network.*", lambda event: told.append(event.name))
        await clock.sleep(1.0)
        before = runner.network["it"].count
        assert before > 40
        runner.pause()
        await clock.sleep(1.0)
        assert runner.network["it"].count == before
        assert runner.statistics.missed == 0
        runner.resume()
        await clock.sleep(1.0)
        assert runner.network["it"].count > before + 40
        assert runner.statistics.missed == 0

    lived(script, rising())
    assert told == ["network.paused", "network.resumed"]


def test_a_single_tick_computes_once_and_writes_nothing_to_the_board():
    async def script(clock, context, runner, reader):
        with pytest.raises(HriError, match="pause it"):
            runner.step()
        await clock.sleep(0.5)
        runner.pause()
        await clock.sleep(0.1)
        reader.network["end"].kept.clear()
        before = runner.network["it"].count
        runner.step()
        await clock.sleep(0.5)
        assert runner.network["it"].count == before + 1
        assert runner.network["end"].kept[-1] == before + 1
        assert set(reader.network["end"].kept) == {None}, "its slot is empty while it is paused"

    lived(script, rising(), reading())


@pytest.mark.parametrize(
    ("port", "condition", "count"),
    [
        ("it.number", ">= 30", 30),
        ("it.number", "== 3*4", 12),
        ("it.name", "== even", 2),
        ("it.name", "changes", 2),
        ("it.number", "sent", 1),
    ],
)
def test_it_pauses_in_the_tick_in_which_a_condition_holds(port, condition, count):
    async def script(clock, context, runner):
        point = Breakpoint(runner, port, condition)
        await clock.sleep(2.0)
        assert runner.is_paused
        assert runner.network["it"].count == count
        assert runner.paused_by.startswith(f"{port} {condition}: ")
        point.cancel()
        runner.resume()
        await clock.sleep(1.0)
        assert not runner.is_paused

    lived(script, rising())


@pytest.mark.parametrize("text", ["", "<", "30", "< hello", "=> 3", "== ", "> true", "x" * 500])
def test_what_is_not_a_condition_is_refused_with_what_would_be(text):
    with pytest.raises(HriError, match="write < 30"):
        parse_condition(text)


@given(st.sampled_from(sorted(COMPARISONS)), st.integers(-1000, 1000), st.floats())
def test_numbers_are_compared_as_python_does(sign, operand, value):
    holds = parse_condition(f"{sign} {operand}").holds(value, None)
    assert holds == COMPARISONS[sign](value, operand)


@given(st.text(max_size=120), st.one_of(st.none(), st.floats(), st.text(), st.booleans()))
def test_any_text_is_a_condition_that_can_be_asked_or_an_error(text, value):
    try:
        condition = parse_condition(text)
    except HriError:
        return
    assert condition.holds(value, value) in (True, False)


@pytest.mark.parametrize(
    ("port", "condition", "remedy"),
    [
        ("it.name", "< 30", "write == hello"),
        ("it.number", "== true", "write < 30"),
        ("board.count", "== hello", "write < 30"),
        ("board.cuont", "sent", 'did you mean "count"'),
    ],
)
def test_a_condition_that_never_fits_its_port_is_refused(port, condition, remedy):
    async def script(clock, context, runner):
        with pytest.raises(HriError, match=remedy):
            Breakpoint(runner, port, condition)

    lived(script, rising())


def test_the_event_of_a_breakpoint_says_where_and_at_what_value():
    told = []

    async def script(clock, context, runner):
        context.events.subscribe("network.paused", lambda event: told.append(event.properties))
        Breakpoint(runner, "board.count", "> 4")
        await clock.sleep(1.0)
        runner.step()
        await clock.sleep(0.1)
        assert runner.paused_by == "board.count > 4: 6", "the step has ended there, too"

    lived(script, rising())
    because = "board.count > 4: 5"
    assert told == [{"network": "rising", "because": because, "port": "board.count", "value": "5"}]


def test_a_port_that_is_not_there_is_refused():
    async def script(clock, context, runner):
        for port in ("it.nothing", "nobody.number", "it"):
            with pytest.raises(HriError):
                Breakpoint(runner, port, "sent")

    lived(script, rising())


WISHING = """<BehaviorNetwork name="wishing" invocation_interval="0.02">
  <Behavior id="speed" type="Hri.Constant"><Parameter name="parsed_value" value="20"/></Behavior>
  <Link from="speed.value" to="board.wish"/>
</BehaviorNetwork>"""
MOVING = """<BehaviorNetwork name="moving" invocation_interval="0.02">
  <Behavior id="drive" type="Hri.DriveSystem"/>
  <Link from="board.wish" to="drive.linear_velocity"/>
</BehaviorNetwork>"""


CAREFUL = """<BehaviorNetwork name="careful" invocation_interval="0.02">
  <Behavior id="speed" type="Hri.Constant"><Parameter name="parsed_value" value="0.2"/></Behavior>
  <Link from="speed.value" to="board.factor"/>
</BehaviorNetwork>"""
GATED = """<BehaviorNetwork name="gated" invocation_interval="0.02">
  <Behavior id="gate" type="Hri.CommandGate"/>
  <Behavior id="drive" type="Hri.DriveSystem"/>
  <Link from="board.factor" to="gate.speed"/>
  <Link from="gate.velocity" to="drive.velocity"/>
</BehaviorNetwork>"""


@pytest.fixture
def app(tmp_path):
    """A function that makes an app of networks."""

    def make(**networks):
        names = ", ".join(f'"{name}.xml"' for name in networks)
        (tmp_path / "app.toml").write_text(f'about = "drives"\nnetworks = [{names}]\n')
        for name, text in networks.items():
            (tmp_path / f"{name}.xml").write_text(text)
        return str(tmp_path)

    return make


@pytest.mark.parametrize("paused", ["careful", "gated"])
def test_the_base_stands_though_the_network_that_is_paused_would_slow_it_down(app, paused):
    with Robot(app(careful=CAREFUL, gated=GATED), "simulated", clock=FakeClock()) as robot:
        odometry = robot.resources.obtain("odometry", Odometry)
        stopped = []
        robot.events.subscribe("drive.stopped", lambda event: stopped.append(event.properties))

        def speeds(seconds):
            found = []
            for _ in range(round(seconds / 0.05)):
                now = robot.clock.now()
                robot.board.slot(COMMAND).set(Twist(0.3, 0.0), now)
                robot.wait(0.05)
                found.append(odometry.velocity(robot.clock.now()).linear)
            return found

        assert speeds(2.0)[-1] == pytest.approx(0.06, abs=0.01)
        robot.networks.runners[paused].pause()
        while_paused = speeds(2.0)
        assert max(while_paused) <= 0.07, "without its word it would be five times as fast"
        assert set(while_paused[10:]) == {0}
        robot.networks.runners[paused].resume()
        again = speeds(2.0)
        assert again[-1] == pytest.approx(0.06, abs=0.01)
        assert again[0] < 0.03, "it sets off gently"
        assert paused == "gated" or {"reason": "paused"} in stopped


@pytest.mark.parametrize("paused", ["wishing", "moving"])
def test_the_base_stands_while_a_network_is_paused_that_drives_or_feeds_what_does(paused, app):
    with Robot(app(wishing=WISHING, moving=MOVING), "simulated", clock=FakeClock()) as robot:
        odometry = robot.resources.obtain("odometry", Odometry)

        def speed_after(seconds):
            robot.wait(seconds)
            return odometry.velocity(robot.clock.now()).linear

        assert speed_after(2.0) > 0.1
        runner = robot.networks.runners[paused]
        runner.pause()
        assert speed_after(1.0) == 0
        runner.step()
        assert speed_after(0.1) == 0
        runner.resume()
        assert speed_after(1.0) > 0.1
