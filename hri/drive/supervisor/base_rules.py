"""What is particular to one base, for its supervisor."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from hri.core.signals import Pose2D, Twist
from hri.drive.bases.protocol import BaseProtocol, Sensors
from hri.drive.supervisor.free_space import Body
from hri.drive.velocity_limits import BaseLimits


@dataclass(frozen=True, slots=True)
class Rules:
    """What is particular to one base."""

    fastest: Twist
    """What the hardware can do, m/s and rad/s."""
    sensors: Sensors = field(default_factory=Sensors)
    """What it promises to report."""
    period: float = 0.015
    """Seconds between its reports."""
    limits: BaseLimits = field(default_factory=BaseLimits)
    body: Body = field(default_factory=Body)
    mounts: Mapping[str, Pose2D] = field(default_factory=dict)
    """Where its range sensors are in the robot's frame, by the names in reports."""


def rules(
    protocol: BaseProtocol, limits: BaseLimits, body: Body, mounts: Mapping[str, Pose2D]
) -> Rules:
    """The rules for a base that speaks this protocol."""
    return Rules(protocol.limits, protocol.sensors, protocol.period, limits, body, mounts)
