"""Sound files: played over any speaker, recorded from any microphone."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from hri.core.clock import Timer, Worker
from hri.core.errors import HriError
from hri.core.signals import Samples
from hri.core.stored_data_index import note
from hri.hal.audio_file import LONGEST_RECORDING, AudioFilePlayer, AudioFileRecorder
from hri.hal.drivers.partner import use_partner
from hri.hal.drivers.wav_file import GrowingWav, load_sound
from hri.hal.microphone import Ear, Microphone
from hri.hal.pending import Pending
from hri.hal.speaker import Speaker

LOOK = 0.02
"""Seconds between looks whether a file is decoded, or heard to its end."""
PUMP = 0.1
"""Seconds between writes of a recording."""
DECODING = 0.05
"""Seconds that decoding takes on a fake clock."""


Loaded = tuple[Pending[None], Samples, int]
"""Whose sound it is, the sound, its rate."""


class SpeakerFilePlayer(AudioFilePlayer):
    """Decodes in a worker, then plays over the speaker that `speaker` names, or the first."""

    parameters = ("speaker",)

    def _open(self) -> None:
        self._clock = self.manager.clock
        self._speaker = use_partner(self, "speaker", Speaker)
        self._worker: Worker[Loaded | None] = self._clock.worker(DECODING)
        self._current: Pending[None] | None = None
        self._unloaded: Path | None = None
        self._is_playing = False

    def play(self, path: str | Path) -> Pending[None]:
        self.stop()
        self._current = Pending(self._clock, self._silence)
        self._unloaded = Path(path)
        self._look(self._current)
        return self._current

    def position(self, now: float) -> float | None:
        return self._speaker.position(now) if self._is_playing else None

    def stop(self) -> None:
        if self._current is not None:
            self._current.cancel("the sound was stopped - play it again")

    def _silence(self) -> None:
        if self._is_playing:
            self._is_playing = False
            self._speaker.stop(self._clock.now())

    def _look(self, pending: Pending[None]) -> None:
        """Bring this file one step further, and look again until it has ended."""
        if pending.is_done:
            return
        now = self._clock.now()
        for loaded in self._worker.poll():
            if loaded is not None and loaded[0] is pending:
                self._is_playing = True
                self._speaker.play(loaded[1], loaded[2], now)
        if self._unloaded is not None and not self._worker.is_busy:
            self._worker.submit(partial(_load, self._unloaded, pending))
            self._unloaded = None
        if self._is_playing and self._speaker.position(now) is None:
            self._is_playing = False
            pending.complete(None)
        else:
            self._clock.call_at(now + LOOK, partial(self._look, pending))

    def _close(self) -> None:
        self.stop()
        self._worker.close()


def _load(path: Path, pending: Pending[None]) -> Loaded | None:
    try:
        return pending, *load_sound(path)
    except HriError as error:
        pending.fail(error)
        return None


class MicrophoneFileRecorder(AudioFileRecorder):
    """Writes WAV files with what the microphone hears that `microphone` names, or the first."""

    parameters = ("microphone",)

    def _open(self) -> None:
        self._microphone = use_partner(self, "microphone", Microphone)
        self._recording: _Recording | None = None

    def record(self, path: str | Path, seconds: float = LONGEST_RECORDING) -> Pending[float]:
        if not 0 < seconds <= LONGEST_RECORDING:
            raise ValueError(f"{seconds:g} s - record more than 0 and at most 3600 s")
        self.stop()
        file = GrowingWav(Path(path), self._microphone.rate)
        note("sounds", Path(path))
        self._recording = _Recording(file, self._microphone.listen(), seconds)
        return self._recording.pending

    def stop(self) -> None:
        if self._recording is not None:
            self._recording.end()
            self._recording = None

    def _close(self) -> None:
        self.stop()


class _Recording:
    """One file on its way from the ear to the disk."""

    def __init__(self, file: GrowingWav, ear: Ear, seconds: float) -> None:
        self._clock = ear.microphone.manager.clock
        self._file, self._ear = file, ear
        self._left = round(seconds * ear.rate)
        self._written = 0
        self._timer: Timer | None = None
        self.pending: Pending[float] = Pending(self._clock, self._finish)
        ear.read(self._clock.now())  # what was heard before does not belong to it
        self._wait()

    def _wait(self) -> None:
        self._timer = self._clock.call_at(self._clock.now() + PUMP, self._pump)

    def _pump(self) -> None:
        self._write()
        if self._left > 0 and not self.pending.is_done:
            self._wait()
        else:
            self.end()

    def end(self) -> None:
        """Write what was heard up to now and close the file; a second call does nothing."""
        if not self.pending.is_done:
            self._write()
        if self.pending.complete(self._written / self._ear.rate):
            self._finish()

    def _write(self) -> None:
        samples = self._ear.read(self._clock.now())[: self._left]
        if not self._file.append(samples):
            self.pending.fail(HriError("the recording ended early - make room on the disk"))
            self._finish()
        self._left -= len(samples)
        self._written += len(samples)

    def _finish(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._ear.close()
        self._file.close()
