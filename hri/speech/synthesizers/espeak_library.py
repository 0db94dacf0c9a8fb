"""The espeak-ng C library, through ctypes: one text at a time in the whole process.

The library comes inside the `espeakng-loader` wheel; the system's own serves where that is missing.
Constants and the structures are those of `speak_lib.h` (espeak-ng 1.51 and 1.52).
"""

from __future__ import annotations

import _ctypes
import ctypes
import ctypes.util
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cache
from typing import Any, Literal

from hri.core.errors import NotAvailable

_SYNCHRONOUS = 2
_PHONEME_EVENTS = 1
_NO_EXIT = 0x8000
_UTF8 = 1
_SPELT_PHONEMES = 0x100
_IPA = 0x02
_RATE, _VOLUME, _PITCH, _RANGE = 1, 2, 3, 4
_BLOCK_MS = 60
_LONGEST_NAME = 40
"""Bytes of a voice's name; the library copies it into a small buffer."""
_MOST_VOICES = 10_000

Gender = Literal["male", "female", ""]
_GENDERS: dict[int, Gender] = {1: "male", 2: "female"}


class Event(IntEnum):
    """The events of the library while it speaks."""

    END = 0
    WORD = 1
    SENTENCE = 2
    PHONEME = 7


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


class _Voice(ctypes.Structure):
    _fields_ = [
        ("name", ctypes.c_char_p),
        ("languages", ctypes.c_char_p),
        ("identifier", ctypes.c_char_p),
        ("gender", ctypes.c_ubyte),
        ("age", ctypes.c_ubyte),
        ("variant", ctypes.c_ubyte),
        ("unused", ctypes.c_ubyte),
        ("score", ctypes.c_int),
        ("spare", ctypes.c_void_p),
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
    """0 to 100: from half of the voice's own pitch to double."""
    volume: int = 100
    """Percent, 0 to 200."""
    range: int = 50
    """0 to 99: from no melody to twice the voice's own."""


@dataclass(frozen=True, slots=True)
class Mark:
    """Something that begins in the sound."""

    kind: Event
    position: int
    """Characters of the text before it."""
    sample: int
    """Samples of the sound before it."""
    name: str = ""
    """Mnemonic of a phoneme; `_:` and the like are pauses, the last one ends the text."""


@dataclass(frozen=True, slots=True)
class VoiceName:
    """A voice that the library can speak with."""

    id: str
    """What to ask for: "en-us"; of a variant, what follows the "+": "f3"."""
    name: str
    """What people call it: "English (America)"."""
    gender: Gender


Take = Callable[[bytes, list[Mark]], bool]
"""Gets each block of sound (16 bit, mono) with what begins in it; says whether to go on."""


class EspeakLibrary:
    """Speaks; its methods may be called from any thread.

    The library keeps the phase of its vibrato from one sentence to the next, and more of a voice
    than it should when it changes to another, so the same text would be a little different each
    time. It is therefore loaded again after every text, which takes some 2 ms that nobody waits
    for, and before one in another voice: the same text gives the same samples and times,
    but for the breath of variants such as "+f3".
    """

    def __init__(self, path: str, data_path: bytes | None) -> None:
        self.rate = 0
        """Samples a second."""
        self._path = path
        self._data_path = data_path
        self._lock = threading.Lock()
        self._voice: str | None = None
        self._is_fresh = False
        self._files: dict[str, str] = {}
        self._library = self._load()

    def has_voice(self, voice: str) -> bool:
        """Whether a voice such as "en-us" or "en-us+f3" is there."""
        # A variant that is not there would be left out without a word.
        _, plus, variant = voice.partition("+")
        speakers = {known.id for known in self.variants()}
        if plus and variant not in speakers:
            return False
        if voice.casefold() in {speaker.casefold() for speaker in speakers}:
            return False  # a variant without a language, which would be taken and fail
        with self._lock:
            return self._choose(voice)

    def voices(self) -> tuple[VoiceName, ...]:
        """All voices, by language."""
        with self._lock:
            self._is_fresh = False
            return tuple(voice for _, voice in _voices(self._library, None))

    def variants(self) -> tuple[VoiceName, ...]:
        """What can follow the "+" of a voice: other speakers of the same language."""
        with self._lock:
            self._is_fresh = False
            listed = _voices(self._library, _Voice(languages=b"variant"))
            return tuple(replace(voice, id=file.rpartition("/")[2]) for file, voice in listed)

    def speak(self, text: str, setting: Setting, take: Take, *, has_phonemes: bool = False) -> None:
        """Make the sound of a text, block by block, until `take` wants no more.

        `has_phonemes`: what stands in [[ ]] is mnemonics. Whatever else the text holds must be
        free of control characters, with which the library takes orders.
        """
        failure: list[BaseException] = []

        def block(samples: Any, count: int, events: Any) -> int:
            try:
                sound = ctypes.string_at(samples, count * 2) if samples and count > 0 else b""
                return 0 if take(sound, list(_marks(events))) else 1
            except BaseException as error:  # must not pass through C
                failure.append(error)
                return 1

        callback = _Callback(block)
        data = text.encode() + b"\0"
        flags = _UTF8 | (_SPELT_PHONEMES if has_phonemes else 0)
        with self._fresh(setting.voice) as library:
            library.espeak_SetSynthCallback(callback)
            library.espeak_SetParameter(_RATE, setting.rate, 0)
            library.espeak_SetParameter(_PITCH, setting.pitch, 0)
            library.espeak_SetParameter(_RANGE, setting.range, 0)
            library.espeak_SetParameter(_VOLUME, setting.volume, 0)
            library.espeak_Synth(data, len(data), 0, 1, 0, flags, None, None)
        if failure:
            raise failure[0]

    def phonemes_of(self, word: str, voice: str = "en-us") -> list[str]:
        """The mnemonics of a word, stress marks included."""
        with self._lock:
            self._choose(voice)
            text_to_phonemes = self._library.espeak_TextToPhonemes
            text_to_phonemes.restype = ctypes.c_char_p
            rest = ctypes.c_char_p(word.replace("\0", " ").encode())
            # The mode asks for mnemonics with "_" between them.
            spelt = text_to_phonemes(ctypes.byref(rest), _UTF8, ord("_") << 8)
            return (spelt or b"").decode().replace("_", " ").split()

    def ipa_of(self, text: str, voice: str) -> list[str]:
        """The words of a text in the International Phonetic Alphabet, stress marks included."""
        with self._lock:
            self._choose(voice)
            text_to_phonemes = self._library.espeak_TextToPhonemes
            text_to_phonemes.restype = ctypes.c_char_p
            rest = ctypes.c_char_p(text.replace("\0", " ").encode())
            words: list[str] = []
            while rest.value:  # a clause each time
                spelt = text_to_phonemes(ctypes.byref(rest), _UTF8, _IPA)
                words += (spelt or b"").decode(errors="replace").split()
            return words

    @contextmanager
    def _fresh(self, voice: str) -> Iterator[ctypes.CDLL]:
        """The library as if nothing had been said; the next one is made ready afterwards."""
        with self._lock:
            if not self._is_fresh or voice != self._voice:
                self._renew(voice)
            try:
                yield self._library
            finally:
                self._renew(voice)

    def _renew(self, voice: str) -> None:
        self._library.espeak_Terminate()
        _unload(self._library)
        self._library = self._load()
        self._voice = None
        self._choose(voice)
        self._is_fresh = True

    def _load(self) -> ctypes.CDLL:
        library = ctypes.CDLL(self._path)
        options = _PHONEME_EVENTS | _NO_EXIT
        self.rate = library.espeak_Initialize(_SYNCHRONOUS, _BLOCK_MS, self._data_path, options)
        if self.rate <= 0:
            raise NotAvailable("espeak-ng finds no voices - install espeakng-loader again")
        return library

    def _choose(self, voice: str) -> bool:
        """Change to a voice, if there is such a one."""
        if voice == self._voice:
            return True
        self._is_fresh = False
        name, plus, variant = voice.partition("+")
        if not self._set(voice):
            # By name it knows files; some have another name than their language: en-gb is "en".
            file = self._files_by_language().get(name.lower())
            if file is None or not self._set(f"{file}{plus}{variant}"):
                return False
        self._voice = voice
        return True

    def _set(self, name: str) -> bool:
        return bool(self._library.espeak_SetVoiceByName(name.encode()[:_LONGEST_NAME]) == 0)

    def _files_by_language(self) -> dict[str, str]:
        if not self._files:
            self._files = {v.id.lower(): file for file, v in _voices(self._library, None)}
        return self._files


def _unload(library: ctypes.CDLL) -> None:
    unload = getattr(_ctypes, "dlclose", None) or _ctypes.FreeLibrary  # type: ignore[attr-defined]
    unload(library._handle)


def _marks(events: Any) -> Iterator[Mark]:
    for event in events:
        if event.type == Event.END:
            return
        position = max(event.text_position - 1, 0)
        if event.type == Event.PHONEME:
            name = event.id.string.decode(errors="replace")
            yield Mark(Event.PHONEME, position, event.sample, name)
        elif event.type in (Event.WORD, Event.SENTENCE):
            yield Mark(Event(event.type), position, event.sample)


def _voices(library: ctypes.CDLL, wanted: _Voice | None) -> Iterator[tuple[str, VoiceName]]:
    """The file of each voice, and what it is called."""
    library.espeak_ListVoices.restype = ctypes.POINTER(ctypes.POINTER(_Voice))
    listed = library.espeak_ListVoices(ctypes.byref(wanted) if wanted else None)
    for number in range(_MOST_VOICES):
        if not listed[number]:
            return
        voice = listed[number].contents
        # The first byte of the languages is the voice's rank among those of the first one.
        language, name, file = (
            text.decode(errors="replace")
            for text in (voice.languages[1:], voice.name, voice.identifier)
        )
        yield file, VoiceName(language, name, _GENDERS.get(voice.gender, ""))


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

        return espeakng_loader.get_library_path(), os.fsencode(espeakng_loader.get_data_path())
    except (ImportError, OSError):
        found = ctypes.util.find_library("espeak-ng")
        if found is None:
            raise NotAvailable("espeak-ng is missing - pip install espeakng-loader") from None
        return found, None
