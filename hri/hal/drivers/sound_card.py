"""Microphone and speaker of this machine, through PortAudio."""

from __future__ import annotations

import threading
from collections import deque
from typing import Any

import numpy as np

from hri.core.errors import NotAvailable
from hri.core.signals import Samples
from hri.hal.drivers.channels import OneChannel, channel_of
from hri.hal.drivers.resampling import resample
from hri.hal.drivers.silence import silenced_libraries
from hri.hal.microphone import Microphone
from hri.hal.resource import Resource
from hri.hal.speaker import Speaker

LONGEST_BACKLOG = 10.0
"""Seconds of sound kept while nobody reads; older sound is dropped."""
REOPEN_AFTER = 2.0
"""Seconds between attempts to find a device that went away."""
FADE = 128
"""Samples in which a sound that is cut dies away."""
INSTALL = "apt install libportaudio2"


def load_sounddevice() -> Any:
    """The sounddevice module. Raises NotAvailable with the command that installs PortAudio."""
    try:
        import sounddevice
    except OSError as error:
        raise NotAvailable(f"sound card: PortAudio is missing - {INSTALL}") from error
    return sounddevice


class _SoundCard(Resource):
    """What both ends share: a stream that is opened, watched, and opened again when it is lost.

    PortAudio knows the devices that were there when it was loaded, so a device that is named by
    its number may need a restart; the system's default, which sound servers keep alive, does not.
    """

    is_hardware = True

    def _open(self) -> None:
        self._sounddevice = load_sounddevice()
        self._ending = threading.Event()
        self._search: threading.Thread | None = None
        try:
            self._stream = self._started_stream()
        except (self._sounddevice.PortAudioError, ValueError) as error:
            # PortAudio numbers the default device -1 when there is none.
            why = "no device" if "-1" in str(error) else str(error).split(" [")[0]
            raise self.not_available(why, "plug one in, or `hri doctor --choose`") from error

    def _started_stream(self) -> Any:
        stream = self._new_stream()
        try:
            stream.start()
        except BaseException:
            stream.close()
            raise
        return stream

    def _device(self) -> str | int | None:
        """The chosen device by number or part of its name; None for the system's default."""
        name = self.description.text("device")
        return (int(name) if name.isdigit() else name) or None

    def _new_stream(self) -> Any:
        raise TypeError("a sound card driver makes its stream")

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
                with silenced_libraries():
                    self._stream = self._started_stream()
            except (self._sounddevice.PortAudioError, ValueError):
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

    With another `channel` than "mix" the device is opened in stereo, see `channels`.
    """

    parameters = ("device", "rate", "channel")
    overruns = 0
    """How often sound was lost because the system did not take it in time; told as it doubles."""

    def _open(self) -> None:
        self.rate = self.description.count("rate", 16000, 1000, 400_000)
        self._blocks: deque[Samples] = deque(maxlen=int(LONGEST_BACKLOG * self.rate / 320))
        self._channel = channel_of(self.description)
        self._one_channel = OneChannel(self._channel)
        self._told_overruns = 0
        super()._open()

    def _new_stream(self) -> Any:
        return self._sounddevice.InputStream(
            samplerate=self.rate,
            blocksize=320,
            channels=1 if self._channel == "mix" else 2,
            dtype="int16",
            device=self._device(),
            callback=self._heard,
        )

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
        blocks = [self._blocks.popleft() for _ in range(len(self._blocks))]
        return np.concatenate(blocks) if blocks else np.zeros(0, np.int16)


class SoundCardSpeaker(_SoundCard, Speaker):
    """Plays through the sound card in small blocks, so that a stop is heard within one.

    While the device is gone a sound goes on in silence, at its own pace: lips and dialogue keep
    their time, and what was not heard does not sound later.
    """

    parameters = ("device", "rate")

    def _open(self) -> None:
        self.rate = self.description.count("rate", 22050, 1000, 400_000)
        self._sound_lock = threading.Lock()
        self._source, self._source_rate = np.zeros(0, np.int16), self.rate
        self._sound: Samples = self._source
        self._played = 0
        self._begun = 0.0
        self._is_lost = False
        super()._open()

    def _new_stream(self) -> Any:
        return self._sounddevice.OutputStream(
            samplerate=self.rate,
            blocksize=256,
            latency="low",
            channels=1,
            dtype="int16",
            device=self._device(),
            callback=self._wanted,
        )

    def _wanted(self, out: Any, frames: int, time: object, status: object) -> None:
        with self._sound_lock:
            block = self._sound[self._played : self._played + frames]
            self._played += len(block)
        out[: len(block), 0] = block
        out[len(block) :, 0] = 0

    def play(self, samples: Samples, rate: int, now: float) -> None:
        self._source, self._source_rate = samples, rate
        self._begun, self._is_lost = now, False
        sound = resample(samples, rate, self.rate)
        with self._sound_lock:
            self._sound, self._played = sound, 0

    def extend(self, samples: Samples, now: float) -> None:
        if not len(self._source):
            return
        # Converted again as a whole, since a seam would click.
        self._source = np.concatenate([self._source, samples])
        if not self._is_lost:
            sound = resample(self._source, self._source_rate, self.rate)
            with self._sound_lock:
                self._sound = sound

    def position(self, now: float) -> float | None:
        if not self._watch():
            self._is_lost = True
            self._fade_out()
        if self._is_lost:
            elapsed = now - self._begun
            return elapsed if elapsed < len(self._source) / self._source_rate else None
        latency = round(self.latency * self.rate)
        with self._sound_lock:
            if not len(self._source) or self._played >= len(self._sound):
                # The last blocks are still in the card; they are short enough to count as heard.
                return None
            return float(max(0, self._played - latency)) / self.rate

    def stop(self, now: float) -> None:
        self._source = self._source[:0]
        self._fade_out()

    @property
    def latency(self) -> float:
        """Seconds from a block being taken until it is heard."""
        return float(self._stream.latency)

    def _fade_out(self) -> None:
        """Fall silent within a few milliseconds; at once would click."""
        with self._sound_lock:
            rest = self._sound[self._played : self._played + FADE]
            self._sound = (rest * np.linspace(1, 0, len(rest))).astype(np.int16)
            self._played = 0
