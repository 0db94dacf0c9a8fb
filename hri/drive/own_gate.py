"""A gate and a drive for tasks that drive where no network has them, as in a plain script."""

from __future__ import annotations

import math

from hri.behavior.behavior import Behavior
from hri.behavior.device_behaviors import BumperSwitch, RangeSensorReading
from hri.behavior.drive_command import DriveCommand
from hri.behavior.network import Network
from hri.core.errors import HriError
from hri.drive.behaviors import CommandGate
from hri.drive.mechanics import sensors
from hri.hal.bumper import Bumper
from hri.hal.drive import DriveSystem
from hri.hal.range_sensor import RangeSensor
from hri.task.context import TaskContext

INTERVAL = 0.02
"""Seconds between two ticks of the network."""
AHEAD = math.radians(10)
"""A range sensor that looks to the side by more does not say what is ahead."""


def see_to_gate(context: TaskContext) -> CommandGate:
    """The gate that runs, or a new one with a drive, bumpers, and the sensors that look ahead.

    A new one runs on for the tasks to come. Raises HriError without a drive, and where a network
    steers it that has no gate.
    """
    if (gate := context.find_behavior(CommandGate)) is not None:
        return gate
    if context.find_behavior(DriveCommand) is not None:
        what = "the network that steers the drive takes no commands of tasks"
        raise HriError(f"{what} - put an Hri.CommandGate before its Hri.DriveSystem")
    drives = context.resources.ids(DriveSystem)
    if not drives:
        raise HriError("no drive in the configuration - add one")
    gate = CommandGate("gate")
    context.networks.start(_network(context, gate, drives[0]))
    return gate


def _network(context: TaskContext, gate: CommandGate, drive_id: str) -> Network:
    resources = context.resources
    drive = DriveCommand("drive", drive_id=drive_id)
    readers: list[Behavior] = []
    for id in sensors(resources, RangeSensor):
        if abs(resources.pose_of(id).yaw) <= AHEAD:
            sensor = RangeSensorReading(f"range_{len(readers)}", sensor_id=id)
            gate.range.sources.append(sensor.reading)
            readers.append(sensor)
    for id in resources.ids(Bumper):
        bumper = BumperSwitch(f"bumper_{len(readers)}", bumper_id=id)
        gate.bump.sources.append(bumper.is_pressed)
        readers.append(bumper)
    drive.velocity.sources.append(gate.velocity)
    return Network("own gate", INTERVAL, behaviors=[*readers, gate, drive])
