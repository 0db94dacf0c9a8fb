"""`test_drive_system`: drive short distances, and measure whether the base follows its commands."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from functools import partial

from hri.cli import diagnostics
from hri.core.clock import Clock
from hri.core.errors import HriError
from hri.core.geometry import seen_from
from hri.core.quoting import report
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.resource_manager import ResourceManager

HELP = """\
Usage: test_drive_system [OPTIONS] [<drive_id>]

Drives forward and backward for a second, forward and backward by 10 cm, and turns left, right and
left again, so that the robot ends where it began; the odometry measures each step.

IMPORTANT: keep 4 feet (1.2 m) clear all around the robot. This test ignores all sensors: it drives
into anything in its way. Ctrl-C stops it.

OPTIONS:
  --config <FILE>  The devices (default = resource-config).
  --fast           Fake time, as fast as the machine can: for simulated bases.

Exit status: 0, or 1 when a step failed, or 2 when an option or a file is wrong.
"""

SPEED, ACCELERATION = 0.2, 0.4
"""m/s and m/s²."""
TURN_SPEED, TURN_ACCELERATION = math.radians(45), math.radians(90)
"""rad/s and rad/s²."""
NEAR, NEAR_ANGLE = 0.01, math.radians(3)
"""Tolerance of a step, meters and radians."""
SHARE = 0.25
"""Relative tolerance of a velocity, or of the distance in a second."""
STANDING = 0.01
"""Below these, in m/s and rad/s, the base counts as standing still."""
PATIENCE = 15.0
"""Seconds after which a step that does not end has failed."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the test. Exit status 0, 1 when a step failed, 2 when an option or file is wrong."""
    parser = diagnostics.parser("test_drive_system", HELP)
    parser.add_argument("drive_id", nargs="?")
    return diagnostics.run(parser, HELP, _test, arguments)


def _test(options: argparse.Namespace) -> int:
    with diagnostics.resources_of(options) as resources:
        ids = [options.drive_id] if options.drive_id else resources.ids(DriveSystem)[:1]
        if not ids:
            raise HriError(f"{options.config}: no drive system in it - add one, or name another")
        drives, _ = diagnostics.obtained(resources, ids, DriveSystem)
        if not drives:
            return 1
        print("*** test_drive_system ***")
        report(f"Obtained drive system: {ids[0]}", flush=True)
        steps = Steps(drives[0], _odometry(resources), resources.clock)
        failures = sum(not _passes(name, step) for name, step in steps.table())
    return 1 if failures else 0


def _odometry(resources: ResourceManager) -> Odometry:
    odometry = resources.find(Odometry)
    if odometry is None:
        raise HriError("no odometry in the configuration - add one that measures the drive")
    return odometry


def _passes(name: str, step: Callable[[], None]) -> bool:
    """Run one step and print its result."""
    print(f"{name}: ", end="", flush=True)
    try:
        step()
    except (HriError, TimeoutError) as error:
        report(f"FAILED ({error})", flush=True)
        return False
    print("passed", flush=True)
    return True


class Steps:
    """The steps of the test; each raises HriError when the base deviates."""

    def __init__(self, drive: DriveSystem, odometry: Odometry, clock: Clock) -> None:
        self.drive, self.odometry, self.clock = drive, odometry, clock

    def table(self) -> list[tuple[str, Callable[[], None]]]:
        """Names and steps, in their order."""
        return [
            ("Forward 1 second", partial(self.go, SPEED)),
            ("Checking velocities", partial(self.check_velocity, SPEED)),
            ("Forward stop", self.stop),
            ("Moving backward 1 second", partial(self.go, -SPEED)),
            ("Backward stop", self.stop),
            ("Forward 10 cm", partial(self.move, 0.1)),
            ("Backward 10 cm", partial(self.move, -0.1)),
            ("Turning left 90 degrees", partial(self.turn, math.radians(90))),
            ("Turning right 180 degrees", partial(self.turn, math.radians(-180))),
            ("Turning left 90 degrees", partial(self.turn, math.radians(90))),
        ]

    def go(self, speed: float) -> None:
        """A second at a speed, from rest."""
        start = self.odometry.pose(self.clock.now())
        self.drive.move_and_turn(speed, ACCELERATION, 0.0, TURN_ACCELERATION)
        self.clock.advance(1.0)
        end = self.odometry.pose(self.clock.now())
        moved, _ = seen_from(start, end.x, end.y)
        wanted = math.copysign(abs(speed) - speed**2 / (2 * ACCELERATION), speed)
        _compare("moved", moved * 100, wanted * 100, SHARE * abs(wanted) * 100, "cm")

    def check_velocity(self, speed: float) -> None:
        velocity = self.odometry.velocity(self.clock.now())
        _compare("drives at", velocity.linear * 100, speed * 100, SHARE * abs(speed) * 100, "cm/s")
        turning = math.degrees(velocity.angular)
        _compare("turns at", turning, 0.0, math.degrees(SHARE * TURN_SPEED), "degrees/s")

    def stop(self) -> None:
        self.drive.halt().wait(PATIENCE)
        velocity = self.odometry.velocity(self.clock.now())
        _compare("drives at", velocity.linear * 100, 0.0, STANDING * 100, "cm/s")

    def move(self, distance: float) -> None:
        start = self.odometry.pose(self.clock.now())
        self.drive.move_delta(distance, SPEED, ACCELERATION).wait(PATIENCE)
        end = self.odometry.pose(self.clock.now())
        moved, _ = seen_from(start, end.x, end.y)
        _compare("moved", moved * 100, distance * 100, NEAR * 100, "cm")

    def turn(self, angle: float) -> None:
        start = self.odometry.pose(self.clock.now()).heading
        self.drive.turn_delta(angle, TURN_SPEED, TURN_ACCELERATION).wait(PATIENCE)
        # The shortest way around, since odometries differ in counting whole turns.
        off = math.remainder(self.odometry.pose(self.clock.now()).heading - start - angle, math.tau)
        turned, wanted = math.degrees(angle + off), math.degrees(angle)
        _compare("turned", turned, wanted, math.degrees(NEAR_ANGLE), "degrees")


def _compare(what: str, measured: float, wanted: float, tolerance: float, unit: str) -> None:
    if not abs(measured - wanted) <= tolerance:
        raise HriError(
            f"it {what} {measured:.1f} {unit}, not {wanted:.1f} - check motors, wheels and power"
        )


if __name__ == "__main__":
    sys.exit(main())
