"""Devices that a service begins without, and takes when they come.

Until then nothing is heard, seen or shown, and what is said is silent. No simulated device takes
their place: whoever is heard and seen is real.
"""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Frame, Image, Samples
from hri.hal.camera import Camera, Footage
from hri.hal.drivers.memory import SilentSpeaker
from hri.hal.drivers.resampling import Resampler
from hri.hal.drivers.sound_devices import list_again
from hri.hal.microphone import Microphone
from hri.hal.resource import Description, Resource, Resources
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker

WAITING = " (waiting for it)"
"""Ends the line about a device that is waited for."""
LOOK_AGAIN = 2.0
"""Seconds between attempts to open a device."""
FAREWELL = 2.0
"""Seconds that closing waits for an attempt; one that hangs closes its device by itself."""
_SOUND = threading.Lock()
"""Held while a sound device is tried: PortAudio starts again for it."""


def awaited(device: Resource) -> Awaited | None:
    """What stands for a device that is missing; None for a kind that is not waited for."""
    if isinstance(device, Microphone):
        return AwaitedMicrophone(device)
    if isinstance(device, Speaker):
        return AwaitedSpeaker(device)
    if isinstance(device, Camera):
        return AwaitedCamera(device)
    return AwaitedScreen(device) if isinstance(device, Screen) else None


class Awaited(Resource):
    """Looks for `device` until it can be opened, then passes on what it gives and gets."""

    device: Resource
    is_hardware = True
    is_there = False
    """Whether the device is open."""

    def describe(self) -> str:
        return self.device.describe() if self.is_there else f"{super().describe()}, missing"

    def __init__(self, description: Description, manager: Resources) -> None:
        super().__init__(description, manager)
        self._reported: set[str] = set()

    def report(self, error: Exception) -> None:
        """Tell people why it is missing; each reason once, until it is there."""
        line = f"{error}{WAITING}"
        if line not in self._reported:
            self._reported.add(line)
            self.manager.notice(line)

    def _open(self) -> None:
        self._ending = threading.Event()
        self._search = threading.Thread(
            target=self._look, args=(self._ending,), name=f"looks for {self.id}", daemon=True
        )
        self._search.start()

    def _look(self, ending: threading.Event) -> None:
        while not ending.is_set():
            if self._attempt():
                break
            ending.wait(LOOK_AGAIN)
        if ending.is_set():
            self._let_device_go()

    def _attempt(self) -> bool:
        """Whether it is there now."""
        try:
            self.device.activate()
        except NotAvailable as error:
            self.report(error)
            return False
        except Exception as error:
            self.report(HriError(f"{self.id}: its driver failed: {error!r} - fix the driver"))
            return False
        self._come()
        self.is_there = True
        self._reported.clear()
        self.manager.notice(f"{self.id}: is there")
        return True

    def _come(self) -> None:
        """Take over what is known only now."""

    def _close(self) -> None:
        self._ending.set()
        self._search.join(FAREWELL)
        if not self._search.is_alive():
            self._let_device_go()

    def _let_device_go(self) -> None:
        self.is_there = False
        self.device.deactivate()


class _AwaitedSound(Awaited):
    """What has to do with PortAudio, which knows only the devices that were there at its start."""

    def _attempt(self) -> bool:
        with _SOUND:
            if not self._is_in_use():
                list_again()
            return super()._attempt()

    def _is_in_use(self) -> bool:
        users = (*self.manager.opened(Microphone), *self.manager.opened(Speaker))
        return any(
            user.is_there if isinstance(user, Awaited) else user.is_hardware for user in users
        )


class AwaitedMicrophone(_AwaitedSound, Microphone):
    """Hears nothing until the microphone is there."""

    def __init__(self, device: Microphone) -> None:
        super().__init__(device.description, device.manager)
        self.device: Microphone = device
        self.rate = device.rate

    def _come(self) -> None:
        self._resampler = Resampler(self.device.rate, self.rate)

    def read(self, now: float) -> Samples:
        if not self.is_there:
            return np.zeros(0, np.int16)
        heard = self.device.read(now)
        return heard if self.device.rate == self.rate else self._resampler.convert(heard)


class AwaitedSpeaker(_AwaitedSound, Speaker):
    """Plays in silence until the speaker is there; a sound that has begun goes on so."""

    def __init__(self, device: Speaker) -> None:
        super().__init__(device.description, device.manager)
        self.device: Speaker = device
        self._silence = SilentSpeaker(device.description, device.manager)
        self._playing: Speaker = self._silence

    def _open(self) -> None:
        self._silence.activate()
        self._playing = self._silence
        super()._open()

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self._playing = self.device if self.is_there else self._silence
        self._playing.play(samples, rate, now)

    def extend(self, samples: Samples, now: float) -> None:
        self._playing.extend(samples, now)

    def position(self, now: float) -> float | None:
        return self._playing.position(now)

    def stop(self, now: float) -> None:
        self._playing.stop(now)


class AwaitedCamera(Awaited, Camera):
    """Sees nothing until the camera is there, which turns its pictures and reports its faults."""

    def __init__(self, device: Camera) -> None:
        own = ("mirror", "rotate")
        left = {name: v for name, v in device.description.parameters.items() if name not in own}
        super().__init__(replace(device.description, parameters=left), device.manager)
        self.device: Camera = device
        self._come()

    def _come(self) -> None:
        device = self.device
        self.width, self.height = device.width, device.height
        self.field_of_view = device.field_of_view

    def _read(self, now: float) -> Frame | None:
        return self.device.read(now) if self.is_there else None

    def _watch(self, now: float, has_picture: bool) -> None:
        self._log.is_lost = self.is_there and self.device.is_lost

    def footage(self) -> Footage:
        return self.device.footage() if self.is_there else super().footage()

    def look_ahead(self, is_ahead: bool) -> None:
        self.device.look_ahead(is_ahead)

    def pan(self, now: float) -> float:
        return self.device.pan(now) if self.is_there else 0.0

    @property
    def has_ended(self) -> bool:
        return self.is_there and self.device.has_ended


class AwaitedScreen(Awaited, Screen):
    """Shows nothing until there is a display; SDL wants the thread that shows."""

    def __init__(self, device: Screen) -> None:
        super().__init__(device.description, device.manager)
        self.device: Screen = device
        self.width, self.height = device.width, device.height

    def _open(self) -> None:
        self._due = self.manager.clock.now() + LOOK_AGAIN

    def show(self, image: Image, time: float) -> None:
        now = self.manager.clock.now()
        if not self.is_there and now >= self._due:
            self._due = now + LOOK_AGAIN
            self._attempt()
        if self.is_there:
            self.device.show(image, time)

    def pressed_keys(self) -> list[str]:
        return self.device.pressed_keys() if self.is_there else []

    @property
    def is_closed(self) -> bool:
        return self.is_there and self.device.is_closed

    def _close(self) -> None:
        self._let_device_go()
