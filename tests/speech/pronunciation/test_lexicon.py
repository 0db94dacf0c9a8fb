from __future__ import annotations

import os
import stat

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.speech.pronunciation import guesses
from hri.speech.pronunciation.dictionary import cmu_dictionary
from hri.speech.pronunciation.guesses import Guesses
from hri.speech.pronunciation.lexicon import (
    VARIABLE,
    VARIANTS,
    add_to_lexicon,
    load_lexicon,
    read_lexicon,
    read_phones,
    user_lexicon,
)
from hri.speech.pronunciation.phones import PHONES, without_stress


@pytest.fixture
def lexicon():
    return load_lexicon()


def test_words_of_the_dictionary_have_all_their_variants_the_likeliest_first(lexicon):
    assert lexicon.pronunciations("read") == (("R", "EH", "D"), ("R", "IY", "D"))
    assert lexicon.pronunciations("a") == (("AH",), ("EY",))
    assert lexicon.origin("read") == "dictionary"
    assert "read" in lexicon


def test_what_many_say_and_the_dictionary_leaves_out_comes_after_its_own(lexicon):
    assert lexicon.pronunciations("almond") == (
        ("AA", "M", "AH", "N", "D"),
        ("AO", "L", "M", "AH", "N", "D"),
        ("AE", "L", "M", "AH", "N", "D"),
        ("AE", "M", "AH", "N", "D"),
    )
    assert lexicon.origin("almond") == "dictionary"


def test_variants_are_of_words_that_the_dictionary_knows_otherwise():
    dictionary = cmu_dictionary()
    for word, variants in read_lexicon(VARIANTS).items():
        usual = dictionary.pronunciations(word)
        assert usual, word
        assert not set(usual) & set(variants), word


def test_every_word_of_the_dictionary_is_found_in_its_file():
    dictionary = cmu_dictionary()
    lines = dictionary._lines[:].splitlines()
    names = [line.split()[0].partition(b"(")[0].decode() for line in lines]
    for name in (names[0], names[-1], *names[5::97]):
        assert name in dictionary
        assert dictionary.pronunciations(name)
    some = dictionary.pronunciations(names[1000])
    assert {phone for phones in some for phone in without_stress(phones)} <= set(PHONES)


@given(st.text(max_size=20))
def test_any_text_may_be_looked_up(text):
    dictionary = cmu_dictionary()
    assert (text in dictionary) == bool(dictionary.pronunciations(text))


def test_writing_a_word_in_another_way_does_not_hide_it(lexicon):
    assert lexicon.pronunciations("Robot") == lexicon.pronunciations("robot")
    curly = lexicon.pronunciations("don\N{RIGHT SINGLE QUOTATION MARK}t")
    assert curly == lexicon.pronunciations("don't")


@pytest.mark.parametrize(
    ("word", "phones"),
    [
        ("kubernetes's", "IH Z"),
        ("malleable's", "M AE L IY AH B AH L Z"),
        ("robot-cat", "R OW B AA T K AE T"),
    ],
)
def test_words_made_of_known_ones_are_said_like_them(lexicon, word, phones):
    assert " ".join(lexicon.pronunciations(word)[0]).endswith(phones)
    assert lexicon.origin(word) == "guessed"


def test_other_words_are_guessed(lexicon):
    assert lexicon.pronunciations("zorblax")[0][:1] == ("Z",)
    assert lexicon.origin("zorblax") == "guessed"
    assert "zorblax" not in lexicon
    assert lexicon.known("zorblax") == ()


@pytest.mark.parametrize("word", ["", "...", "친구", "日本", "приве́т"])
def test_what_nobody_can_say_is_refused(lexicon, word):
    with pytest.raises(HriError, match="nobody knows how"):
        lexicon.pronunciations(word)


def test_the_user_s_lexicon_comes_first(tmp_path):
    path = tmp_path / "mine.txt"
    path.write_text("# our cat\nRobot  R OW0 B AH1\n; another way\nrobot(2) R UW B OW\n")

    lexicon = load_lexicon(path)

    assert lexicon.pronunciations("robot") == (("R", "OW", "B", "AH"), ("R", "UW", "B", "OW"))
    assert lexicon.of_user("robot") == ("R", "OW0", "B", "AH1")
    assert lexicon.origin("robot") == "user"
    assert lexicon.of_user("cat") == ()


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("robot R OWW", '2:9: no phone "OWW" - did you mean "OW"?'),
        ("robot", "2:1: no phones - write some such as R OW B AA T for robot"),
        ("robot R1", '2:7: no phone "R1" - did you mean "R"?'),
        ("robot " + "AH " * 61, "2:1: too many phones"),
    ],
)
def test_a_mistake_in_a_lexicon_has_its_place(tmp_path, line, message):
    path = tmp_path / "mine.txt"
    path.write_text(f"cat K AE T\n{line}\n")

    with pytest.raises(AuthoringError) as error:
        read_lexicon(path)
    assert str(error.value).startswith(f"{path}:{message}")


def test_a_word_has_not_any_number_of_variants(tmp_path):
    path = tmp_path / "mine.txt"
    path.write_text("".join(f"cat K AE T {phone}\n" for phone in PHONES))

    with pytest.raises(AuthoringError, match=r":9:1: .*more than 8 pronunciations"):
        read_lexicon(path)


def test_a_lexicon_that_is_named_must_be_there(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "none.txt"))

    with pytest.raises(HriError, match="cannot read this lexicon"):
        load_lexicon()


def test_a_word_that_is_added_is_known_from_then_on():
    add_to_lexicon(user_lexicon(), "Zorblax", read_phones("z ao1 r"))
    assert load_lexicon().pronunciations("zorblax") == (("Z", "AO", "R"),)


def test_what_is_added_takes_the_place_of_what_was_there(tmp_path):
    path = tmp_path / "mine.txt"
    path.write_text("# zorb is ours\nzorb Z AO1\ncat K AE T\n\nZorb(2) Z AA # or so\n")
    before = add_to_lexicon(path, "zorb", ("Z", "OW"), ("Z", "OW1"), ("Z", "OW"))

    assert before == (("Z", "AO1"), ("Z", "AA"))
    assert path.read_text() == "# zorb is ours\ncat K AE T\n\nzorb  Z OW\nzorb  Z OW1\n"
    assert [entry.name for entry in tmp_path.iterdir()] == ["mine.txt"]


def test_nothing_is_added_to_a_lexicon_with_a_mistake(tmp_path):
    path = tmp_path / "mine.txt"
    path.write_text("cat K AE T")
    add_to_lexicon(path, "dog", ("D", "AO", "G"))
    assert path.read_text() == "cat K AE T\ndog  D AO G\n"

    path.write_text("cat QQ\n")
    with pytest.raises(AuthoringError):
        add_to_lexicon(path, "dog", ("D", "AO", "G"))
    with pytest.raises(HriError, match="not a single word"):
        add_to_lexicon(path, "two words", ("D",))


def test_a_lexicon_is_not_filled_beyond_what_can_be_read(tmp_path):
    path = tmp_path / "mine.txt"
    add_to_lexicon(path, "cat", *(("K", "AE", phone) for phone in PHONES[:8]))
    with pytest.raises(HriError, match="more than 8 pronunciations"):
        add_to_lexicon(path, "Cat", *(("K", "AE", phone) for phone in PHONES[:9]))

    assert len(read_lexicon(path)["cat"]) == 8


def test_a_word_that_would_be_read_as_another_is_not_added(tmp_path):
    with pytest.raises(HriError, match="not a single word"):
        add_to_lexicon(tmp_path / "mine.txt", "zo(rk", ("Z",))


class TestGuesses:
    def test_a_word_is_asked_for_once_for_ever(self, tmp_path, monkeypatch):
        path = tmp_path / "cache" / "words.txt"
        asked = []

        def guess(word):
            asked.append(word)
            return (("Z", "AO"), ("Z", "AA"))

        monkeypatch.setattr(guesses, "guesses", guess)
        first, second = Guesses(path), Guesses(path)
        assert first["zorb"] == first["zorb"] == second["zorb"] == (("Z", "AO"), ("Z", "AA"))
        assert asked == ["zorb"]

    def test_a_pipe_in_its_place_keeps_nobody(self, tmp_path):
        path = tmp_path / "words.txt"
        os.mkfifo(path)

        assert Guesses(path)["zorb"][0][0] == "Z"

    @pytest.mark.parametrize(
        "damage", [b"\xff\xfe\0", b"zorb\n", b"zorb\tXX\n", b"zorb\t\n", b"\t\t\t", b"zor"]
    )
    def test_damage_costs_only_time(self, tmp_path, damage):
        path = tmp_path / "words.txt"
        path.write_bytes(damage)

        assert Guesses(path)["zorb"][0][0] == "Z"

    def test_it_needs_no_place_to_write(self, tmp_path):
        (tmp_path / "file").write_text("")

        assert Guesses(tmp_path / "file" / "words.txt")["zorb"][0][0] == "Z"

    def test_it_does_not_grow_without_end(self, tmp_path, monkeypatch):
        monkeypatch.setattr(guesses, "LARGEST_CACHE", 100)
        monkeypatch.setattr(guesses, "guesses", lambda word: (("Z", "AO"),))
        path = tmp_path / "words.txt"
        for number in range(100):
            Guesses(path)[f"word{number}"]
        assert path.stat().st_size < 150


def test_only_its_owner_can_read_which_words_were_looked_up(tmp_path):
    cache = tmp_path / "guesses.txt"
    Guesses(cache)["quillobrand"]
    assert stat.S_IMODE(cache.stat().st_mode) == 0o600
    cache.chmod(0o644)
    assert Guesses(cache)["quillobrand"]
    assert stat.S_IMODE(cache.stat().st_mode) == 0o600


def test_a_lexicon_that_somebody_else_may_have_written_is_not_used(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.delenv(VARIABLE, raising=False)
    add_to_lexicon(user_lexicon(), "zorb", ("Z", "AO"))
    assert load_lexicon().known("zorb") == (("Z", "AO"),)
    user_lexicon().chmod(0o666)
    with pytest.raises(HriError, match=r"lexicon.txt: someone else may have written this lexicon"):
        load_lexicon()
