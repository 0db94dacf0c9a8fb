"""The classes that sound is told apart by."""

from __future__ import annotations

from hri.speech.pronunciation.phones import PHONES

CLASSES = ("blank", *PHONES)
"""What a frame can be: nothing new (silence, or the phone before goes on), or a phone."""
BLANK = 0
"""Class of the blank."""
FREE = len(CLASSES)
"""Behind the classes of the network: words that nobody listed, all of them, pauses too."""
