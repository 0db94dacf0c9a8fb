"""Hesitations between pauses, from what the network makes of them."""

import numpy as np
import pytest

from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.hesitations import hesitations, without

SIZE = 320


def piece(*parts):
    """Sound and log probabilities of parts: phones that sound, each for some frames, or a pause."""
    sound, classes = [], []
    for phones in parts:
        if isinstance(phones, int):
            sound.append(np.zeros(phones * SIZE))
            classes += [BLANK] * phones
            continue
        for phone in phones.split():
            sound.append(np.full(4 * SIZE, 3000.0))
            classes += [CLASSES.index(phone), BLANK, BLANK, BLANK]
    log_probabilities = np.full((len(classes), len(CLASSES)), -9.0, np.float32)
    log_probabilities[np.arange(len(classes)), classes] = 0.0
    return np.concatenate(sound).astype(np.float32), log_probabilities


@pytest.mark.parametrize("um", ["AH M", "AH", "ER", "M", "AH N", "AA M", "AE M N"])
def test_one_vowel_and_a_nasal_between_pauses_is_a_hesitation(um):
    sound, heard = piece("G OW", 10, um, 10, "L EH F T")

    (part,) = hesitations(sound, heard)

    assert part.start == 16
    silent = without(heard, [part]).argmax(axis=1)
    assert (silent[part] == BLANK).all()
    assert (np.delete(silent, np.r_[part]) == np.delete(heard.argmax(axis=1), np.r_[part])).all()


@pytest.mark.parametrize(
    "parts",
    [
        ("G OW", 10, "OW", 10, "L EH F T"),  # "oh"
        ("G OW", 10, "Y EH S", 10, "L EH F T"),
        ("G OW", 3, "AH M", 3, "L EH F T"),  # no pause around it
        ("G OW", 10, "AH M AH", 10, "L EH F T"),
        ("AH M", 10, "AH"),  # nothing else
        (40,),
    ],
)
def test_all_else_is_said(parts):
    assert hesitations(*piece(*parts)) == []
