"""`test_range_sensor`: print what the range sensors measure."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from hri.cli import diagnostics
from hri.cli.terminal.messages import Within
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.signals import RangeReading
from hri.hal.range_sensor import RangeSensor

HELP = """\
Usage: test_range_sensor [OPTIONS] [<sensor1_id> [..<sensorN_id>]]

Prints the readings of the named sensors, or of all: the distance in centimeters (1.798e+308 when
nothing is in range), the raw value of the sensor, and the time in seconds. Hold a hand in front of
a sensor to identify it. Facing the robot, ids ending in n look ahead, e to your left and w to your
right.

OPTIONS:
  --read-count <COUNT>     Number of sensor readings to perform (default = 3).
  --pause-time <DURATION>  Duration to pause between readings, in seconds
                           (default = 0.1 = 100ms).
  --config <FILE>          The devices (default = resource-config).
  --fast                   Fake time, as fast as the machine can.

Exit status: 0, or 1 when a sensor is missing, or 2 when an option or a file is wrong.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the sensors. Exit status 0, 1 when one is missing, 2 when an option or file is wrong."""
    parser = diagnostics.parser("test_range_sensor", HELP)
    parser.add_argument("ids", nargs="*")
    parser.add_argument("--read-count", type=Within(int, 1, 1_000_000), default=3)
    parser.add_argument("--pause-time", type=Within(float, 0, 3600), default=0.1)
    return diagnostics.run(parser, HELP, _test, arguments)


def _test(options: argparse.Namespace) -> int:
    with diagnostics.resources_of(options) as resources:
        ids = sorted(options.ids or resources.ids(RangeSensor))
        if not ids:
            raise HriError(f"{options.config}: no range sensor in it - add one, or name another")
        sensors, missing = diagnostics.obtained(resources, ids, RangeSensor)
        print("*** test_range_sensor ***")
        report(f"Obtained range sensors: {', '.join(sensor.id for sensor in sensors)}")
        if not sensors:
            print("none of them is available - see the lines above", file=sys.stderr)
            return 1
        for count in range(options.read_count):
            if count > 0:
                resources.clock.advance(options.pause_time)
            for sensor in sensors:
                report(told(sensor.id, sensor.read(resources.clock.now())), flush=True)
    return 1 if missing else 0


def told(id: str, reading: RangeReading) -> str:
    """The line of a reading; nothing in range reads as the largest number."""
    centimeters = min(reading.distance * 100, sys.float_info.max)
    raw = 0 if reading.raw is None else reading.raw
    return f"{id}: distance = {centimeters:.4g} raw = {raw} time = {reading.time:.4g}"


if __name__ == "__main__":
    sys.exit(main())
