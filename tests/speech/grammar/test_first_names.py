"""The list of first names that a free slot of a name may import."""

import time
from pathlib import Path

import pytest

from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.name_lists import read_known
from hri.speech.pronunciation.lexicon import load_lexicon, without_accents

LIST = Path(__file__).resolve().parents[3] / "grammars" / "first_names.txt"


@pytest.fixture(scope="module")
def names():
    known, errors = read_known(LIST)
    assert not errors
    return known


def test_there_are_five_thousand_single_words_no_two_alike(names):
    assert len({without_accents(name) for name in names}) == len(names) == 5000
    assert all(name.replace("-", "").replace("'", "").isalpha() for name in names)
    assert list(names) == sorted(names, key=lambda name: (without_accents(name), name))


def test_they_are_of_many_origins_and_no_words_of_talk(names):
    assert {"anna", "ed", "siobhan", "mohammed", "nkiruka", "thierry", "jean-claude"} <= {*names}
    assert {"please", "the", "good", "will", "tired", "among"}.isdisjoint(names)


def test_each_has_a_pronunciation(names):
    lexicon = load_lexicon()
    assert all(lexicon.pronunciations(name) for name in names)


def test_a_grammar_that_imports_them_is_as_small_as_without(write):
    rules = "public <a> = my name is <name.spoken 1>;"
    started = time.process_time()
    grammar = load_grammar(write(f'import "first_names.txt" as <name.spoken>;\n{rules}'))
    assert time.process_time() - started < 2.0
    assert len(grammar.graph().slots["<name.spoken 1>"].known) == 5000
    assert set(grammar.graph().words) == {"my", "name", "is", "<name.spoken 1>"}
    assert parse(grammar, "my name is Xyz").tags == {"name": "Xyz"}
