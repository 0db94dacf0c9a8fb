"""Shows what the base measures, drives 20 cm ahead and back, and shows it again."""

from hri.core import Clock, RealClock
from hri.core.quantities import cm
from hri.hal import Battery, Bumper, DriveSystem, Odometry, RangeSensor, ResourceManager

SPEED, ACCELERATION = 20 * cm, 40 * cm


def report(resources: ResourceManager) -> None:
    """A line for each device."""
    now = resources.clock.now()
    battery, bumper = resources.obtain("battery", Battery), resources.obtain("bumper", Bumper)
    level, voltage = battery.level(now), battery.voltage(now)
    if level is None or voltage is None:
        print("battery      unknown")
    else:
        print(f"battery      {level:.0%}, {voltage:.1f} V")
    print(f"bumper       {'pressed' if bumper.is_pressed(now) else 'free'}")
    for id in resources.ids(RangeSensor):
        print(f"{id:<12} {resources.obtain(id, RangeSensor).read(now).distance / cm:.0f} cm")
    print(f"odometry     {resources.obtain('odometry', Odometry).pose(now).x / cm:z.1f} cm ahead")


def main(clock: Clock) -> None:
    """Report before, ahead, and after."""
    with ResourceManager.load("resource-config", clock) as resources:
        drive = resources.obtain("drive", DriveSystem)
        report(resources)
        for distance in (20 * cm, -20 * cm):
            drive.move_delta(distance, SPEED, ACCELERATION).wait()
            report(resources)


if __name__ == "__main__":
    main(RealClock())
