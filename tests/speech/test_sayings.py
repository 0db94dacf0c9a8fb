"""A name that was said twice."""

from __future__ import annotations

from hypothesis import given, strategies as st

from hri.core import HeardSlot
from hri.speech import both_sayings, without

SOUNDS = {"zorvin": ("Z", "AO"), "sorvin": ("S", "AO"), "torvin": ("T", "AO")}


def heard(**scores):
    """A slot with these readings."""
    texts = sorted(scores, key=lambda text: -scores[text])
    sounds = [SOUNDS.get(text, tuple(text)) for text in texts]
    first, *rest = (scores[text] for text in texts)
    return HeardSlot(
        "name", texts[0], sounds[0], 0.5, tuple(texts[1:]), tuple(sounds[1:]), (first, *rest)
    )


def test_what_fits_both_sayings_is_likelier_than_what_fits_one():
    both = both_sayings(
        heard(zorvin=-10.0, sorvin=-11.0, torvin=-20.0), heard(torvin=-10.0, sorvin=-10.5)
    )
    assert (both.text, both.others) == ("sorvin", ("zorvin", "torvin"))


def test_neither_a_refused_text_nor_its_sound_comes_again():
    slot = heard(zorvin=-1.0, sorvin=-2.0)
    assert without(slot, [slot]).text == "sorvin"
    assert without(slot, [slot, heard(sorvin=-1.0)]) is None
    same_sound = HeardSlot("name", "zawrvin", SOUNDS["zorvin"])
    assert without(slot, [same_sound]).text == "sorvin"


READINGS = st.dictionaries(
    st.text("abcde", min_size=1, max_size=3), st.floats(-50.0, 0.0), min_size=1, max_size=6
)


@given(READINGS, READINGS)
def test_no_reading_is_lost_and_the_order_of_the_sayings_does_not_matter(one, other):
    slots = heard(**one), heard(**other)
    both, turned = both_sayings(*slots), both_sayings(*slots[::-1])
    assert {both.text, *both.others} == one.keys() | other.keys()
    assert sorted(both.scores, reverse=True) == [*both.scores]
    assert sorted(both.scores) == sorted(turned.scores)
    assert 0.0 < both.confidence <= 1.0
