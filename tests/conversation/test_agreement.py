"""Words and gestures that contradict the face that is shown."""

import pytest

from hri.conversation.agreement import MERRY, PLEASANT, UNPLEASANT, face_for, suits
from hri.conversation.idle_acts import load_idle_acts
from hri.face.model import load_face
from hri.face.motion.gesture_tracks import load_gestures
from hri.face.vocabulary import EXPRESSIONS


@pytest.mark.parametrize(
    ("words", "shown", "wanted"),
    [
        ("I love hearing that!", "scared", "happy"),
        ("I love hearing that!", "happy", ""),
        ("I'm sorry it was like that. It's over soon.", "happy", "sad"),
        ("I'm sorry it was like that. It's over soon.", "sad", ""),
        ("I feel a little down. Will you tell me something nice?", "sad", ""),
        ("Are you sad?", "happy", ""),
        ("Turning left.", "angry", ""),
        ("I am happy.", "neutral", ""),
        ("", "sad", ""),
    ],
)
def test_the_face_follows_words_that_it_would_contradict(
    words: str, shown: str, wanted: str
) -> None:
    assert face_for(words, shown) == wanted


def test_it_does_not_laugh_in_sorrow_and_nods_in_any_mood() -> None:
    assert not suits("laugh", "sad")
    assert not suits("wink", "angry")
    assert suits("laugh", "happy")
    assert suits("nod", "sad")
    assert suits("wink", "")


def test_the_lists_name_what_there_is() -> None:
    assert set(EXPRESSIONS) >= PLEASANT | UNPLEASANT
    assert not PLEASANT & UNPLEASANT
    gestures = load_gestures(load_face("robot"))
    assert set(gestures) >= MERRY
    merry = {act.name for act in load_idle_acts().acts.values() if act.gesture in MERRY}
    glad = {name for name in merry if "sadness" in load_idle_acts().acts[name].feelings}
    assert not glad, "no merry act in sorrow"
