"""The espeak-ng C library, through ctypes: one text at a time in the whole process.

The library comes inside the `espeakng-loader` wheel; the system's own serves where that is missing.
Constants and the event structure are those of `speak_lib.h` (espeak-ng 1.51 and 1.52).
"""

from __future__ import annotations

import _ctypes
import ctypes
import ctypes.util
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from typing import Any

from hri.core.errors import NotAvailable

_SYNCHRONOUS = 2
_PHONEME_EVENTS = 1
_NO_EXIT = 0x8000
_UTF8 = 1
_EVENT_END = 0
_EVENT_PHONEME = 7
_RATE, _VOLUME, _PITCH = 1, 2, 3
_BLOCK_MS = 60
_LONGEST_NAME = 40
"""Bytes of a voice's name; the library copies it into a small buffer."""


class _Id(ctypes.Union):
    _fields_ = [("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8)]


class _Event(ctypes.Structure):
    _fields_ = [
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _Id),
    ]


_Callback = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event)
)


@dataclass(frozen=True, slots=True)
class Setting:
    """How to speak."""

    voice: str = "en-us"
    rate: int = 165
    """Words a minute, 80 to 450."""
    pitch: int = 50
    """0 to 100."""
    volume: int = 100
    """Percent, 0 to 200."""


@dataclass(frozen=True, slots=True)
class Sound:
    """What the library made of a text."""

    samples: bytes
    """16 bit, mono."""
    phonemes: tuple[tuple[str, float], ...]
    """Mnemonic and start in seconds; `_:` and the like are pauses, the last one ends the text."""


class EspeakLibrary:
    """Speaks; its methods may be called from any thread.

    The library keeps the phase of its vibrato from one sentence to the next, so the same text
    would sound a little different each time. It is therefore loaded anew for every text, which
    takes some 5 ms and makes the same text give the same samples.
    """

    def __init__(self, path: str, data_path: bytes | None) -> None:
        self.rate = 0
        """Samples a second."""
        self._path = path
        self._data_path = data_path
        self._lock = threading.Lock()
        with self._loaded():
            pass

    def has_voice(self, voice: str) -> bool:
        """Whether a voice such as "en-us" or "en-us+f3" is there."""
        with self._loaded() as library:
            return bool(library.espeak_SetVoiceByName(voice.encode()[:_LONGEST_NAME]) == 0)

    def speak(self, text: str, setting: Setting) -> Sound:
        """The sound of a text."""
        blocks: list[bytes] = []
        phonemes: list[tuple[str, float]] = []

        def take(samples: Any, count: int, events: Any) -> int:
            if samples and count > 0:
                blocks.append(ctypes.string_at(samples, count * 2))
            phonemes.extend(_phonemes(events))
            return 0

        callback = _Callback(take)
        with self._loaded() as library:
            library.espeak_SetSynthCallback(callback)
            library.espeak_SetVoiceByName(setting.voice.encode())
            library.espeak_SetParameter(_RATE, setting.rate, 0)
            library.espeak_SetParameter(_PITCH, setting.pitch, 0)
            library.espeak_SetParameter(_VOLUME, setting.volume, 0)
            data = text.replace("\0", " ").encode() + b"\0"
            library.espeak_Synth(data, len(data), 0, 1, 0, _UTF8, None, None)
        return Sound(b"".join(blocks), tuple(phonemes))

    def phonemes_of(self, word: str, voice: str = "en-us") -> list[str]:
        """The mnemonics of a word, stress marks included."""
        with self._loaded() as library:
            library.espeak_SetVoiceByName(voice.encode())
            library.espeak_TextToPhonemes.restype = ctypes.c_char_p
            rest = ctypes.c_char_p(word.replace("\0", " ").encode())
            # The mode asks for mnemonics with "_" between them.
            spelt = library.espeak_TextToPhonemes(ctypes.byref(rest), _UTF8, ord("_") << 8)
            return (spelt or b"").decode().replace("_", " ").split()

    @contextmanager
    def _loaded(self) -> Iterator[ctypes.CDLL]:
        with self._lock:
            library = ctypes.CDLL(self._path)
            options = _PHONEME_EVENTS | _NO_EXIT
            self.rate = library.espeak_Initialize(_SYNCHRONOUS, _BLOCK_MS, self._data_path, options)
            if self.rate <= 0:
                raise NotAvailable("espeak-ng finds no voices - install espeakng-loader anew")
            try:
                yield library
            finally:
                library.espeak_Terminate()
                _unload(library)


def _unload(library: ctypes.CDLL) -> None:
    unload = getattr(_ctypes, "dlclose", None) or _ctypes.FreeLibrary  # type: ignore[attr-defined]
    unload(library._handle)


def _phonemes(events: Any) -> Iterator[tuple[str, float]]:
    for event in events:
        if event.type == _EVENT_END:
            return
        if event.type == _EVENT_PHONEME:
            yield event.id.string.decode(errors="replace"), event.audio_position / 1000


@cache
def load_espeak() -> EspeakLibrary:
    """The library of this process. Raises NotAvailable with what to install."""
    path, data_path = _find()
    try:
        return EspeakLibrary(path, data_path)
    except OSError as error:
        raise NotAvailable(f"espeak-ng: {error} - pip install espeakng-loader") from error


def _find() -> tuple[str, bytes | None]:
    """Where the library and its data are; no data path for the system's own."""
    try:
        import espeakng_loader

        return espeakng_loader.get_library_path(), espeakng_loader.get_data_path().encode()
    except (ImportError, OSError):
        found = ctypes.util.find_library("espeak-ng")
        if found is None:
            raise NotAvailable("espeak-ng is missing - pip install espeakng-loader") from None
        return found, None
