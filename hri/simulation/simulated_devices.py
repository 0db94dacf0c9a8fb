"""The simulated devices: what a driver would measure, taken from the simulated world."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import ClassVar

import numpy as np

from hri.core.clock import Worker
from hri.core.geometry import placed, wrapped
from hri.core.signals import Frame, Pose2D, RangeReading, Samples, Twist
from hri.hal.battery import Battery
from hri.hal.bumper import Bumper
from hri.hal.button import Button
from hri.hal.camera import Camera
from hri.hal.cliff_sensor import CliffSensor
from hri.hal.drive import Odometry
from hri.hal.drivers.memory import SilentSpeaker
from hri.hal.microphone import Microphone
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource import Description
from hri.simulation import things
from hri.simulation.acoustics import RATE, Source
from hri.simulation.in_world import InWorld
from hri.simulation.people.actors import Appearance, Drawable, Optics, render_before
from hri.simulation.people.backdrop import room_toward
from hri.simulation.people.lens import Lens
from hri.simulation.people.person import SimulatedPerson

CAMERA = {
    "width": (320.0, 64.0, 1920.0),
    "height": (240.0, 48.0, 1080.0),
    "rate": (30.0, 1.0, 120.0),
    "field_of_view": (0.6, 0.2, 2.5),
}
"""Default, least and most of the camera's parameters: pixels, pictures a second, radians.

The lens is narrow: the face of someone 1.3 m away must fill a good part of the picture.
"""
LENS = {
    "noise": (2.0, 0.0, 50.0),
    "light": (1.0, 0.02, 3.0),
    "flicker": (0.0, 0.0, 1.0),
    "blur": (0.0, 0.0, 10.0),
    "jitter": (0.0, 0.0, 10.0),
}
"""The same of its faults; see `lens.Lens`."""
MAX_RANGE = (0.8, 0.1, 30.0)
"""Default, least and most of a range sensor's reach, meters; infrared ones see 80 cm."""
RANGE_NOISE = (0.01, 0.0, 0.5)
"""Default, least and most of its noise: standard deviation as a part of the distance."""
COUNTS_AT_1_CM = 7000.0
"""An infrared sensor counts the reflected light: this much at 1 cm, falling with the distance,
about as the one of 2003 did; up to MOST_COUNTS."""
MOST_COUNTS = 1023
VOLTAGES = (10.5, 12.4)
"""Of an empty and of a full battery by default."""
SPEAKER_LEVEL = (-12.0, -60.0, 0.0)
"""Default, least and most of how loud a speaker is at the microphone, dB."""
SPEAKER_DELAY = (0.01, 0.0, 0.15)
"""Default, least and most of the seconds until it is heard there."""
HEADING_DIGITS = 4
"""Of radians: less does not move a picture by a tenth of a pixel."""
NOISES = 4099
"""How many errors a range sensor makes before they repeat."""


class SimulatedMicrophone(InWorld, Microphone):
    """Hears the person and the noise of the room."""

    rate = RATE

    def _open(self) -> None:
        super()._open()
        self._next = math.floor(self.manager.clock.now() * RATE)

    def read(self, now: float) -> Samples:
        first, self._next = self._next, max(self._next, math.floor(now * RATE))
        return self.world.sound.between(first, self._next)


class SimulatedSpeaker(InWorld, SilentSpeaker):
    """Plays into the room, so that the simulated microphone hears it.

    `level` is how loud that is at the microphone, in dB against the sound played; `delay` is the
    seconds until it is there.
    """

    parameters: ClassVar[tuple[str, ...]] = ("level", "delay")

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        description.number_within("level", *SPEAKER_LEVEL)
        description.number_within("delay", *SPEAKER_DELAY)

    def _open(self) -> None:
        super()._open()
        self._gain = 10 ** (self.description.number_within("level", *SPEAKER_LEVEL) / 20)
        self._delay = self.description.number_within("delay", *SPEAKER_DELAY)
        self._sources: list[Source] = []

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self.stop(now)
        super().play(samples, rate, now)
        self._sources = [self._sound(samples, now)]

    def extend(self, samples: Samples, now: float) -> None:
        end = self._end
        super().extend(samples, now)
        if end is not None:
            self._sources.append(self._sound(samples, max(end, now)))

    def stop(self, now: float) -> None:
        super().stop(now)
        for source in self._sources:
            self.world.sound.cut(source, now + self._delay)
        self._sources = []

    @property
    def _end(self) -> float | None:
        """When what it plays will have been played."""
        return None if self._begun is None else self._begun + self._duration

    def _sound(self, samples: Samples, at: float) -> Source:
        return self.world.sound.add(samples, self._rate, at + self._delay, self._gain)


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


class SimulatedButton(InWorld, Button):
    """A button that the visitor, a script or a test presses."""

    def is_pressed(self, now: float) -> bool:
        return self.world.is_button_pressed(self.id, now)


class SimulatedBattery(InWorld, Battery):
    """The battery's gauge.

    Its parameters are those of the battery of 2003: it has `max_voltage` when full and
    `voltage_floor` when empty; the others belong to how the hardware measured it.
    """

    parameters: ClassVar[tuple[str, ...]] = (
        "address",
        "max_voltage",
        "voltage_floor",
        "voltage_multiplier",
        "voltage_output_eps",
    )

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        empty, full = _voltages(description)
        if not 0 <= empty < full:
            what = f"max_voltage is {full:g}, voltage_floor is {empty:g}"
            raise description.error("max_voltage", what, "a full battery has the higher voltage")
        for name in ("voltage_multiplier", "voltage_output_eps"):
            description.number(name, 0.0)

    def level(self, now: float) -> float:
        return self.world.battery_level(now)

    def voltage(self, now: float) -> float:
        empty, full = _voltages(self.description)
        return empty + (full - empty) * self.level(now)


def _voltages(description: Description) -> tuple[float, float]:
    """Empty and full, volts."""
    empty = description.number("voltage_floor", VOLTAGES[0])
    return empty, description.number("max_voltage", VOLTAGES[1])


class SimulatedCliffSensor(InWorld, CliffSensor):
    """Looks down from where it sits on the base; parameters x and y in cm."""

    parameters: ClassVar[tuple[str, ...]] = ("address",)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        _ = description.pose

    def _open(self) -> None:
        super()._open()
        self._mount = self.manager.pose_of(self.id)

    def is_cliff(self, now: float) -> bool:
        self.world.advance(now)
        return self.world.is_drop(*placed(self.world.base.pose, self._mount.x, self._mount.y))


class SimulatedRangeSensor(InWorld, RangeSensor):
    """One beam from where the sensor sits on the base; parameters x and y in cm, yaw in radians."""

    parameters: ClassVar[tuple[str, ...]] = ("max_range", "noise", "address")

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        description.number_within("max_range", *MAX_RANGE)
        description.number_within("noise", *RANGE_NOISE)
        _ = description.pose

    def _open(self) -> None:
        super()._open()
        pose = self.manager.pose_of(self.id)
        self._beam = self.world.beams.mount(Pose2D(pose.x, pose.y, pose.yaw))
        self._max_range = self.description.number_within("max_range", *MAX_RANGE)
        generator = np.random.default_rng(self.world.seed_for(self.id))
        noise = self.description.number_within("noise", *RANGE_NOISE)
        self._errors = generator.normal(0.0, noise, NOISES)

    def read(self, now: float) -> RangeReading:
        distance = self.world.beam_length(self._beam, now) * (1 + self._error(now))
        if distance > self._max_range:
            return RangeReading(self.id, math.inf, now, 0)
        raw = min(MOST_COUNTS, round(COUNTS_AT_1_CM / max(1.0, distance * 100)))
        return RangeReading(self.id, distance, now, raw)

    def _error(self, now: float) -> float:
        """The noise of a reading: another one each millisecond, the same for the same time."""
        return float(self._errors[round(now * 1000) % len(self._errors)])


class SimulatedCamera(InWorld, Camera):
    """Looks at the first person's face, from a neck that follows the place where they stand, or
    ahead when `look_ahead` asks for that.

    `hres` and `vres` are the size of the picture in the files of 2003; `width` and `height` win.
    The others of `CAMERA` and `LENS` are the camera and its faults.
    """

    parameters: ClassVar[tuple[str, ...]] = (*Camera.parameters, *CAMERA, "hres", "vres", *LENS)

    @classmethod
    def check(cls, description: Description) -> None:
        super().check(description)
        _parameters(description)
        _faults(description)

    def _open(self) -> None:
        super()._open()
        width, height, self._rate, self.field_of_view = _parameters(self.description)
        self.width, self.height = round(width), round(height)
        self._optics = Optics(self.width, self.height, self.field_of_view)
        self._lens = Lens(**_faults(self.description), seed=self.world.seed_for(self.id))
        self._given = math.floor(self.manager.clock.now() * self._rate) - 1
        self._is_ahead = False
        # Drawing takes many milliseconds, which the loop does not have. In fake time a picture is
        # there at once, as if a camera had taken it.
        self._worker: Worker[Frame] = self.manager.clock.worker(0.0)

    def _close(self) -> None:
        self._worker.close()
        super()._close()

    def look_ahead(self, is_ahead: bool) -> None:
        self._is_ahead = is_ahead

    def pan(self, now: float) -> float:
        if self._is_ahead or not self.world.people:
            return 0.0
        return self.world.bearing_of(self.world.person, now)

    def _read(self, now: float) -> Frame | None:
        drawn = self._worker.poll()
        sequence = math.floor(now * self._rate + 1e-6)
        if sequence > self._given and not self._worker.is_busy:
            self._given = sequence
            self.world.advance(now)
            self._worker.submit(self._picture(sequence))
            drawn += self._worker.poll()
        return drawn[-1] if drawn else None

    def _picture(self, sequence: int) -> Callable[[], Frame]:
        """What draws a picture of the people and things as they are now."""
        time = sequence / self._rate
        there = (person for person in self.world.people if person.is_present(time))
        shown: list[Drawable] = []
        for person in there:
            if looks := self._appearance(person, time):
                shown.append(looks)
                if hand := person.hand(time):
                    shown.append(self._optics.show_hand(person.actor, hand, looks))
        breadth = self.field_of_view + 2 * things.BEYOND
        looking = self.world.base.pose.heading + self.pan(time)
        for sighting in self.world.seen_items(self.pan(time), breadth, time):
            if (thing := things.appearance(sighting, self._optics, looking)) is not None:
                shown.append(thing)
        optics, lens = self._optics, self._lens
        heading = round(self.world.base.pose.heading + self.pan(time), HEADING_DIGITS)

        def picture() -> Frame:
            backdrop = room_toward(optics.size, optics.field_of_view, heading)
            return Frame(lens.take(render_before(backdrop, shown), sequence), time, sequence)

        return picture

    def _appearance(self, person: SimulatedPerson, time: float) -> Appearance | None:
        """How someone looks in the picture; None for who is beside or behind the camera."""
        held = person.posture(time)
        turn = self.pan(time) - self.world.bearing_of(person, time)
        distance = self.world.distance_to(person, time)
        ahead, right = distance * math.cos(turn), distance * math.sin(turn)
        if ahead <= 0:
            return None
        pose, (x, y) = self.world.base.pose, person.place(time)
        robot = math.atan2(pose.y - y, pose.x - x)
        turned = wrapped(person.facing(time, robot) - robot)
        return self._optics.show(
            person.actor,
            held,
            right + person.aside(time),
            ahead,
            person.lids(time),
            turned,
            person.outfit,
        )


def _parameters(description: Description) -> tuple[float, ...]:
    """The values of CAMERA that a description asks for. Raises AuthoringError."""
    given = description.parameters
    spellings = {"width": "hres", "height": "vres"}
    names = {name: name if name in given else spellings.get(name, name) for name in CAMERA}
    return tuple(description.number_within(names[name], *CAMERA[name]) for name in CAMERA)


def _faults(description: Description) -> dict[str, float]:
    """The values of LENS that it asks for. Raises AuthoringError."""
    return {name: description.number_within(name, *bounds) for name, bounds in LENS.items()}
