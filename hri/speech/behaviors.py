"""The behaviors of speech: ears and mouth."""

from hri.speech.listener import Listener
from hri.speech.voice import Saying, Voice

__all__ = ["Listener", "Saying", "Voice"]
