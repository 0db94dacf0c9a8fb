"""What a configuration says of a robot's body: how much room it sweeps, and where its beams start.

All that steers around obstacles reads only this, so the same code drives every robot.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from hri.core.signals import Pose2D
from hri.hal.resource import Resource, Resources
from hri.hal.shape import Shape

UNKNOWN_RADIUS = 0.25
"""Meters, of a robot whose configuration has no dimensions."""
STEEPEST = math.pi / 4
"""Radians; a sensor that looks up or down by more sees the floor or the ceiling."""


@dataclass(frozen=True, slots=True)
class Mechanics:
    """A robot as obstacle avoidance knows it."""

    radius: float = UNKNOWN_RADIUS
    """Meters that turning on the spot sweeps around the middle of the axle."""
    mounts: Mapping[str, Pose2D] = field(default_factory=dict)
    """Where each beam starts and looks, by the id of its sensor, in the robot's frame."""


def mechanics_of(resources: Resources, sensors: Iterable[str]) -> Mechanics:
    """The mechanics that a configuration describes. Raises AuthoringError for a wrong pose."""
    poses = {id: resources.pose_of(id) for id in sensors}
    mounts = {
        id: Pose2D(pose.x, pose.y, pose.yaw)
        for id, pose in poses.items()
        if abs(pose.pitch) <= STEEPEST
    }
    return Mechanics(swept_radius(resources.dimensions), mounts)


def swept_radius(box: Shape) -> float:
    """How far the farthest corner of a box lies from the middle of the axle, meters."""
    if box.lx <= 0 or box.ly <= 0:
        return UNKNOWN_RADIUS
    cos, sin = math.cos(box.yaw), math.sin(box.yaw)
    corners = [(u * box.lx / 2, v * box.ly / 2) for u in (-1, 1) for v in (-1, 1)]
    return max(math.hypot(box.x + cos * u - sin * v, box.y + sin * u + cos * v) for u, v in corners)


def sensors(resources: Resources, kind: type[Resource]) -> list[str]:
    """Ids of the sensors of a kind; a stand-in is reached through what it stands for."""
    stand_ins = {description.text("stand_in") for description in resources.descriptions.values()}
    return [id for id in resources.ids(kind) if id not in stand_ins]
