import pytest
from thing import thing

from hri.core import FakeClock
from hri.task import get_task_manager, use


@pytest.fixture
def manager():
    use("simulated", FakeClock())
    yield get_task_manager()
    get_task_manager().shutdown()


def test_it_counts_down_a_second_a_number(manager):
    counted = []
    manager.events.subscribe("number.counted", counted.append)
    assert thing(3) == "go"
    assert [event.properties["number"] for event in counted] == [3, 2, 1]
    assert counted[-1].time - counted[0].time == pytest.approx(2.0)
