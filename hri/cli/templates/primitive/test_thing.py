import pytest
from thing import Thing

from hri.core import FakeClock
from hri.simulation.world import SimulatedWorld
from hri.task import get_task_manager, use


@pytest.fixture
def manager():
    use("simulated", FakeClock())
    yield get_task_manager()
    get_task_manager().shutdown()


def test_it_waits_until_the_battery_is_low(manager):
    world = manager.context.resources.obtain("world", SimulatedWorld)
    manager.clock.call_at(5.0, lambda: world.set_battery(0.2, 5.0))
    assert Thing(0.5) == pytest.approx(0.2, abs=0.01)
    assert 5.0 <= manager.clock.now() < 6.0
