"""`hri doctor`: tests every device, says what is wrong and how to fix it, and can choose others."""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hri.cli.diagnostics import without_stand_ins
from hri.core import paths
from hri.core.clock import RealClock
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import report
from hri.core.signals import Samples, Twist
from hri.hal.camera import Camera
from hri.hal.choices import load_choices, save_choices
from hri.hal.configuration import load_configuration
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Recognizer
from hri.hal.resource import Description, Resource
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import Synthesizer
from hri.speech.room_noise import room_noise

METER_WIDTH = 30
QUIET_DBFS = -60.0
"""dBFS; a live microphone is louder than this even in a silent room."""
CLIPPED_DBFS = -1.0


@dataclass(frozen=True)
class Diagnosis:
    """Result of one check."""

    is_well: bool
    says: str


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--config", default="resource-config", metavar="FILE", help="the devices (%(default)s)")
    add("--seconds", type=float, default=3.0, metavar="S", help="seconds that the level meter runs")
    add("--choose", action="store_true", help="choose microphone, speaker and camera")


def run(options: argparse.Namespace) -> int:
    """Exit status 0 when all is well, 1 when something is missing."""
    if options.choose:
        return _choose()
    doctor = Doctor(options)
    try:
        return doctor.examine()
    finally:
        doctor.resources.close()


class Doctor:
    """Tries the devices one after the other, without their stand-ins."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.seconds = options.seconds
        configuration = load_configuration(paths.find("config", options.config))
        self.clock = RealClock()
        self.resources = ResourceManager(without_stand_ins(configuration).devices, self.clock)

    def examine(self) -> int:
        """Run all checks; each prints a line. Raises AuthoringError for a wrong configuration."""
        self.resources.check()
        checks: dict[str, Callable[[], Diagnosis]] = {
            "microphone": self._microphone,
            "speaker": self._speaker,
            "camera": self._camera,
            "screen": self._screen,
            "base": self._base,
            "voice": self._voice,
            "recognizer": self._recognizer,
            "faces": self._faces,
        }
        failures = 0
        for name, check in checks.items():
            try:
                finding = check()
            except NotAvailable as error:
                finding = Diagnosis(False, str(error).removeprefix(f"{name}: "))
            mark = "ok     " if finding.is_well else "MISSING"
            report(f"{name:<11} {mark}  {finding.says}", flush=True)
            failures += not finding.is_well
        if failures:
            print(f"\n{failures} missing: the companion still runs, with stand-ins.")
        return 1 if failures else 0

    def _microphone(self) -> Diagnosis:
        microphone = self.resources.obtain("microphone", Microphone)
        ear = microphone.listen()
        loudest = -120.0
        heard: list[Samples] = []
        end = self.clock.now() + self.seconds
        while self.clock.now() < end:
            time.sleep(0.1)  # noqa: TID251 - a person watches the meter
            samples = ear.read(self.clock.now())
            heard.append(samples)
            level = _dbfs(samples)
            loudest = max(loudest, level)
            if sys.stdout.isatty():
                print(f"\r{_meter(level)}", end="", flush=True)
        if sys.stdout.isatty():
            print("\r" + " " * (METER_WIDTH + 20) + "\r", end="")
        if loudest < QUIET_DBFS:
            return Diagnosis(
                False, f"silent ({loudest:.0f} dBFS) - unmute it, or run with --choose"
            )
        if loudest > CLIPPED_DBFS:
            return Diagnosis(False, "clipping - lower its level in the sound settings")
        noise = room_noise(np.concatenate(heard), ear.rate)
        says = f"{microphone.describe()}, loudest {loudest:.0f} dBFS"
        if noise.advice:
            above = f"a voice of usual loudness is {noise.clearance:.0f} dB above it"
            says += f", noise {noise.level:.0f} dBFS ({noise.kind}; {above}) - {noise.advice}"
        return Diagnosis(True, says)

    def _speaker(self) -> Diagnosis:
        speaker = self.resources.obtain("speaker", Speaker)
        times = np.arange(11025) / 22050
        tone = (8000 * np.sin(2 * np.pi * 660 * times) * np.hanning(len(times))).astype(np.int16)
        speaker.play(tone, 22050, self.clock.now())
        deadline = self.clock.now() + 2.0
        while speaker.position(self.clock.now()) is not None and self.clock.now() < deadline:
            time.sleep(0.05)  # noqa: TID251 - the tone is heard meanwhile
        return Diagnosis(True, f"{speaker.describe()}, played a tone")

    def _camera(self) -> Diagnosis:
        camera = self.resources.obtain("camera", Camera)
        deadline = self.clock.now() + 3.0
        frame = None
        while frame is None and self.clock.now() < deadline:
            time.sleep(0.05)  # noqa: TID251 - a camera needs a moment
            frame = camera.read(self.clock.now())
        if frame is None:
            return Diagnosis(False, "no picture - unplug it and plug it in again")
        height, width = frame.image.shape[:2]
        if frame.image.max() < 16:
            return Diagnosis(False, f"{width} x {height}, but black - take off the lens cover")
        return Diagnosis(True, camera.describe())

    def _screen(self) -> Diagnosis:
        screen = self.resources.obtain("screen", Screen)
        return Diagnosis(True, f"{screen.describe()}, {screen.width} x {screen.height}")

    def _base(self) -> Diagnosis:
        drive = self.resources.obtain("drive", DriveSystem)
        odometry = self.resources.obtain("odometry", Odometry)
        drive.set_velocity(Twist(), self.clock.now())
        pose = odometry.pose(self.clock.now())
        return Diagnosis(True, f"{drive.describe()}, at x {pose.x:.2f} m, y {pose.y:.2f} m")

    def _voice(self) -> Diagnosis:
        voice = self.resources.obtain("voice", Synthesizer)
        speech = voice.synthesize("Hello.")
        return Diagnosis(True, f"{voice.describe()}, {speech.duration:.1f} s of speech")

    def _recognizer(self) -> Diagnosis:
        from hri.speech.grammar import load_grammar

        recognizer = self.resources.obtain("recognizer", Recognizer)
        recognizer.start(load_grammar("companion.jsgf"))
        return Diagnosis(True, f"{recognizer.describe()}, its model loads")

    def _faces(self) -> Diagnosis:
        from hri.vision.detectors.detector_choice import load_detectors

        problems = load_detectors().problems
        if problems:
            return Diagnosis(False, f"{problems[0]} (until then only boxes and coarse motion)")
        return Diagnosis(True, "BlazeFace and the face mesh load")


def _dbfs(samples: Any) -> float:
    """Level of the loudest sample against full scale."""
    peak = float(np.abs(samples.astype(np.int32)).max()) if len(samples) else 0.0
    return 20 * math.log10(max(peak, 1e-3) / 32768)


def _meter(level: float) -> str:
    filled = round(METER_WIDTH * min(1.0, max(0.0, (level + 60) / 60)))
    return f"[{'#' * filled}{'.' * (METER_WIDTH - filled)}] {level:6.1f} dBFS"


def _choose() -> int:
    """Ask for microphone, speaker and camera, and keep the answers."""
    if not sys.stdin.isatty():
        raise HriError("choosing needs a terminal - run `hri doctor --choose` in one")
    chosen = load_choices()
    for id, direction in (("microphone", "input"), ("speaker", "output")):
        if _ask(chosen, id, _sounds(direction)):
            report(f"  {_tried(id, chosen[id])}")
    _ask(chosen, "camera", {str(index): f"camera {index}" for index in range(4)})
    report(f"kept in {save_choices(chosen)}; run `hri doctor` to try them")
    return 0


def _sounds(direction: str) -> dict[str, str]:
    """Sound devices of one direction by their number, with the rate and channels they have."""
    from hri.hal.drivers.portaudio import SoundFormat
    from hri.hal.drivers.sound_card import load_sounddevice

    channels = f"max_{direction}_channels"
    return {
        str(number): f"{device['name']} ({form})"
        for number, device in enumerate(load_sounddevice().query_devices())
        if device[channels]
        for form in [SoundFormat(round(device["default_samplerate"]), device[channels])]
    }


def _tried(id: str, device: str) -> str:
    """How a chosen sound device is used, or why it cannot be."""
    described = Description(id, f"Hri.{id.capitalize()}", {"device": device})
    with ResourceManager([described], RealClock()) as resources:
        try:
            return resources.obtain(id, Resource).describe()
        except NotAvailable as error:
            return str(error)


def _ask(chosen: dict[str, str], id: str, names: dict[str, str]) -> bool:
    """Ask for one device; whether another was chosen."""
    print()
    report(f"{id} (now: {chosen.get(id, 'the default')})")
    for number, name in names.items():
        report(f"  {number}  {name}")
    while True:
        answer = input("number, or Enter to keep it: ").strip()
        if not answer:
            return False
        if answer in names:
            chosen[id] = answer
            return True
        print("that number is not in the list")
