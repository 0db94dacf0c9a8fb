"""Sound cards of a pretended PortAudio, turned by hand: as much of sounddevice as `hri` uses."""

from dataclasses import dataclass, field

import numpy as np


class PortAudioError(Exception):
    """Raised with a text and an error code of portaudio.h, as sounddevice does."""


BAD_CHANNELS = PortAudioError("Error opening Stream: Invalid number of channels", -9998)
BAD_RATE = PortAudioError("Error opening Stream: Invalid sample rate", -9997)
BUSY = PortAudioError("Error opening Stream: Device unavailable", -9985)
ALSA_BUSY = PortAudioError(
    "Error opening Stream: Unanticipated host error", -9999, (0, -16, "Device or resource busy")
)


@dataclass
class Card:
    """A device with the rates and the numbers of channels that it takes."""

    rates: tuple[int, ...] = (8000, 16000, 22050, 44100, 48000)
    inputs: tuple[int, ...] = (1, 2)
    outputs: tuple[int, ...] = (1, 2)
    error: Exception | None = None
    """Raised when it is opened."""
    error_at_start: bool = False
    name: str = "USB Audio"
    opened: list["Stream"] = field(default_factory=list)


class Stream:
    """Runs when it is pushed or pulled."""

    latency = 0.0
    active = True

    def __init__(self, card, counts, callback, samplerate, channels, **settings):
        for error in (
            None if card.error_at_start else card.error,
            None if channels in counts else BAD_CHANNELS,
            None if samplerate in card.rates else BAD_RATE,
        ):
            if error is not None:
                raise PortAudioError(*error.args)  # one that is kept would keep its frames
        self.card, self.callback, self.settings = card, callback, settings
        self.rate, self.channels = samplerate, channels
        card.opened.append(self)

    def start(self):
        if self.card.error is not None:
            raise PortAudioError(*self.card.error.args)

    def close(self):
        self.active = False

    def push(self, sound):
        """Let the microphone hear samples [frames] or [frames, channels], 20 ms at a time."""
        block = np.asarray(sound, np.int16).reshape(len(sound), -1)
        block = np.repeat(block, self.channels // block.shape[1], axis=1)
        for at in range(0, len(block), self.rate // 50):
            part = block[at : at + self.rate // 50].copy()
            self.callback(part, len(part), None, None)
            part[:] = 99  # the memory is used again

    def pull(self, frames):
        """What the speaker is given, [frames, channels]."""
        out = np.full((frames, self.channels), 99, np.int16)
        self.callback(out, frames, None, None)
        return out


class PortAudio:
    """Stands in for the module `sounddevice`; the first card is the system's default."""

    PortAudioError = PortAudioError

    def __init__(self, *cards):
        self.cards = cards

    def query_devices(self, device=None, kind=None):
        if kind is None:
            return [self._about(card) for card in self.cards]
        return self._about(self._card(device, kind))

    def InputStream(self, *, device=None, **settings):
        card = self._card(device, "input")
        return Stream(card, card.inputs, **settings, device=device)

    def OutputStream(self, *, device=None, **settings):
        card = self._card(device, "output")
        return Stream(card, card.outputs, **settings, device=device)

    def _card(self, device, kind):
        if isinstance(device, str):
            named = [card for card in self.cards if device in card.name]
            if len(named) != 1:
                raise ValueError(f"No {kind} device matching {device!r}")
            return named[0]
        index = device if device is not None else 0 if self.cards else -1
        if not 0 <= index < len(self.cards):
            raise PortAudioError(f"Error querying device {index}")
        return self.cards[index]

    @staticmethod
    def _about(card):
        return {
            "name": card.name,
            "default_samplerate": float(card.rates[-1] if card.rates else 44100),
            "max_input_channels": max(card.inputs, default=0),
            "max_output_channels": max(card.outputs, default=0),
        }
