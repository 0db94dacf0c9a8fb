"""Each layer is usable without those above it."""

import subprocess
import sys

import pytest

from hri.robot import load_app

LAYERS = {
    "hri.core.event_bus": ("hri.hal", "hri.behavior", "hri.task", "hri.robot", "hri.net"),
    "hri.hal.resource_manager": ("hri.behavior", "hri.task", "hri.robot", "hri.simulation"),
    "hri.behavior.running": ("hri.task", "hri.robot", "hri.simulation", "hri.speech"),
    "hri.task": ("hri.robot", "hri.simulation", "hri.speech", "hri.drive", "hri.face"),
}


@pytest.mark.proves("P01", "P04")
@pytest.mark.parametrize("layer", LAYERS)
def test_a_layer_brings_in_nothing_from_above(layer):
    script = f"import sys, {layer}\nprint('\\n'.join(sys.modules))"
    ended = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True
    )
    above = [name for name in ended.stdout.split() if name.startswith(LAYERS[layer])]
    assert above == []


@pytest.mark.proves("P02")
def test_the_companion_joins_all_four_components():
    networks = load_app("companion").load_networks()
    modules = {type(b).__module__.split(".")[1] for network in networks for b in network.behaviors}
    assert modules >= {"behavior", "vision", "drive", "speech", "emotion", "face"}


HARDWARE = """
from hri.core.clock import FakeClock
from hri.core.paths import find
from hri.hal.configuration import load_configuration
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.resource_manager import ResourceManager

clock = FakeClock()
manager = ResourceManager(load_configuration(find("config", "simulated")).devices, clock)
manager.obtain("drive", DriveSystem).move_delta(0.2, 0.2, 0.5).wait()
print(round(manager.obtain("odometry", Odometry).pose(clock.now()).x, 2))
"""

BEHAVIORS = """
from hri.behavior.behavior import Context
from hri.behavior.library.constant import Constant
from hri.behavior.network import Network
from hri.behavior.runner import Runner
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.hal.resource_manager import ResourceManager

clock = FakeClock()
lent = Context(clock, EventBus(clock), ResourceManager((), clock))
runner = Runner(Network("n", 0.1, [Constant("c", parsed_value="0.2")]), lent)
runner.start()
runner.watch("c", "value", lambda value, now: print(value))
runner.tick(0.0)
"""

TASKS = """
from hri.core.clock import FakeClock
from hri.task import get_task_manager, use, util

use("simulated", FakeClock())
util.Wait(200)
print(get_task_manager().clock.now())
"""


@pytest.mark.proves("P01")
@pytest.mark.parametrize("script", [HARDWARE, BEHAVIORS, TASKS], ids=["HAL", "BEL", "TEL"])
def test_a_layer_does_its_work_alone(script):
    ended = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=60
    )
    assert (ended.stdout, ended.stderr) == ("0.2\n", "")
