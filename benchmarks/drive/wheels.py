"""Odometry against closed form: arcs whose end is known, by the counts of a Create 2's encoders."""

from __future__ import annotations

import math
from collections.abc import Iterator

from hri.bench.table import Row, amount, at_most
from hri.core.signals import Pose2D
from hri.drive.bases.odometer import Encoders, Odometer
from hri.drive.odometry import Estimate, Wheels, rolled_on
from hri.hal.motion import Way
from hri.hal.wheels import WheelPair

ENCODERS = Encoders(math.pi * 0.072 / 508.8, track=0.235, bits=16, fastest=0.5)
"""Those of the Create 2's Open Interface: counts of a turn, wheels of 72 mm."""
ARCS = ((5.0, 0.6), (5.0, -0.9), (4.0, 1.5), (6.0, -0.25))
"""Meters, and the curvature, 1/m: 20 m in all."""
SPEED = 0.3
PERIOD = 0.015
"""Seconds between two reports."""
MOST = 0.01
"""Part of the way by which the end may be off."""


def rows() -> Iterator[Row]:
    """How far the odometry is off at the end of 20 m of arcs."""
    total = sum(way for way, _ in ARCS)
    truth, estimate = _driven()
    off = math.dist((truth.x, truth.y), (estimate.pose.x, estimate.pose.y))
    turned = abs(math.remainder(truth.heading - estimate.pose.heading, math.tau))
    yield amount(
        f"odometry against closed form, {total:g} m of arcs",
        off / total,
        "of the way",
        at_most(MOST),
        off_m=round(off, 4),
        off_rad=round(turned, 5),
        deviation_told_m=round(estimate.position_deviation, 3),
    )


def end_of(start: Pose2D, way: float, curvature: float) -> Pose2D:
    """Where an arc ends, in closed form."""
    turn, radius = way * curvature, 1 / curvature
    x = start.x + radius * (math.sin(start.heading + turn) - math.sin(start.heading))
    y = start.y - radius * (math.cos(start.heading + turn) - math.cos(start.heading))
    return Pose2D(x, y, start.heading + turn)


def _driven() -> tuple[Pose2D, Estimate]:
    """The true end, and what counts that are cut to whole ones make of it."""
    half = ENCODERS.track / 2
    wheels, odometer = WheelPair(half, -half), Odometer(ENCODERS)
    estimate, before = Estimate(), Way()
    truth, ways, now = Pose2D(), [0.0, 0.0], 0.0
    size = 1 << ENCODERS.bits
    for length, curvature in ARCS:
        steps = round(length / SPEED / PERIOD)
        rolling = wheels.rolling(length / steps, length / steps * curvature)
        for _ in range(steps):
            now += PERIOD
            ways = [way + step for way, step in zip(ways, rolling, strict=True)]
            left, right = (math.floor(way / ENCODERS.meters_per_count) % size for way in ways)
            odometer.add(left, right, now)
            after = odometer.rolled
            step = after.linear - before.linear, after.angular - before.angular
            estimate, before = rolled_on(estimate, *step, Wheels(ENCODERS.track)), after
        truth = end_of(truth, length, curvature)
    return truth, estimate
