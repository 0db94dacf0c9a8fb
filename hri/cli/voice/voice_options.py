"""The built-in voice, as set on the command line."""

from __future__ import annotations

from hri.core.errors import AuthoringError, HriError
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.espeak_library import Setting

PLAIN_VOICE = Setting().voice
NO_FILE = Description("", "").place.path
"""Place of mistakes on the command line."""


def open_voice(resources: ResourceManager, name: str, rate: int | None = None) -> EspeakVoice:
    """The voice of a name at a rate in words a minute. Raises HriError when there is none."""
    parameters = {"voice": name}
    if rate is not None:
        parameters["rate_wpm"] = str(rate)
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice", parameters), resources)
    resources.substitute("voice", voice)
    try:
        voice.activate()
    except AuthoringError as error:
        if error.place.path != NO_FILE:
            raise
        raise HriError(f"{error.what} - {error.remedy}") from error
    return voice
