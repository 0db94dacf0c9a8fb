from __future__ import annotations

import numpy as np
import pytest

from hri.hal.word_graph import SpokenSlot
from hri.speech.pronunciation.dictionary import cmu_dictionary
from hri.speech.pronunciation.guesses import Guesses
from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon
from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.lattice import Path, WordSpan
from hri.speech.recognizers.ctc.spoken_words import SpokenWords, sound_of

NAMES = ("anna", "maria", "peter", "siobhan")
SLOT = "<name.spoken 1-2>"


def heard_as(phones, unclear=-9.0):
    """[frames, classes] Scores of phones, each in a frame of its own between blanks."""
    rows = np.full((2 * len(phones) + 1, len(CLASSES)), unclear, np.float32)
    rows[0::2, BLANK] = 0.0
    rows[range(1, len(rows), 2), [CLASSES.index(phone) for phone in phones]] = 0.0
    return rows


def path_of(*words):
    """Words with their numbers of frames."""
    spans, start = [], 0
    for _, frames in words:
        spans.append(WordSpan(0, start, start + frames, (0,) * frames))
        start += frames
    return Path(0.0, tuple(word for word, _ in words), tuple(spans))


def name_in(phones, taught=(), unclear="", lexicon=None, **limits):
    """The slot behind "is" in a sound of phones, each of which may be the `unclear` one as well."""
    slots = {SLOT: SpokenSlot("name", 1, 2, NAMES, **limits)}
    lexicon = lexicon or load_lexicon()
    scores = heard_as(["IH", "Z", *phones.split()])
    for phone in unclear.split():
        scores[5::2, CLASSES.index(phone)] = np.maximum(scores[5::2, CLASSES.index(phone)], -3.0)
    path = path_of(("is", 4), (SLOT, len(scores) - 4))
    known = {"name": tuple((text, tuple(said.split())) for text, said in taught)}
    return SpokenWords(slots, lexicon, lexicon).heard(path, scores, known).get(1)


def test_a_listed_word_is_heard_though_a_phone_is_unclear():
    slot = name_in("P IY D ER", unclear="T")
    assert (slot.name, slot.text, slot.phones) == ("name", "peter", ("P", "IY", "T", "ER"))
    assert 0.0 < slot.confidence <= 1.0


def test_a_word_of_no_list_is_spelled():
    slot = name_in("Z AO R V IH N")
    assert (slot.text, slot.phones) == ("zorvin", ("Z", "AO", "R", "V", "IH", "N"))


def test_what_else_it_may_be_sounds_otherwise():
    slot = name_in("Z AO R V IH N")
    assert len(slot.others) == len(slot.others_phones) > 0
    assert len({slot.phones, *slot.others_phones}) == 1 + len(slot.others)
    assert len({slot.text, *slot.others}) == 1 + len(slot.others)


def test_two_known_words_are_two():
    assert name_in("AE N AH M ER IY AH").text == "anna maria"


def test_what_people_taught_is_known_by_their_phones():
    taught = [("zhorvyn", "Z AO R V AH N")]
    slot = name_in("Z AO R V IH N", taught)
    assert slot.text == "zhorvyn"


def test_nothing_of_what_people_said_is_written_to_disk(tmp_path):
    guesses = tmp_path / "guesses.txt"
    lexicon = Lexicon({}, cmu_dictionary(), guesses=Guesses(guesses))
    taught = [("zhorvyn", "Z AO R V AH N")]
    assert name_in("Z AO R V IH N", taught, lexicon=lexicon).text == "zhorvyn"
    assert not guesses.exists() or "zhorvyn" not in guesses.read_text()


@pytest.mark.parametrize(
    ("limits", "allowed"),
    [
        ({"letters": (2, 5)}, lambda text: len(text) <= 5),
        ({"like": "x*"}, lambda text: text[0] == "x"),
    ],
)
def test_what_the_author_does_not_allow_is_not_heard(limits, allowed):
    slot = name_in("Z AO R V IH N", **limits)
    assert all(map(allowed, () if slot is None else (slot.text, *slot.others)))


def test_the_word_before_may_take_a_frame_more_or_less():
    """ "is" ends where the sound says so, not where the slot was cut."""
    lexicon = load_lexicon()
    scores = heard_as(["IH", "Z", "AE", "N", "AH"])
    slots = SpokenWords({SLOT: SpokenSlot("name", 1, 1, NAMES)}, lexicon, lexicon)
    for cut in (3, 4, 5, 6):
        path = path_of(("is", cut), (SLOT, len(scores) - cut))
        assert slots.heard(path, scores, {})[1].text == "anna"


def test_a_word_behind_is_none_of_it():
    lexicon = load_lexicon()
    scores = heard_as([*("P", "IY", "T", "ER"), *("N", "AW")])
    slots = SpokenWords({SLOT: SpokenSlot("name", 1, 1, NAMES)}, lexicon, lexicon)
    path = path_of((SLOT, 8), ("now", len(scores) - 8))
    assert slots.heard(path, scores, {})[0].text == "peter"


def test_words_beside_count_in_all_their_ways():
    rows = heard_as(["IH", "Z"])
    one, two = (sound_of(rows, ways) for ways in ([("IH", "Z")], [("IH", "Z"), ("Z",)]))
    assert one.come[-1] > 0.9
    assert np.all(two.come >= one.come)
    assert one.gone[-1] == 1.0
    assert one.gone[:-1].max() == 0.0
