"""Names are said as the robot hears them, words of several sounds by those around them."""

# ruff: noqa: RUF001 - symbols of sounds are meant.
from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.speech.pronunciation.heteronyms import heteronyms
from hri.speech.pronunciation.letter_to_sound import PHONES as PHONES_OF_MNEMONICS
from hri.speech.pronunciation.lexicon import Lexicon, load_lexicon
from hri.speech.pronunciation.names import first_names
from hri.speech.pronunciation.phones import without_stress
from hri.speech.synthesizers.espeak_text import reading
from hri.speech.synthesizers.natural_symbols import MNEMONICS, STRESSES, symbols_of
from tests.speech.pronunciation.test_heteronyms import is_right, sentences

hibari = pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")

FREQUENT = Path(__file__).with_name("frequent_names.txt").read_text(encoding="utf-8").split()
"""The most frequent first names of the United States, 1990 (Census Bureau), and newer ones."""


def likened(phones: str) -> str:
    """Phones without stress, as they are told apart in names: "er r" and "uh r" are one."""
    sounds = " ".join(without_stress(tuple(phones.split())))
    for written, alike in ((r"\bER R\b", "ER"), (r"\bAH R\b", "ER"), (r"\b(AH|IH)\b", "@")):
        sounds = re.sub(written, alike, sounds)
    return re.sub(r"@ (?=[LN]\b)", "", sounds).replace("AO", "AA")


def sounds_of(mnemonics) -> str:
    table = {**PHONES_OF_MNEMONICS, "t#": "T"}
    return likened(" ".join(table[name] for name in mnemonics if not name.startswith("_")))


@cache
def as_dictionary(word: str) -> set[str]:
    return {likened(" ".join(phones)) for phones in lexicon().known(word)}


@cache
def lexicon() -> Lexicon:
    return load_lexicon()


def said(reader, text: str) -> list[str]:
    """The sounds of each word of a sentence."""
    [sentence] = reader.sentences(text)
    words = [""] * len(text.split())
    for symbol, number in zip(sentence.symbols, sentence.words, strict=True):
        words[number] += symbol if symbol in MNEMONICS else ""
    return [sounds_of(MNEMONICS[symbol] for symbol in word) for word in words]


@pytest.mark.parametrize(
    ("frame", "place"),
    [
        ("Hello {name} how are you?", 1),
        ("{name} is in the kitchen.", 0),
        ("HELLO {capitals} HOW ARE YOU?", 1),
        ("my name is {small}", 3),
        ('She said "{name} was here."', 2),
    ],
)
def test_names_are_said_as_the_dictionary_says(reader, frame, place):
    right = 0
    for name in FREQUENT:
        text = frame.format(name=name, capitals=name.upper(), small=name.lower())
        right += said(reader, text)[place] in as_dictionary(name)
    assert right >= 0.98 * len(FREQUENT)


def test_hri_say_says_names_as_they_are_heard(capsys):
    names = FREQUENT[::12]
    assert main(["say", f"Hello {', '.join(names)}.", "--phonemes", "-"]) == 0
    times = json.loads(capsys.readouterr().out)
    for name, word in zip(names, times["words"][1:], strict=True):
        within = [p for p in times["phonemes"] if word["start"] <= p["start"] < word["end"] - 1e-6]
        assert sounds_of(phoneme["name"] for phoneme in within) in as_dictionary(name), name


def test_every_first_name_can_be_said(reader):
    assert all(lexicon().spoken(name) for name in first_names())


@pytest.mark.parametrize(
    ("written", "symbols"),
    [
        ("Karen", "kˈɛɹən"),
        ("Michelle", "mɪʃˈɛl"),
        ("Katie", "kˈATi"),
        ("José", "hˌOzˈA"),
        ("JOSÉ", "hˌOzˈA"),
        ("Zoë", "zˈOi"),
        ("Hermione", "həɹmˈIəni"),
        ("Ethan's", "ˈiθənz"),
        ("Zoë\N{RIGHT SINGLE QUOTATION MARK}s", "zˈOiz"),
        ("Margaret's", "mˈɑɹɡəɹɪts"),
        ("Gomez's", "ɡˈOmɛzɪz"),
        ("Ethans", "ˈiθənz"),
        ("Karens'", "kˈɛɹənz"),
        ("Anne-Marie", "ˈænməɹˈi"),
        ("Marie-Chloe", "məɹˈiklˈOi"),
        ("McAllister", "məkˈæləstəɹ"),
        ("McEthan", "məkˈiθən"),
        ("O'Connor's", "Okˈɑnəɹz"),
        ("O'Ethan", "Oˈiθən"),
        ("Łukasz", "wˈukɑʃ"),
        ("Søren", "sˈɔɹən"),
        ("Ethan'd", "ˈiθənd"),
        ("Karen\N{RIGHT SINGLE QUOTATION MARK}ll", "kˈɛɹənᵊl"),
        ("Анна", "ˈænə"),
        ("Иван", "ˈIvən"),
    ],
)
def test_forms_of_names_are_said_like_the_names(reader, written, symbols):
    [sentence] = reader.sentences(f"This is {written}, I think.")
    spoken = sentence.symbols.split()[2]
    assert re.sub(r"[^\w\u02c8\u02cc]", "", spoken).replace("ˌO", "O") == symbols.replace("ˌO", "O")


@pytest.mark.parametrize(
    ("text", "word", "symbols"),
    [
        ("The shaman was there.", 1, "ʃˈɑmən"),
        ("Kanji is hard.", 0, "kˈɑnʤi"),
        ("I work for NASA.", 3, "nˈæsə"),
        ("Plug in the USB cable.", 3, "jˌuˌɛsbˈi"),
    ],
)
def test_words_that_are_no_names_stay_with_the_voice(reader, text, word, symbols):
    [sentence] = reader.sentences(text)
    assert sentence.symbols.split()[word].rstrip(".") == symbols


def test_a_sentence_in_capitals_is_not_spelled(reader):
    loud = "I MET MILES AND US TWO AT THE USB PLUG"
    small = "I met Miles and us two at the USB plug"
    assert said(reader, loud) == said(reader, small)


def test_words_that_are_written_alike_are_told_apart(reader):
    wrong = []
    for expected, words, place in sentences():
        text = " ".join(words)
        [sentence] = reader.sentences(re.sub(r" (?=[.,!?])", "", text))
        right = [
            symbols_of(reading.phones)
            for reading in heteronyms().get(words[place]) or heteronyms()[words[place].lower()]
            if is_right(expected, reading.phones)
        ]
        number = len(re.sub(r" (?=[.,!?])", "", " ".join(words[:place])).split())
        symbols = "".join(
            symbol
            for symbol, of in zip(sentence.symbols, sentence.words, strict=True)
            if of == number and (symbol in MNEMONICS or symbol in STRESSES)
        )
        if symbols not in right:
            wrong.append(f"{text}: {symbols}, not {right}")
    assert len(wrong) <= 0.05 * len(sentences()), "\n".join(wrong)


def test_the_other_voice_says_names_likewise():
    text = reading("I saw Ethan, José and Karen's red ball.", lexicon()).text
    assert re.findall(r"\[\[(.*?)\]\]", text) == ["'i:|T|@|n", "h|,oU|z|'eI", "k|'E|r|@|n|z"]


def test_the_other_voice_tells_words_apart_likewise():
    text = reading("The pipe is made of lead, and they lead on.", lexicon()).text
    assert re.findall(r"\[\[(.*?)\]\]", text) == ["l|'E|d", "l|'i:|d"]


@pytest.mark.parametrize(
    "text", ["I \u136dI", "$5\u0130 is a price", "\u3063 and \u30fc", "-\u0130"]
)
def test_odd_signs_leave_a_sentence_to_the_other_voice_or_are_read(reader, text):
    for sentence in reader.sentences(text):
        assert len(sentence.symbols) == len(sentence.words)
