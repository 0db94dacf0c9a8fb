"""Where someone only hesitates: "um", "uh", and the like, between pauses.

No grammar lists them, and a sentence does not go on with them, so they are as good as silence.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.conformer import FRAME
from hri.speech.recognizers.ctc.features import Sound
from hri.speech.recognizers.ctc.phone_graph import Floats

VOWELS = frozenset(("AA", "AE", "AH", "AO", "EH", "ER"))
NASALS = frozenset(("M", "N"))
PAUSE = 5
"""Frames of 20 ms that are silent before and after a hesitation."""
LONGEST = 40
"""Frames that one takes at most."""
ACTIVE_DB = 25.0
"""Sound is what is not farther below the loudest frame."""
AROUND = 2
"""Frames by which the network may hear it sooner or later than it sounds."""


def hesitations(sound: Sound, log_probabilities: Floats) -> list[slice]:
    """The frames of each hesitation in a piece of speech, in order.

    `sound` is 16 kHz, `log_probabilities` [frames, classes] what the network makes of it. None are
    found where others talk in the pauses, and where nothing else is said.
    """
    likeliest = log_probabilities.argmax(axis=1)
    parts = list(_parts(sound, len(likeliest)))
    found = [part for part in parts if _is_hesitation(part, likeliest)]
    return found if len(found) < len(parts) else []


def without(log_probabilities: Floats, parts: list[slice]) -> Floats:
    """The same with silence in these frames."""
    silenced = log_probabilities.copy()
    for part in parts:
        silenced[part] = np.log(np.float32(1e-6))
        silenced[part, BLANK] = 0.0
    return silenced


def _parts(sound: Sound, frames: int) -> Iterator[slice]:
    """Where there is sound between pauses, in frames."""
    size = round(FRAME * 16000)
    blocks = sound[: len(sound) // size * size].reshape(-1, size).astype(np.float64)
    powers = (blocks**2).mean(axis=1)
    if not powers.any():
        return
    active = np.flatnonzero(powers >= powers.max() * 10.0 ** (-ACTIVE_DB / 10.0))
    for part in np.split(active, np.flatnonzero(np.diff(active) > PAUSE) + 1):
        yield slice(max(0, int(part[0]) - AROUND), min(frames, int(part[-1]) + 1 + AROUND))


def _is_hesitation(part: slice, likeliest: np.ndarray) -> bool:
    """Whether a part is one vowel at most, and then "m"."""
    if part.stop - part.start > LONGEST:
        return False
    heard = [CLASSES[phone] for phone in likeliest[part] if phone != BLANK]
    phones = [phone for phone, before in zip(heard, ["", *heard], strict=False) if phone != before]
    if phones and phones[0] in VOWELS:
        phones = phones[1:]
    return all(phone in NASALS for phone in phones)
