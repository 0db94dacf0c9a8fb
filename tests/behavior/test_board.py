"""Links to slots of the board: what they carry, how long it stays, and what is refused at load."""

import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.board import DECLARED, declare_slot
from hri.behavior.library.arithmetic import Addition
from hri.behavior.library.constant import Constant
from hri.behavior.network import Network
from hri.behavior.network_check import check_together, slot_table
from hri.behavior.network_file import load_network
from hri.behavior.network_writer import write_network
from hri.behavior.ports import ANGULAR_VELOCITY, LINEAR_VELOCITY, Input, Output
from hri.behavior.runner import Runner
from hri.core.errors import AuthoringError, HriError
from hri.testing import context


class Now(Behavior):
    """Sends while it is on."""

    number = Output[float]("double", "a number")
    is_on = True

    def compute(self, now, dt):
        if self.is_on:
            self.number.send(now)


class Kept(Behavior):
    """Keeps what came in the last tick."""

    number = Input[float]("double", "a number")

    def compute(self, now, dt):
        self.seen = self.number.value


class Velocities(Behavior):
    """Ports with meanings."""

    turn = Input[float]("double", "rad/s", ANGULAR_VELOCITY)
    truth = Input[bool]("boolean", "a truth")
    go = Output[float]("double", "m/s", LINEAR_VELOCITY)


def network(name, behaviors, *links):
    made = Network(name)
    for id, behavior in behaviors.items():
        behavior.id = id
        made.add(behavior)
    for source, target in links:
        made.connect(source, target)
    made.sort()
    return made


@pytest.fixture
def giving():
    return network("giving", {"now": Now()}, ("now.number", "board.wish"))


@pytest.fixture
def taking():
    return network("taking", {"kept": Kept()}, ("board.wish", "kept.number"))


@pytest.fixture
def both(giving, taking):
    lent = context()
    runners = [Runner(giving, lent), Runner(taking, lent)]
    for runner in runners:
        runner.start()
    yield lent, runners
    for runner in runners:
        runner.stop()


def test_a_value_crosses_from_network_to_network_and_is_gone_when_nothing_comes(both):
    _, (giving, taking) = both
    kept = taking.network["kept"]
    taking.tick(0.5)
    assert kept.seen is None
    giving.tick(1.0)
    taking.tick(1.1)
    assert kept.seen == 1.0
    giving.network["now"].is_on = False
    giving.tick(2.0)
    taking.tick(2.1)
    assert kept.seen is None


def test_a_value_ends_with_the_network_that_wrote_it(both):
    _, (giving, taking) = both
    giving.tick(1.0)
    giving.stop()
    taking.tick(1.1)
    assert taking.network["kept"].seen is None


def test_a_value_knows_its_time_and_its_writer(both):
    lent, (giving, _) = both
    giving.tick(1.5)
    slot = lent.board.slot("wish")
    assert slot.get() == (1.5, 1.5)
    assert slot.writer == "giving.now.number"


def test_a_task_writes_a_slot_too(both):
    lent, (_, taking) = both
    lent.board.slot("wish").set(7.0, 3.0)
    taking.tick(3.1)
    assert taking.network["kept"].seen == 7.0


def test_a_value_of_another_type_is_left_out_and_reported_once(both, caplog):
    lent, (_, taking) = both
    lent.board.slot("wish").set("far", 3.0, writer="me")
    taking.tick(3.1)
    taking.tick(3.2)
    assert taking.network["kept"].seen is None
    (line,) = caplog.messages
    assert line == "the slot wish holds 'far', written by me - a double is wanted"


def test_a_slot_that_a_network_reads_and_writes_makes_no_circle():
    made = network(
        "counting",
        {"one": Constant(parsed_value="1"), "sum": Addition(), "kept": Kept()},
        ("one.value", "sum.input"),
        ("board.count", "sum.input"),
        ("sum.sum", "board.count"),
        ("board.count", "kept.number"),
    )
    runner = Runner(made, context())
    runner.start()
    seen = []
    for tick in range(4):
        runner.tick(float(tick))
        seen.append(made["kept"].seen)
    runner.stop()
    assert seen == [None, 1.0, 2.0, 3.0]


def test_of_two_links_to_a_slot_the_first_with_a_value_counts():
    made = network(
        "two",
        {"now": Now(), "three": Constant(parsed_value="3")},
        ("now.number", "board.wish"),
        ("three.value", "board.wish"),
    )
    lent = context()
    runner = Runner(made, lent)
    runner.start()
    runner.tick(1.0)
    assert lent.board.slot("wish").value == 1.0
    made["now"].is_on = False
    runner.tick(2.0)
    assert lent.board.slot("wish").value == 3.0
    assert lent.board.slot("wish").writer == "two.three.value"
    runner.stop()


def test_a_behavior_named_board_goes_before_the_board():
    made = network("own", {"board": Now(), "kept": Kept()}, ("board.number", "kept.number"))
    runner = Runner(made, context())
    runner.start()
    runner.tick(4.0)
    runner.stop()
    assert made["kept"].seen == 4.0


def test_ports_are_linked_as_they_are():
    now, kept = Now("now"), Kept("kept")
    made = network("ports", {"now": now, "kept": kept})
    made.connect(now.number, kept.number)
    assert list(map(str, made.links)) == ["now.number -> kept.number"]
    with pytest.raises(HriError, match="belongs to no behavior of the network ports - add"):
        made.connect(Now("other").number, kept.number)


# --- what is refused, or warned of, at load ---


@pytest.mark.parametrize("slot", ["", ".", "a..b", "a b", "-"])
def test_a_slot_has_a_name(slot):
    with pytest.raises(AuthoringError, match=r"is not a slot of the board - write board\.name"):
        network("wrong", {"kept": Kept()}, (f"board.{slot}", "kept.number"))


def test_a_slot_has_one_datatype_in_all_networks(giving):
    reading = network("reading", {"it": Velocities()}, ("board.wish", "it.truth"))
    message = r"board.wish is double \(giving.now.number, -:1:1\), but it.truth is boolean"
    with pytest.raises(AuthoringError, match=message):
        check_together([giving, reading])


def test_a_slot_has_one_datatype_in_one_network(tmp_path):
    path = tmp_path / "one.xml"
    path.write_text("""<BehaviorNetwork>
  <Behavior id="one" type="Hri.Constant"><Parameter name="parsed_value" value="1"/></Behavior>
  <Behavior id="not" type="Hri.Not"/>
  <Behavior id="sum" type="Hri.Addition"/>
  <Link from="sum.sum" to="board.wish"/>
  <Link from="board.wish" to="not.input"/>
</BehaviorNetwork>""")
    with pytest.raises(AuthoringError, match=r"one.xml:6:3: board.wish is double .*one.xml:5:3"):
        load_network(path)


def test_a_slot_of_tasks_has_the_datatype_that_they_use():
    wrong = network("wrong", {"now": Now()}, ("now.number", "board.drive.goal"))
    message = r"board.drive.goal is pose \(here it is where tasks send the base\), but now.number"
    with pytest.raises(AuthoringError, match=message):
        check_together([wrong])


def test_a_slot_of_ones_own_tasks_is_declared(giving):
    try:
        assert declare_slot("wish", "pose", "where my task goes") == "wish"
        with pytest.raises(AuthoringError, match="here it is where my task goes"):
            check_together([giving])
    finally:
        DECLARED.pop("wish", None)


def test_two_meanings_of_a_slot_are_a_warning():
    going = network("going", {"it": Velocities()}, ("it.go", "board.wish"))
    turning = network("turning", {"it": Velocities()}, ("board.wish", "it.turn"))
    check_together([going, turning])
    (warning,) = turning.warnings
    assert "it.turn means Evolution.AngularVelocity" in str(warning)
    assert "going.it.go means Evolution.LinearVelocity" in str(warning)


def test_who_writes_and_reads_is_known(giving, taking):
    table = slot_table([giving, taking])
    assert table == (
        {"wish": ["giving.now.number"]},
        {"wish": ["taking.kept.number"]},
        {"wish": "double"},
    )


def test_a_network_with_slots_is_written_as_it_was_read(tmp_path):
    text = """<?xml version="1.0" encoding="UTF-8"?>
<BehaviorNetwork>
  <Behavior id="sum" type="Hri.Addition"/>
  <Link from="board.a.number" to="sum.input"/>
  <Link from="sum.sum" to="board.total"/>
</BehaviorNetwork>
"""
    path = tmp_path / "net.xml"
    path.write_text(text)
    assert write_network(load_network(path)) == text


@pytest.mark.parametrize("slot", ["stop", "id", "start", "inputs", "compute", "_slots"])
def test_a_slot_may_have_any_name(slot):
    writing = network("writing", {"now": Now()}, ("now.number", f"board.{slot}"))
    reading = network("reading", {"kept": Kept()}, (f"board.{slot}", "kept.number"))
    shared = context()
    runners = [Runner(one, shared) for one in (writing, reading)]
    for runner in runners:
        runner.start()
    for runner in runners:
        runner.tick(1.5)
    assert reading["kept"].seen == 1.5
    for runner in runners:
        runner.stop()
    assert shared.board.slot(slot).value is None
