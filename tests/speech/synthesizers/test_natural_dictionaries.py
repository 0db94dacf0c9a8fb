"""The packed dictionaries answer as those that they are made of."""

import pytest
from hypothesis import given, strategies as st

pytest.importorskip("hibari")
from hri.speech.synthesizers.natural_dictionaries import Packed, Pronouncer

KEYS = st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=8)
VALUES = st.text(max_size=8) | st.dictionaries(st.text(max_size=3), st.floats(-9, 9), max_size=3)


@given(st.dictionaries(KEYS, VALUES), st.text(max_size=8))
def test_every_entry_is_found_and_nothing_else(entries, other):
    packed = Packed(entries)
    assert {key: packed.get(key) for key in entries} == entries
    assert packed.get(other) == entries.get(other)


@pytest.mark.slow
def test_it_reads_as_hibari_does():
    from hibari.g2p import G2P

    packed, plain = Pronouncer(), G2P()
    for text in ("I read the 2 books that I will read.", "Gandalf's zorblatt costs $5.", "é…<"):
        assert packed(text) == plain(text)
