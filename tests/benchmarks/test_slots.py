from pathlib import Path

import numpy as np
import pytest

from benchmarks.speech import slot_clips, slots
from benchmarks.speech.conditions import CONDITIONS
from benchmarks.speech.pink import pink
from benchmarks.speech.slot_clips import LEVELS, SPOKEN, Saying, grammar, meaning
from benchmarks.speech.slot_dump import Dump, Listened, dumped, file_name
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.samples import Clip
from hri.core.signals import Rejection, Utterance
from hri.hal.recognizer import Segment
from hri.speech.grammar.matching import parse

SENTENCE = "turn on the lamp in the kitchen"


def sentences(set_, kind):
    """What is said of one kind, without its sound."""
    drawn = slot_clips._outside(set_) if kind == "outside" else slot_clips._inside(set_)
    return [saying.clip.sentence for saying in drawn]


def said(sentence, kind="inside", same=None):
    found = parse(grammar("house"), sentence)
    meant = None if found is None else meaning("house", found.rule, found.tags)
    clip = Clip(sentence, np.zeros(RATE, np.int16), sentence)
    return Saying(clip, "house", kind, "clean", meant, same)


def understood(sentence):
    found = parse(grammar("house"), sentence)
    return Utterance(sentence, found.rule, found.tags, 0.9)


def of(saying, *heard):
    return slots.verdict(Listened(saying, (), heard))


@pytest.mark.parametrize("set_", SPOKEN)
def test_the_sentences_are_in_and_outside_of_the_grammar_as_they_are_said_to_be(set_):
    inside, outside = (sentences(set_, kind) for kind in ("inside", "outside"))
    assert len(inside) == slot_clips.INSIDE
    assert len(outside) >= 150
    assert all(parse(grammar(set_), sentence) for sentence in inside)
    assert [sentence for sentence in outside if parse(grammar(set_), sentence)] == []


def test_what_is_fitted_with_is_not_what_is_measured():
    cafe, house = ({*sentences(s, "inside"), *sentences(s, "outside")} for s in ("cafe", "house"))
    assert not cafe & house
    assert sentences("cafe", "inside") == sentences("cafe", "inside")


def test_a_sentence_is_near_when_only_an_entry_of_a_list_is_missing():
    assert slot_clips.is_near("house", "put the eggs in the fridge")
    assert slot_clips.is_near("house", "look for my blood pressure tablets")
    assert not slot_clips.is_near("house", "i put the keys on the hook")
    near = [text for text in sentences("house", "outside") if slot_clips.is_near("house", text)]
    assert len(near) == 28


def test_every_condition_of_a_level_is_known():
    assert {name for names in LEVELS.values() for name in names} <= CONDITIONS.keys()


def test_pink_noise_has_as_much_power_in_each_octave():
    sound = pink((), 20 * RATE, np.random.default_rng(1))
    power = np.abs(np.fft.rfft(sound)) ** 2
    hertz = np.fft.rfftfreq(len(sound), 1 / RATE)
    octaves = [power[(hertz >= low) & (hertz < 2 * low)].sum() for low in (125, 500, 2000)]
    assert octaves == pytest.approx([octaves[0]] * 3, rel=0.2)


def test_an_utterance_is_right_when_it_means_what_was_said():
    lamp = said(SENTENCE)
    assert of(lamp, understood("switch the lamp on")) == "wrong"
    assert of(lamp, understood("please switch on the lamp in the kitchen")) == "right"
    assert of(lamp, understood(SENTENCE), understood("wait here")) == "wrong"
    assert of(lamp) == of(lamp, Rejection("no speech")) == "rejected"
    assert of(lamp, Rejection("low confidence", unsure=("place",))) == "asked"


def test_a_sentence_outside_counts_as_understood_only_in_words_that_were_marked_as_the_same():
    same = said("go to the armchair").meant
    outside = said("go and wait by the armchair", "outside", same)
    assert of(outside, understood("drive to the armchair")) == "right"
    assert of(outside, understood("go to the chair")) == "wrong"
    assert of(said("go and see", "outside"), understood("go to the chair")) == "wrong"


def test_the_slot_that_is_asked_for_is_the_one_that_was_heard_wrong():
    outside = said("put the eggs in the fridge", "outside")

    def asked(*names):
        heard = Rejection("low confidence", "put the keys in the fridge", unsure=names)
        return slots.names_the_slot(Listened(outside, (), (heard,)))

    assert asked("thing")
    assert asked("thing", "place")
    assert not asked("place")


def test_only_what_was_unsure_is_taken_from_what_is_said_again():
    wanted = {"coffeeDrink": "mocha", "size": "small"}
    order = Saying(Clip("order", np.zeros(0, np.int16)), "orders", "orders", "6 dB", wanted)
    first = Rejection(
        "low confidence", confidence=0.4, sure={"size": "small"}, unsure=("coffeeDrink",)
    )

    def right(**tags):
        again = Utterance("", "order", tags, 0.9)
        noise = Rejection("unlike the sound", "latte", 0.1, unsure=("size",))
        one = Listened(order, (), (noise, first), (), (noise, again))
        return slots.is_right_when_asked(one)

    assert right(coffeeDrink="mocha", size="large")
    assert not right(coffeeDrink="latte", size="small")
    assert not right(size="small")


def test_what_was_kept_is_what_was_heard(tmp_path: Path):
    samples = np.random.default_rng(0).normal(0, 1000, RATE).astype(np.int16)
    segment = Segment(0.5, 1.5, samples, quiet=0.25, level_db=-20.0)
    name = file_name("house", "12 dB")
    dump = Dump(tmp_path, name)
    dump.add(Listened(said(SENTENCE), (segment,), (understood(SENTENCE),)))
    dump.write()
    (one,) = dumped(tmp_path, "house", "12 dB")
    (piece,) = one.pieces
    assert (one.saying.clip.sentence, one.saying.meant) == (SENTENCE, said(SENTENCE).meant)
    assert (piece.start, piece.end, piece.quiet, piece.level_db) == (0.5, 1.5, 0.25, -20.0)
    assert np.array_equal(piece.samples, samples)
    with np.load(tmp_path / f"{name}.npz") as arrays:
        assert arrays["0.0.posteriors"].shape[1] == 40
