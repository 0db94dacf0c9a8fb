"""Wire behaviors into a network, and watch what comes out."""

from hri import Robot
from hri.behavior import Network
from hri.behavior.device_behaviors import RangeSensorReading
from hri.behavior.library.timing import Threshold
from hri.core import FakeClock
from hri.task import TaskContext

sensor, far = RangeSensorReading("sensor", sensor_id="range_front"), Threshold("far", upper=100)
network = Network("nearness", behaviors=[sensor, far])
network.connect(sensor.distance, far.input)  # centimeters


async def watch(context: TaskContext) -> None:
    """Print each value for two seconds."""
    context.networks.start(network)
    context.networks.watch("nearness", "far", "is_high", print)
    await context.clock.sleep(2)


with Robot(config="simulated", clock=FakeClock()) as robot:
    robot.visitor.go(0.7, 0.0)
    robot.run(watch)
