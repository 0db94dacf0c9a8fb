"""The simulated devices: what a driver would measure, taken from the simulated world.

    <DeviceBus id="world" type="Hri.SimulatedWorld">
      <Device id="simulated_camera" type="Hri.SimulatedCamera"/>
    </DeviceBus>

A device whose bus is no simulated world uses the first one of the configuration.
"""

from __future__ import annotations

import math
import random
from typing import ClassVar

import numpy as np

from hri.core import registry
from hri.core.signals import Frame, Image, Pose2D, RangeReading, Samples, Twist
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.camera import Camera
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.microphone import Microphone
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description, Resource
from hri.simulation.head import render_head
from hri.simulation.sound import RATE
from hri.simulation.world import SimulatedWorld

HEAD_HEIGHT = 0.24
"""Metres from chin to crown, of an adult."""
NEAREST = 0.5
"""Metres; somebody who is nearer leans back."""
FAR_ASIDE = 1000.0
"""Metres; where somebody who is not there is out of any picture."""
CAMERA = {
    "width": (320.0, 64.0, 1920.0),
    "height": (240.0, 48.0, 1080.0),
    "rate": (30.0, 1.0, 120.0),
    "field_of_view": (0.6, 0.2, 2.5),
}
"""Default, least and most of the camera's parameters: pixels, pictures a second, radians.

The lens is narrow: the face of somebody 1.3 m away must fill a good part of the picture.
"""
MAX_RANGE = (0.8, 0.1, 30.0)
"""Default, least and most of a range sensor's reach, metres; infrared ones see 80 cm."""
RANGE_NOISE = (0.01, 0.0, 0.5)
"""Default, least and most of its noise: standard deviation as a part of the distance."""
NOISES = 4099
"""How many errors a range sensor makes before they repeat."""
GRAIN = 2.0
"""Standard deviation of the camera's noise, of 255."""
SHEET_MARGIN = 64
"""Pixels that the sheet of noise is larger than a picture."""


class InWorld(Resource):
    """A device of the simulated world."""

    world: SimulatedWorld

    def _open(self) -> None:
        kinds = {d.id: registry.canonical(d.type) for d in self.manager.descriptions.values()}
        worlds = [id for id, kind in kinds.items() if kind == "Hri.SimulatedWorld"]
        if not worlds:
            what = f"{self.id} needs a simulated world"
            raise self.description.error("type", what, "put it on a bus of type Hri.SimulatedWorld")
        bus = self.description.bus
        self.world = self.manager.obtain(bus if bus in worlds else worlds[0], SimulatedWorld)


class SimulatedMicrophone(InWorld, Microphone):
    """Hears the person and the noise of the room."""

    rate = RATE

    def _open(self) -> None:
        super()._open()
        self._next = math.floor(self.manager.clock.now() * RATE)

    def read(self, now: float) -> Samples:
        first, self._next = self._next, max(self._next, math.floor(now * RATE))
        return self.world.sound.between(first, self._next)


class SimulatedDrive(InWorld, DriveSystem):
    """The base's motors."""

    def _open(self) -> None:
        super()._open()
        limits = self.world.base.limits
        self.max_linear, self.max_angular = limits.linear, limits.angular
        self.max_acceleration = limits.acceleration

    def set_velocity(self, twist: Twist, now: float) -> None:
        self.world.command(twist, now)

    def stop(self, now: float) -> None:
        self.world.brake(now)


class SimulatedOdometry(InWorld, Odometry):
    """The base's wheel encoders; they do not see the wheels slip."""

    parameters: ClassVar[tuple[str, ...]] = ("polling_interval",)

    def pose(self, now: float) -> Pose2D:
        self.world.advance(now)
        return self.world.base.odometry

    def velocity(self, now: float) -> Twist:
        self.world.advance(now)
        return self.world.base.velocity


class SimulatedBumper(InWorld, Bumper):
    """The ring around the base."""

    def is_pressed(self, now: float) -> bool:
        return self.world.is_bumped(now)


class SimulatedBattery(InWorld, Battery):
    """The battery's gauge."""

    parameters: ClassVar[tuple[str, ...]] = (
        "address",
        "max_voltage",
        "voltage_floor",
        "voltage_multiplier",
        "voltage_output_eps",
    )
    """Those of the battery of 2003, which changes nothing here."""

    def level(self, now: float) -> float:
        return self.world.battery_level(now)


class SimulatedRangeSensor(InWorld, RangeSensor):
    """One beam from where the sensor sits on the base; parameters x and y in cm, yaw in radians."""

    parameters: ClassVar[tuple[str, ...]] = ("max_range", "noise", "address", "device_index")

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        _within(description, "max_range", *MAX_RANGE)
        _within(description, "noise", *RANGE_NOISE)
        for name in ("x", "y", "yaw"):
            description.number(name, 0.0)

    def _open(self) -> None:
        super()._open()
        number = self.description.number
        mount = Pose2D(number("x", 0) / 100, number("y", 0) / 100, number("yaw", 0))
        self._beam = self.world.beams.mount(mount)
        self._max_range = number("max_range", MAX_RANGE[0])
        generator = np.random.default_rng(self.world.seed_for(self.id))
        self._errors = generator.normal(0.0, number("noise", RANGE_NOISE[0]), NOISES)

    def read(self, now: float) -> RangeReading:
        distance = self.world.beam_length(self._beam, now) * (1 + self._error(now))
        return RangeReading(self.id, distance if distance <= self._max_range else math.inf, now)

    def _error(self, now: float) -> float:
        """The noise of a reading: another one each millisecond, the same for the same time."""
        return float(self._errors[round(now * 1000) % len(self._errors)])


class SimulatedCamera(InWorld, Camera):
    """Looks at the person's face, from a neck that follows the place where the person stands."""

    parameters: ClassVar[tuple[str, ...]] = ("width", "height", "rate", "field_of_view")

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        for name, limits in CAMERA.items():
            _within(description, name, *limits)

    def _open(self) -> None:
        super()._open()
        values = {name: _within(self.description, name, *CAMERA[name]) for name in CAMERA}
        self.width, self.height = round(values["width"]), round(values["height"])
        self.field_of_view, self._rate = values["field_of_view"], values["rate"]
        self._grain = Grain(self.width, self.height, self.world.seed_for(self.id))
        self._given = math.floor(self.manager.clock.now() * self._rate) - 1

    def read(self, now: float) -> Frame | None:
        sequence = math.floor(now * self._rate + 1e-6)
        if sequence <= self._given:
            return None
        self._given = sequence
        time = sequence / self._rate
        self.world.advance(now)
        return Frame(self._grain.on(self._picture(time), sequence), time, sequence)

    def _picture(self, time: float) -> Image:
        person = self.world.person
        pose = person.head(time)
        aside = person.aside(time) if person.is_present(time) else FAR_ASIDE
        focal = self.width / 2 / math.tan(self.field_of_view / 2)
        pixels_per_metre = focal / max(NEAREST, self.world.distance_to_person())
        return render_head(
            pose.pitch,
            pose.yaw,
            pose.roll,
            center=(self.width / 2 + aside * pixels_per_metre, self.height / 2),
            height=HEAD_HEIGHT * pixels_per_metre,
            size=(self.width, self.height),
            mouth=person.mouth(time),
            lids=person.lids(time),
        )


class Grain:
    """The noise of a camera's sensor, cut for each picture at another place from one big sheet."""

    def __init__(self, width: int, height: int, seed: int) -> None:
        self._size = (height, width)
        self._seed = seed
        shape = (height + SHEET_MARGIN, width + SHEET_MARGIN, 3)
        noise = np.random.default_rng(seed).normal(0.0, GRAIN, shape)
        self._sheet = np.rint(noise).astype(np.int16)

    def on(self, image: Image, sequence: int) -> Image:
        """The picture with the noise of that number in the sequence."""
        down, right = random.Random(f"{self._seed}/{sequence}").choices(range(SHEET_MARGIN), k=2)
        height, width = self._size
        grain = self._sheet[down : down + height, right : right + width]
        grainy: Image = np.clip(image + grain, 0, 255).astype(np.uint8)
        return grainy


def _within(
    description: Description, name: str, default: float, least: float, most: float
) -> float:
    """A parameter that must lie in a range. Raises AuthoringError."""
    value = description.number(name, default)
    if not least <= value <= most:
        what = f"{name} is {value:g}"
        raise description.error(name, what, f"write a number from {least:g} to {most:g}")
    return value
