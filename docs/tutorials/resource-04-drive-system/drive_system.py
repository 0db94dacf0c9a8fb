"""Drives about with each command of a drive system. Keep a meter free around the robot."""

from hri.core import Clock, RealClock
from hri.core.quantities import cm, degree
from hri.hal import DriveSystem, ResourceManager, Stop

SPEED, ACCELERATION = 20 * cm, 40 * cm
TURN_SPEED, TURN_ACCELERATION = 30 * degree, 60 * degree


def drive_about(drive: DriveSystem, clock: Clock) -> None:
    """Each command once."""
    print("Set the idle power.")
    drive.set_idle_power(60).wait()
    clock.advance(5.0)  # time to try whether a wheel still turns by hand
    print("Set the move power.")
    drive.set_move_power(60).wait()

    print("Move forward half a meter. ", end="", flush=True)
    drive.move_delta(50 * cm, SPEED, ACCELERATION).wait()
    print("ok")
    print("Turn to the left. ", end="", flush=True)
    drive.turn_delta(90 * degree, TURN_SPEED, TURN_ACCELERATION).wait()
    print("ok")

    print("Free turning.")
    drive.move_and_turn(0, ACCELERATION, -TURN_SPEED, TURN_ACCELERATION)
    print("Slight delay.")
    clock.advance(3.0)
    print("Stop smooth.")
    drive.halt(Stop.SMOOTH).wait()

    print("Free moving backward.")
    drive.move_and_turn(-SPEED, ACCELERATION, 0, TURN_ACCELERATION)
    print("Delay for backward move.")
    clock.advance(3.0)
    print("Stop abrupt.")
    drive.halt(Stop.ABRUPT).wait()

    print("Moving and turning to the right at the same time.")
    drive.move_and_turn(SPEED, ACCELERATION, -TURN_SPEED, TURN_ACCELERATION)
    clock.advance(3.0)
    print("Stop using move and turn.")
    drive.move_and_turn(0, ACCELERATION, 0, TURN_ACCELERATION)
    clock.advance(1.0)


def main(clock: Clock) -> None:
    """Drive the robot of the usual configuration."""
    with ResourceManager.load("resource-config", clock) as resources:
        drive_about(resources.obtain("drive", DriveSystem), clock)


if __name__ == "__main__":
    main(RealClock())
