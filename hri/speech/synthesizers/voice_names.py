"""What a voice may be called: by its name, a language in words, a speaker, or a character."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from hri.core.errors import did_you_mean
from hri.speech.synthesizers.espeak_library import load_espeak

HEART = "heart"
"""The natural voice: an American woman."""
_LANGUAGES_FIRST = ("en-us", "es", "fr-fr", "pt", "zh", "fa")
"""The voices that a language in words means where it has several."""


@dataclass(frozen=True, slots=True)
class Character:
    """How a voice sounds."""

    voice: str
    about: str


CHARACTERS = {
    "warm": Character(HEART, "a warm woman"),
    "plain": Character("en-us", "a man of espeak-ng"),
    "gentleman": Character("en-gb-x-rp", "a man from southern England"),
    "scot": Character("en-gb-scotland", "a man from Scotland"),
    "deep": Character("en-us+david", "a deep man"),
    "bright": Character("en-us+f4", "a bright woman"),
    "child": Character("en-us+anika", "a small girl"),
    "grandma": Character("en-us+grandma", "an old woman"),
    "grandpa": Character("en-us+grandpa", "an old man"),
    "robot": Character("en-us+robosoft", "a machine"),
    "whisper": Character("en-us+whisper", "a person who whispers"),
}


@lru_cache(maxsize=64)
def voice_named(wanted: str) -> str:
    """The voice that is meant; empty for none on this machine.

    Of several, with a space between, it is the first that is here. Raises NotAvailable.
    """
    found = _voice_of(wanted)
    if not found and " " in wanted:
        found = next(filter(None, map(_voice_of, wanted.split())), "")
    return found


def _voice_of(wanted: str) -> str:
    library = load_espeak()
    wanted = CHARACTERS[wanted].voice if wanted in CHARACTERS else wanted
    spoken = wanted.casefold()
    fitting = [voice.id for voice in library.voices() if tongue(voice.name) == spoken]
    if fitting:
        return min(fitting, key=lambda id: (id not in _LANGUAGES_FIRST, len(id)))
    speakers = [speaker.id for speaker in library.variants() if speaker.id.casefold() == spoken]
    if speakers:
        return f"{_LANGUAGES_FIRST[0]}+{speakers[0]}"
    return wanted if wanted == HEART or library.has_voice(wanted) else ""


def unknown(wanted: str) -> str:
    """The mistake in a name that matches no voice, and its remedy."""
    library = load_espeak()
    ids = [voice.id for voice in library.voices()]
    tongues = {tongue(voice.name) for voice in library.voices()}
    near = did_you_mean(wanted, [HEART, *CHARACTERS, *ids, *tongues], "`hri voices` lists them")
    return f'no voice "{wanted}" - {near}'


def tongue(name: str) -> str:
    """The language of a voice's name, in words: "english" of English (America)."""
    return name.casefold().partition(" (")[0]
