"""A base of two motors: the drive of a group of a configuration.

<Group id="drive" type="Hri.Diff2Drive">
  <Member member_id="Drive_left"/> <Member member_id="Drive_right"/>
</Group>
"""

from __future__ import annotations

from collections.abc import Mapping

from hri.core.signals import Twist
from hri.drive.supervisor.in_process_bus import DeviceDrive, DeviceLine, InProcessBus
from hri.drive.velocity_limits import BaseLimits
from hri.hal.drivers.diff2 import TwoMotors


class Diff2Drive(TwoMotors, DeviceDrive):
    """Drives over two motors; both drives of the same motors are drives of one base."""

    base_type = "Hri.Diff2Base"

    def _abilities(self) -> Mapping[str, float]:
        half = self.wheels.track / 2
        fastest = min(motor.max_velocity for motor in self.motors)
        strongest = min(motor.max_acceleration for motor in self.motors)
        usual = BaseLimits()
        return {
            "linear": fastest,
            "angular": fastest / half,
            "track": self.wheels.track,
            "acceleration": min(usual.acceleration, strongest),
            "deceleration": min(usual.deceleration, strongest),
            "angular_acceleration": min(usual.angular_acceleration, strongest / half),
            "angular_deceleration": min(usual.angular_deceleration, strongest / half),
        }

    def _base_id(self) -> str:
        return "+".join(sorted(self.description.members)) + "_base"


class Diff2Base(InProcessBus):
    """The base of two motors, whose ids it has, in order, with "_base" behind them."""

    line = "Hri.Diff2Wheels"


class Diff2Wheels(TwoMotors, DeviceLine):
    """Both motors, as the wheels of a base."""

    def roll(self, twist: Twist, now: float) -> None:
        velocities = self.wheels.rolling(twist.linear, twist.angular)
        for motor, velocity in zip(self.motors, velocities, strict=True):
            motor.set_velocity(velocity, now)

    def brake(self, now: float) -> None:
        for motor in self.motors:
            motor.stop(now)

    def velocity(self, now: float) -> Twist:
        return self.wheel_velocity(now)

    def set_power(self, percent: float, now: float) -> None:
        for motor in self.motors:
            motor.set_power(percent, now)
