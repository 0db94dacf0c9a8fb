"""The voice, as set on the command line."""

from __future__ import annotations

from hri.core.errors import AuthoringError, HriError
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.synthesizers.voice_names import HEART, voice_named

PLAIN_VOICE = HEART
NO_FILE = Description("", "").place.path
"""Place of mistakes on the command line."""


def open_voice(resources: ResourceManager, name: str, rate: int | None = None) -> Synthesizer:
    """The voice of a name at a rate in words a minute. Raises HriError when there is none."""
    parameters = {} if rate is None else {"rate_wpm": str(rate)}
    voice: Synthesizer
    name = voice_named(name) or name
    if name == HEART:
        voice = NaturalVoice(Description("voice", "Hri.NaturalVoice", parameters), resources)
    else:
        parameters["voice"] = name
        voice = EspeakVoice(Description("voice", "Hri.EspeakVoice", parameters), resources)
    resources.substitute("voice", voice)
    try:
        voice.activate()
    except AuthoringError as error:
        if error.place.path != NO_FILE:
            raise
        raise HriError(f"{error.what} - {error.remedy}") from error
    return voice
