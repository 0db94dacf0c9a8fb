"""Sound devices through PortAudio: opened as wanted, else at what they take."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

from hri.hal.drivers.silence import silenced_libraries

CHOOSE = "`hri doctor --choose`"
RATES = (48000, 44100, 32000, 96000, 24000, 22050, 16000, 88200, 192000, 176400, 11025, 8000)
"""Samples a second that devices have, in the order in which they are tried."""
UNAVAILABLE, INVALID_DEVICE = -9985, -9996
"""Error codes of portaudio.h."""
BUSY_WORDS = ("busy", "unavailable", "in use", "already open", "exclusive")
GONE_WORDS = ("querying device", "no such", "disconnected", "invalid device")
"""PortAudio cannot query device -1 when there is no default device."""
FORMAT_WORDS = ("sample rate", "channels", "format")
FORBIDDEN_WORDS = ("permission", "access denied", "not permitted")

Direction = Literal["input", "output"]


@dataclass(frozen=True, slots=True)
class SoundFormat:
    """How sound goes through a device."""

    rate: int
    """Samples a second."""
    channels: int

    def __str__(self) -> str:
        named = {1: "mono", 2: "stereo"}.get(self.channels, f"{self.channels} channels")
        return f"{kilohertz(self.rate)} {named}"


class Refused(Exception):
    """A device cannot be used: `why`, and the `remedy`."""

    def __init__(self, why: str, remedy: str) -> None:
        super().__init__(f"{why} - {remedy}")
        self.why, self.remedy = why, remedy


def kilohertz(rate: float) -> str:
    """A rate for people."""
    return f"{rate / 1000:g} kHz"


def started(
    sounddevice: Any,
    direction: Direction,
    device: str | int | None,
    wanted: SoundFormat,
    make: Callable[[SoundFormat], Any],
) -> tuple[Any, SoundFormat]:
    """A running stream and its format: the wanted one, else the first that the device takes.

    `make` makes a stream of a format. Raises Refused.
    """
    first: Exception | None = None
    for form in _formats(sounddevice, direction, device, wanted):
        try:
            with silenced_libraries():
                return _running(make(form)), form
        except (sounddevice.PortAudioError, ValueError) as error:
            if refused := _final(error, device):
                raise refused from error
            first = first or error
    assert first is not None
    raise _all_refused(_text(first)) from first


def _running(stream: Any) -> Any:
    try:
        stream.start()
    except BaseException:
        stream.close()
        raise
    return stream


def _formats(
    sounddevice: Any, direction: Direction, device: str | int | None, wanted: SoundFormat
) -> Iterator[SoundFormat]:
    """The wanted format, then all that a device may take, likeliest first."""
    yield wanted  # most take it, so nothing else is asked first
    rates, most = [wanted.rate, *RATES], wanted.channels
    try:
        about = sounddevice.query_devices(device, direction)
    except (sounddevice.PortAudioError, ValueError):
        pass  # the common ones are tried
    else:
        rates.insert(1, round(about["default_samplerate"]))
        most = about[f"max_{direction}_channels"]
        if not most:
            raise Refused(f"it has no {direction}", f"choose another: {CHOOSE}")
    for rate in dict.fromkeys(rates):
        for channels in dict.fromkeys((wanted.channels, 2, 1, most)):
            form = SoundFormat(rate, channels)
            if form != wanted:
                yield form


def _final(error: Exception, device: str | int | None) -> Refused | None:
    """Why no format can help; None where another one may."""
    text = _text(error)
    if isinstance(error, ValueError):  # sounddevice finds none of that name, or several
        text = text.splitlines()[0].rstrip(":")
        return Refused(text[:1].lower() + text[1:], f"choose one: {CHOOSE}")
    code = error.args[1] if len(error.args) > 1 else 0
    lower = text.lower()
    if code == UNAVAILABLE or any(word in lower for word in BUSY_WORDS):
        return Refused("it is busy", f"end the program that uses it, or choose another: {CHOOSE}")
    if any(word in lower for word in FORBIDDEN_WORDS):
        return Refused("it may not be used", "add yourself to the group audio, and log in again")
    if code == INVALID_DEVICE or any(word in lower for word in GONE_WORDS):
        which = "no device" if device is None else f"no device {device}"
        return Refused(which, f"plug one in, or {CHOOSE}")
    return None


def _all_refused(said: str) -> Refused:
    """The error for a device that opens in no format, from what it said to the wanted one."""
    rates = ", ".join(f"{rate / 1000:g}" for rate in sorted(RATES))
    is_about_format = any(word in said.lower() for word in FORMAT_WORDS)
    why = f"it refuses every rate ({rates} kHz)" if is_about_format else "it does not open"
    return Refused(f"{why}: {said}", f"end what else may use it, or choose another: {CHOOSE}")


def _text(error: Exception) -> str:
    """PortAudio's message, with the system's message if there is one."""
    said = str(error.args[0]) if error.args else type(error).__name__
    for _, _, host_says in error.args[2:3]:
        return f"{said}: {host_says}" if host_says else said
    return said
