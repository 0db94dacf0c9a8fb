"""The live picture of a base in a terminal: its pose, its sensors, and why it is stopped."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from hri.cli.drive.view import Snapshot
from hri.core.signals import Pose2D, Twist
from hri.drive.bases.protocol import BaseReport
from hri.drive.supervisor.link import State

COLUMNS, ROWS = 61, 15
"""Largest size of the map; odd, so that the base is in its middle."""
SCALE = 0.1
"""Meters per column; a row is twice that, as letters are twice as high as wide."""
ARROWS = "→↗↑↖←↙↓↘"
"""The base, by eighths of a turn to the left from east."""
TRAIL = 2000
"""Poses that are kept."""


class Trail:
    """The newest TRAIL poses of a base."""

    def __init__(self) -> None:
        self.poses: list[Pose2D] = []

    def add(self, pose: Pose2D) -> None:
        last = self.poses[-1] if self.poses else None
        if last is None or math.dist((pose.x, pose.y), (last.x, last.y)) > SCALE / 2:
            self.poses.append(pose)
            del self.poses[:-TRAIL]


def rows(moment: Snapshot) -> list[str]:
    """The state of a base, one line for each item."""
    state = moment.state
    return [
        _row("pose", _pose(moment.pose)),
        _row("speed", _speed(state.report)),
        _row("asked", f"{_twist(moment.asked)}   ({moment.share:.0%} of the limit)"),
        _row("told", f"{_twist(state.velocity)}   by {state.level.value}"),
        *_sensors(state.report),
        _row("base", _standing(state)),
        *(_row("fault", words) for words in state.faults),
    ]


class TextMap:
    """Draws lines of text; keeps the trail of the base."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._trail = Trail()

    def lines(self, moment: Snapshot, most: int = 200) -> list[str]:
        """The picture in the given number of lines; the map shrinks to fit."""
        self._trail.add(moment.pose)
        below = rows(moment)
        height = min(ROWS, most - len(below) - len(("title", "edge", "edge")))
        return [self._title, *(self._map(moment.pose, height) if height > 0 else []), *below]

    def _map(self, pose: Pose2D, height: int) -> list[str]:
        """The view from above, north up; east is the heading at power-up."""
        rows = [[" "] * COLUMNS for _ in range(height)]
        for spot in self._trail.poses:
            column = round((spot.x - pose.x) / SCALE) + COLUMNS // 2
            row = height // 2 - round((spot.y - pose.y) / (2 * SCALE))
            if 0 <= column < COLUMNS and 0 <= row < height:
                rows[row][column] = "·"
        rows[height // 2][COLUMNS // 2] = ARROWS[round(pose.heading / (math.pi / 4)) % 8]
        edge = "+" + "-" * COLUMNS + "+"
        return [edge, *(f"|{''.join(row)}|" for row in rows), edge]


def _row(name: str, text: str) -> str:
    return f"{name:<8}{text}"


def _pose(pose: Pose2D) -> str:
    degrees = math.degrees(math.remainder(pose.heading, math.tau))
    return f"x {pose.x:+.2f} m   y {pose.y:+.2f} m   {round(degrees):+d} degrees"


def _twist(twist: Twist) -> str:
    return f"{twist.linear:+.2f} m/s   {round(math.degrees(twist.angular)):+d} degrees/s"


def _speed(report: BaseReport | None) -> str:
    if report is None or report.velocity is None:
        return "not known"
    return _twist(report.velocity)


def _sensors(report: BaseReport | None) -> list[str]:
    if report is None:
        return [_row("sensors", "no report from the base yet")]
    rows = [
        ("bumper", _flags(report.bumps, "PRESSED")),
        ("cliffs", _flags(report.cliffs, "EDGE")),
        ("drops", _flags(report.wheel_drops, "IN THE AIR")),
        ("buttons", _buttons(report.buttons)),
        ("ranges", _ranges(report.ranges)),
        ("battery", _battery(report)),
    ]
    return [_row(name, text) for name, text in rows if text]


def _flags(flags: Mapping[str, bool], word: str) -> str:
    """Each sensor, with the word if it detects something."""
    return "   ".join(
        f"{_name(place)} {word if is_set else '.'}" for place, is_set in flags.items()
    )


def _buttons(buttons: Mapping[str, bool]) -> str:
    """The pressed buttons only; most bases have many."""
    pressed = "   ".join(f"{_name(name)} PRESSED" for name, is_held in buttons.items() if is_held)
    return pressed or ("." if buttons else "")


def _ranges(ranges: Mapping[str, float]) -> str:
    return "   ".join(
        f"{_name(place)} {'-' if math.isinf(way) else f'{way:.2f} m'}"
        for place, way in ranges.items()
    )


def _name(place: str) -> str:
    return place.replace("_", " ")


def _battery(report: BaseReport) -> str:
    parts: Sequence[tuple[bool, str]] = (
        (bool(report.battery_fault), f"unknown: it {report.battery_fault}"),
        (report.battery is not None, f"{report.battery or 0:.0%}"),
        (report.voltage is not None, f"{report.voltage or 0:.1f} V"),
        (report.is_charging, "charging"),
    )
    return "   ".join(text for is_known, text in parts if is_known)


def _standing(state: State) -> str:
    """Why it does not move, or that it is ready."""
    if not state.is_open:
        return state.trouble or "its port is closed"
    if state.is_latched:
        return f"{state.reason.words} - press r to release it"
    mode = state.report.mode if state.report is not None else "silent"
    return f"ready ({mode})"
