"""The box around the body of a robot, as a configuration gives it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Shape:
    """A box on the robot: meters and radians in the robot's frame, (x, y, z) its middle."""

    lx: float = 0.0
    ly: float = 0.0
    lz: float = 0.0
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


NO_SHAPE = Shape()
"""The robot of a configuration without dimensions: a point."""
