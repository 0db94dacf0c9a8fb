"""Which sound devices there are: PortAudio lists them once, when it begins."""

from __future__ import annotations

from hri.core.errors import NotAvailable
from hri.hal.drivers.silence import silenced_libraries
from hri.hal.drivers.sound_card import load_sounddevice


def list_again() -> None:
    """Let PortAudio begin again, so that it knows what was plugged in since; ends all streams.

    Does nothing where it is missing.
    """
    try:
        sounddevice = load_sounddevice()
    except NotAvailable:
        return
    with silenced_libraries():
        sounddevice._terminate()
        sounddevice._initialize()
