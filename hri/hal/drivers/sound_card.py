"""Microphone and speaker of this machine, through PortAudio."""

from __future__ import annotations

import threading
from collections import deque
from typing import Any, ClassVar

import numpy as np

from hri.core.errors import NotAvailable
from hri.core.signals import Samples
from hri.hal.drivers.channels import OneChannel, channel_of
from hri.hal.drivers.portaudio import (
    Direction,
    Refused,
    SoundFormat,
    kilohertz,
    started,
)
from hri.hal.drivers.resampling import GrowingSound, Resampler
from hri.hal.microphone import Microphone
from hri.hal.resource import Resource
from hri.hal.speaker import Speaker

LONGEST_BACKLOG = 10.0
"""Seconds of sound kept while nobody reads; older sound is dropped."""
BLOCK = 0.02
"""Seconds of sound that a microphone gives at once."""
REOPEN_AFTER = 2.0
"""Seconds between attempts to find a device that went away."""
FADE = 128
"""Samples in which a sound that is cut dies away."""
INSTALL = "apt install libportaudio2"
_LOADING = threading.Lock()
"""Held while it is imported: a thread that waits for an import that fails gets half a module."""


def load_sounddevice() -> Any:
    """The sounddevice module. Raises NotAvailable with the command that installs PortAudio."""
    try:
        with _LOADING:
            import sounddevice
    except OSError as error:
        raise NotAvailable(f"sound card: PortAudio is missing - {INSTALL}") from error
    return sounddevice


class _SoundCard(Resource):
    """What both ends share: a stream that is opened, watched, and opened again when it is lost.

    A device that does not take the wanted format is opened in one that it takes, and the sound is
    converted. PortAudio knows the devices that were there when it was loaded, so a device that is
    named by its number may need a restart; the system's default, which sound servers keep alive,
    does not.
    """

    is_hardware = True
    direction: ClassVar[Direction]
    _wanted: SoundFormat

    def _open(self) -> None:
        self._sounddevice = load_sounddevice()
        self._ending = threading.Event()
        self._search: threading.Thread | None = None
        try:
            self._start()
        except Refused as refused:
            raise self.not_available(refused.why, refused.remedy) from refused

    def _start(self) -> None:
        self._stream, self._format = started(
            self._sounddevice, self.direction, self._device(), self._wanted, self._new_stream
        )

    def _device(self) -> str | int | None:
        """The chosen device by number or part of its name; None for the system's default."""
        name = self.description.text("device")
        return (int(name) if name.isdigit() else name) or None

    def _new_stream(self, form: SoundFormat) -> Any:
        raise TypeError("a sound card driver makes its stream")

    def describe(self) -> str:
        return f"{super().describe()} at {self._format}"

    def _watch(self) -> bool:
        """Whether the stream lives; when it has died, a thread looks for the device."""
        if self._search is not None:
            return False
        if self._stream.active:
            return True
        self.manager.notice(f"{self.id}: gone - waiting for it to come back")
        self._search = threading.Thread(target=self._look_for_device, daemon=True)
        self._search.start()
        return False

    def _look_for_device(self) -> None:
        self._stream.close()
        while not self._ending.wait(REOPEN_AFTER):
            try:
                self._start()
            except Refused:
                continue
            self.manager.notice(f"{self.id}: is back")
            break
        self._search = None

    def _close(self) -> None:
        self._ending.set()
        if (search := self._search) is not None:
            search.join(timeout=REOPEN_AFTER)
        self._stream.close()


class SoundCardMicrophone(_SoundCard, Microphone):
    """Hears through the sound card; when it is unplugged there is silence until it is back.

    It gives sound of its `rate`, whatever rate the device has. With another `channel` than "mix"
    the device is opened in stereo, see `channels`.
    """

    parameters = ("device", "rate", "channel")
    direction = "input"
    overruns = 0
    """How often sound was lost because the system did not take it in time; told as it doubles."""

    def _open(self) -> None:
        self.rate = self.description.count("rate", 16000, 1000, 400_000)
        self._channel = channel_of(self.description)
        self._wanted = SoundFormat(self.rate, 1 if self._channel == "mix" else 2)
        self._told_overruns = 0
        self._has_told_inverted = False
        super()._open()

    def _new_stream(self, form: SoundFormat) -> Any:
        self._blocks: deque[Samples] = deque(maxlen=round(LONGEST_BACKLOG / BLOCK))
        self._one_channel = OneChannel(self._channel)
        self._resampler = Resampler(form.rate, self.rate)
        return self._sounddevice.InputStream(
            samplerate=form.rate,
            blocksize=round(BLOCK * form.rate),
            channels=form.channels,
            dtype="int16",
            device=self._device(),
            callback=self._heard,
        )

    def describe(self) -> str:
        converted = f", converted to {kilohertz(self.rate)}"
        return super().describe() + (converted if self._format.rate != self.rate else "")

    def _heard(self, data: Any, frames: int, time: object, status: Any) -> None:
        self.overruns += bool(status and status.input_overflow)
        self._blocks.append(self._one_channel.take(data))

    def read(self, now: float) -> Samples:
        self._watch()
        if (lost := self.overruns) > 2 * self._told_overruns:
            self._told_overruns = lost
            times = f"{lost} times" if lost > 1 else "once"
            self.manager.notice(
                f"{self.id}: sound was lost, {times} by now - the machine is too busy"
            )
        if self._one_channel.is_any_inverted and not self._has_told_inverted:
            self._has_told_inverted = True
            what = "a channel is the opposite of the other and is turned round"
            self.manager.notice(f"{self.id}: {what} - check its wires")
        blocks = [self._blocks.popleft() for _ in range(len(self._blocks))]
        return self._resampler.convert(np.concatenate([np.zeros(0, np.int16), *blocks]))


class SoundCardSpeaker(_SoundCard, Speaker):
    """Plays through the sound card in small blocks, so that a stop is heard within one.

    While the device is gone a sound goes on in silence, at its own pace: lips and dialogue keep
    their time, and what was not heard does not sound later.
    """

    parameters = ("device", "rate")
    direction = "output"

    def _open(self) -> None:
        rate = self.description.count("rate", 22050, 1000, 400_000)
        self._wanted = SoundFormat(rate, 1)
        self._sound_lock = threading.Lock()
        self._sound = GrowingSound(np.zeros(0, np.int16), rate, rate)
        self._block: Samples = self._sound.samples
        """What is played: the sound, or how it dies away."""
        self._played = 0
        self._begun = 0.0
        self._is_lost = False
        super()._open()

    def _new_stream(self, form: SoundFormat) -> Any:
        return self._sounddevice.OutputStream(
            samplerate=form.rate,
            blocksize=256,
            latency="low",
            channels=form.channels,
            dtype="int16",
            device=self._device(),
            callback=self._give,
        )

    def _give(self, out: Any, frames: int, time: object, status: object) -> None:
        with self._sound_lock:
            block = self._block[self._played : self._played + frames]
            self._played += len(block)
        out[: len(block)] = block[:, None]
        out[len(block) :] = 0

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self._begun, self._is_lost = now, False
        self._sound = GrowingSound(samples, rate, self._format.rate)
        with self._sound_lock:
            self._block, self._played = self._sound.samples, 0

    def extend(self, samples: Samples, now: float) -> None:
        if not self._sound.seconds:
            return
        self._sound.extend(samples)
        if not self._is_lost:
            with self._sound_lock:
                self._block = self._sound.samples

    def position(self, now: float) -> float | None:
        if not self._watch():
            self._is_lost = True
            self._fade_out()
        if self._is_lost:
            elapsed = now - self._begun
            return elapsed if elapsed < self._sound.seconds else None
        rate = self._format.rate
        with self._sound_lock:
            if not self._sound.seconds or self._played >= len(self._block):
                # The last blocks are still in the card; they are short enough to count as heard.
                return None
            return max(0, self._played - round(self.latency * rate)) / rate

    def stop(self, now: float) -> None:
        self._sound = GrowingSound(self._block[:0], self._format.rate, self._format.rate)
        self._fade_out()

    @property
    def latency(self) -> float:
        """Seconds from a block being taken until it is heard."""
        return float(self._stream.latency)

    def _fade_out(self) -> None:
        """Fall silent within a few milliseconds; at once would click."""
        with self._sound_lock:
            rest = self._block[self._played : self._played + FADE]
            self._block = (rest * np.linspace(1, 0, len(rest))).astype(np.int16)
            self._played = 0
