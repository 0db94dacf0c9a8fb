import pytest

from hri.behavior.network import Network
from hri.core.errors import HriError
from hri.hal.pending import Interrupted
from hri.task.context import TaskFailed
from hri.task.parallel import Parallel
from hri.task.primitive import Primitive, primitive
from hri.task.task_run import TaskStatus
from hri.task.util import Wait
from tests.task.stage import Stage

pytestmark = pytest.mark.proves("P09", "T20", "T21", "T24")

NETWORK = """
<BehaviorNetwork invocation_interval="0.1">
  <Behavior id="one" type="Hri.Constant"><Parameter name="parsed_value" value="1"/></Behavior>
  <Behavior id="sum" type="Hri.Addition"/>
  <Link from="one.value" to="sum.input"/>
</BehaviorNetwork>
"""


@pytest.fixture(autouse=True)
def _network(tmp_path, monkeypatch):
    path = tmp_path / "primitive" / "Test" / "Adder.xml"
    path.parent.mkdir(parents=True)
    path.write_text(NETWORK)
    monkeypatch.setenv("EVOLUTION_CONFIG_PATH", f"/nowhere:{tmp_path}")


log = []


@primitive("Test.Adder")
class Adder(Primitive):
    """Feeds a sum until it reaches a limit."""

    def __init__(self, context, limit: float = 3.0):
        super().__init__(context)
        self.limit = limit

    def start(self):
        log.append("start")
        self.on_value("sum", "sum", self.look)
        self.inject("sum", "input", 0.5)

    def compute(self):
        log.append("compute")

    def look(self, total, now):
        log.append((total, round(now, 3)))
        if total >= self.limit:
            self.set_status(TaskStatus.SUCCESS, total)
        elif self.limit == 13:
            self.set_status(TaskStatus.FAILURE, "bad luck")
        else:
            self.inject("sum", "input", total)

    def finish(self):
        log.append("finish")


@pytest.fixture(autouse=True)
def _fresh_log():
    log.clear()


def test_a_network_that_is_a_task():
    stage = Stage()
    assert stage.run(Adder) == 3.5
    assert log == [
        "start", "compute", (1.5, 0.0), "compute", (2.5, 0.1), "compute", (3.5, 0.2), "finish",
    ]  # fmt: skip
    assert stage.context.networks.runners == {}


def test_arguments_parallel_and_cancellation():
    async def main(context):
        race = Parallel(context)
        endless, short = race.add_task(Adder, [1e9]), race.add_task(Wait, [350])
        other = race.add_task(Adder, [1e9])
        assert await race.wait_for_first_task() is short
        assert endless.status is other.status is TaskStatus.CANCELLED
        assert context.networks.runners == {}

    Stage().run(main)
    assert log.count("start") == log.count("finish") == 2


def test_it_may_say_that_it_has_failed():
    stage = Stage()
    with pytest.raises(TaskFailed, match="bad luck"):
        stage.run(Adder, 13)
    assert log[-1] == "finish"


def test_an_exception_in_its_code_fails_it():
    @primitive("Test.Adder")
    class Broken(Primitive):
        """Breaks."""

        def compute(self):
            raise ZeroDivisionError("broken")

    async def main(context):
        running = context.manager.install(Broken)
        await running.wait()
        assert isinstance(running.error, ZeroDivisionError)

    Stage().run(main)


def test_mistakes():
    @primitive("Test.Missing")
    class Missing(Primitive):
        """Has no network."""

    @primitive("Test.Adder")
    class Wrong(Primitive):
        """Looks at what is not there."""

        def start(self):
            self.on_value("sum", "summ", print)

    with pytest.raises(
        HriError, match=r'no "primitive/Test/Missing.xml".*looked in /nowhere/config, /nowhere, '
    ):
        Stage().run(Missing)
    with pytest.raises(HriError, match='no output "summ" - did you mean "sum"'):
        Stage().run(Wrong)
    with pytest.raises(HriError, match="many"):
        Stage().run(Adder, 1, 2)
    with pytest.raises(ValueError, match="SUCCESS or FAILURE"):
        Primitive(Stage().context).set_status(TaskStatus.RUNNING)


@pytest.mark.parametrize("how", ["stop", "swap"])
def test_it_ends_when_somebody_else_ends_its_network(how):
    async def main(context):
        running = context.manager.install(Adder, 1e9)
        await context.clock.sleep(1.0)
        if how == "stop":
            context.networks.stop("Test.Adder")
        else:
            context.networks.swap("Test.Adder", Network("Test.Adder", 0.1, []))
        await context.clock.sleep(1.0)
        assert running.status is TaskStatus.CANCELLED
        assert isinstance(running.error, Interrupted)
        assert len(context.networks.runners) == (how == "swap")

    stage = Stage()
    stage.run(main)
    assert log.count("finish") == 1
    assert "task.failed" not in stage.names()


def test_a_task_whose_network_is_gone_can_be_cancelled():
    async def main(context):
        running = context.manager.install(Adder, 1e9)
        await context.clock.sleep(1.0)
        context.networks.stop("Test.Adder")
        running.cancel()
        await running.wait()
        assert running.status is TaskStatus.CANCELLED

    Stage().run(main)
    assert log[-1] == "finish"
