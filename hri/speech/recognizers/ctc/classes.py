"""The classes that sound is told apart by."""

from __future__ import annotations

from hri.speech.pronunciation.phones import PHONES

CLASSES = ("blank", *PHONES)
"""What a frame can be: nothing new (silence, or the phone before goes on), or a phone."""
