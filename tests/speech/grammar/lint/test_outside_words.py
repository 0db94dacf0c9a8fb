from __future__ import annotations

import itertools
import time
from pathlib import Path

import pytest

from hri.speech.grammar import load_grammar
from hri.speech.grammar.lint.linter import check
from hri.speech.grammar.lint.outside_words import beside, heard_as_listed, value_lists
from hri.speech.pronunciation.lexicon import load_lexicon


@pytest.fixture(scope="module")
def lexicon():
    return load_lexicon()


@pytest.fixture
def written(tmp_path):
    """The grammar of some rules, and of lists beside it by their names."""

    def written(rules: str, **lists: str):
        for name, lines in lists.items():
            (tmp_path / f"{name}.txt").write_text(lines, encoding="utf-8")
        path: Path = tmp_path / "house.jsgf"
        path.write_text(f"#JSGF V1.0 UTF-8 en;\ngrammar house;\n{rules}", encoding="utf-8")
        return load_grammar(path)

    return written


def rules(*things: str) -> str:
    entries = " | ".join(f"{thing} {{thing={thing}}}" for thing in things)
    return f"public <bring> = bring me the <thing>;\n<thing> = {entries};\n"


def test_words_that_sound_like_an_entry_are_beside_it(written, lexicon):
    grammar = written(rules("pencil", "mug", "box"))
    found = {near.word: near for near in beside(value_lists(grammar), lexicon)}

    words = dict(found["pencil"].outside)
    assert {"cancel", "temple"} <= words.keys()
    assert list(words.values()) == sorted(words.values())
    assert max(words.values()) <= 0.25
    assert (found["mug"].tag, found["mug"].entry.value) == ("thing", "mug")
    assert found["mug"].rule.key == "thing"


def test_what_is_listed_is_not_outside(written, lexicon):
    grammar = written(rules("pencil", "temple"))
    found = {near.word: dict(near.outside) for near in beside(value_lists(grammar), lexicon)}
    assert "temple" not in found["pencil"]


def test_a_list_of_people_is_compared_with_first_names(written, lexicon):
    grammar = written(
        'import "friends.txt" as <friend>;\npublic <call> = please call <friend>;\n',
        friends="Sarah\nMarco\nLeo\nAnna\nNina\n",
    )
    found = {near.word: dict(near.outside) for near in beside(value_lists(grammar), lexicon)}
    assert "farah" in found["sarah"]
    assert "sara" not in found["sarah"]  # the same name in other letters
    assert not {"market", "motto"} & found["marco"].keys()

    (hint,) = heard_as_listed(grammar, lexicon)
    assert hint.severity == "hint"
    assert str(hint).startswith(f"{grammar.path.with_name('friends.txt')}:1:1: hint: ")
    assert '"farah" as "sarah"' in hint.what


def test_one_value_is_no_list(written):
    grammar = written("public <stop> = (stop | halt | enough | end | wait) {stop};\n")
    assert value_lists(grammar) == []


def test_check_tells_what_is_one_near_phone_away(written, lexicon):
    (hint,) = heard_as_listed(written(rules("coat", "pencil", "mug", "box", "spoon")), lexicon)
    assert '"goat" as "coat"' in hint.what
    assert "pencil" not in hint.what  # all words beside it differ in two phones


def test_check_leaves_out_few_values_and_other_authors(written, lexicon):
    assert list(heard_as_listed(written(rules("coat", "pencil", "mug")), lexicon)) == []
    imported = "import <numbers.small>;\npublic <wait> = wait for <small> minutes {n=$number};\n"
    assert list(heard_as_listed(written(imported), lexicon)) == []


@pytest.mark.slow
def test_ten_thousand_names_are_checked_in_two_seconds(written, lexicon):
    shipped = Path(__file__).resolve().parents[4] / "grammars" / "first_names.txt"
    lines = shipped.read_text(encoding="utf-8").splitlines()
    names = [line for line in lines if line and not line.startswith("#")]
    pairs = [f"{one} {other}" for one, other in itertools.pairwise(names)]
    grammar = written(
        'import "friends.txt" as <friend>;\npublic <call> = please call <friend>;\n',
        friends="\n".join([*names, *pairs][:10_000]),
    )
    assert any(found.severity == "hint" for found in check(grammar, lexicon))

    start = time.process_time()
    list(heard_as_listed(grammar, lexicon))
    assert time.process_time() - start < 2.0
