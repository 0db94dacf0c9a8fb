"""The live picture of a base in a window: seen from above, with its sensor readings."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from PIL import Image as Pictures, ImageDraw, ImageFont

from hri.cli.drive.keys import HELP
from hri.cli.drive.text_map import Trail, rows
from hri.cli.drive.view import Snapshot, View
from hri.core.geometry import placed
from hri.core.signals import Image, Pose2D
from hri.drive.bases.protocol import BaseReport
from hri.hal.screen import Screen
from hri.simulation.bases.body import PLACES

PERIOD = 0.1
"""Seconds between two pictures; drawing one takes about 15 ms."""
PIXELS_PER_METER = 180.0
MIDDLE = 0.75
"""Position of the base, as a share of the height; the text is above it."""
TEXT_HEIGHT = 15
MARGIN = 12
PAPER, INK, FAINT, BODY, ALARM, BEAM = (
    (250, 250, 247), (40, 44, 52), (200, 203, 208), (86, 120, 180), (214, 60, 50), (225, 150, 40),
)  # fmt: skip
BUMPER_ANGLES = {"left": (0.1, 1.3), "right": (-1.3, -0.1)}
"""Arcs of the rim, radians to the left."""
KEYS = {"=": "+", "[+]": "+", "[-]": "-", "space": " "}
"""Keys that a window calls by another name."""


class WindowView(View):
    """Draws on a screen, and takes its keys."""

    def __init__(self, screen: Screen, title: str, radius: float) -> None:
        """`radius`: of the base's body, meters."""
        self._screen, self._title, self._radius = screen, title, radius
        self._trail = Trail()
        self._shown_at = -math.inf
        self._font = ImageFont.load_default(TEXT_HEIGHT - 2)

    def read_keys(self) -> Sequence[str]:
        if self._screen.is_closed:
            return ["escape"]
        return [KEYS.get(key, key) for key in self._screen.pressed_keys()]

    def show(self, moment: Snapshot) -> None:
        self._trail.add(moment.pose)
        if moment.time - self._shown_at >= PERIOD:
            self._shown_at = moment.time
            self._screen.show(self._drawn(moment), moment.time)

    def _drawn(self, moment: Snapshot) -> Image:
        sheet = Pictures.new("RGB", (self._screen.width, self._screen.height), PAPER)
        pen = ImageDraw.Draw(sheet)
        self._draw_grid(pen, moment.pose)
        self._draw_base(pen, moment.pose, moment.state.report)
        lines = [self._title, *rows(moment), "", *HELP]
        panel = (0, 0, self._screen.width, 2 * MARGIN + len(lines) * TEXT_HEIGHT)
        pen.rectangle(panel, fill=PAPER, outline=FAINT)
        for number, line in enumerate(lines):
            spot = (MARGIN, MARGIN + number * TEXT_HEIGHT)
            pen.text(spot, line, fill=INK, font=self._font)
        return np.asarray(sheet)

    def _pixel(self, x: float, y: float, pose: Pose2D) -> tuple[float, float]:
        """Pixel of a point in the odometry frame: x to the right, y up."""
        middle = self._screen.width / 2, self._screen.height * MIDDLE
        right, up = (x - pose.x) * PIXELS_PER_METER, (y - pose.y) * PIXELS_PER_METER
        return middle[0] + right, middle[1] - up

    def _draw_grid(self, pen: ImageDraw.ImageDraw, pose: Pose2D) -> None:
        """A grid line for each meter, and the trail of the base."""
        reach = math.ceil(max(self._screen.width, self._screen.height) / PIXELS_PER_METER)
        for step in range(-reach, reach + 1):
            x, _ = self._pixel(math.floor(pose.x) + step, 0.0, pose)
            _, y = self._pixel(0.0, math.floor(pose.y) + step, pose)
            pen.line([(x, 0), (x, self._screen.height)], fill=FAINT)
            pen.line([(0, y), (self._screen.width, y)], fill=FAINT)
        way = [self._pixel(spot.x, spot.y, pose) for spot in (*self._trail.poses, pose)]
        pen.line(way, fill=INK, width=2)

    def _draw_base(self, pen: ImageDraw.ImageDraw, pose: Pose2D, report: BaseReport | None) -> None:
        def at(angle: float, distance: float) -> tuple[float, float]:
            ahead, aside = distance * math.cos(angle), distance * math.sin(angle)
            return self._pixel(*placed(pose, ahead, aside), pose)

        radius = self._radius * PIXELS_PER_METER
        x, y = self._pixel(pose.x, pose.y, pose)
        pen.ellipse([x - radius, y - radius, x + radius, y + radius], fill=BODY, outline=INK)
        pen.line([at(0.0, 0.0), at(0.0, self._radius)], fill=PAPER, width=3)
        if report is None:
            return
        for place, distance in report.ranges.items():
            if place in PLACES and math.isfinite(distance):
                angle = PLACES[place]
                ends = at(angle, self._radius), at(angle, self._radius + distance)
                pen.line(ends, fill=BEAM, width=3)
        for place, is_pressed in report.bumps.items():
            start, end = BUMPER_ANGLES.get(place, (-0.2, 0.2))
            steps = np.linspace(start, end, 9)
            arc = [at(float(angle), self._radius * 1.08) for angle in steps]
            pen.line(arc, fill=ALARM if is_pressed else INK, width=6 if is_pressed else 2)
        for place, is_edge in report.cliffs.items():
            x, y = at(PLACES.get(place, 0.0), self._radius * 0.8)
            pen.ellipse([x - 4, y - 4, x + 4, y + 4], fill=ALARM if is_edge else PAPER)
