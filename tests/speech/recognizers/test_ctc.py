"""The default engine hears what its grammar allows, and hardly anything else."""

from __future__ import annotations

import threading
import wave

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import HriError, NotAvailable
from hri.hal.manager import ResourceManager
from hri.hal.recognizer import Segment
from hri.hal.resource import Description
from hri.speech.grammar import load_grammar
from hri.speech.recognizers.ctc.confidence import confidence, margin, scores_of, shares
from hri.speech.recognizers.ctc.lattice import Path, Span
from hri.speech.recognizers.ctc.recognizer import CtcRecognizer
from tests.speech.conftest import RECORDINGS
from tests.speech.recognizers.speaking import spoken
from tests.speech.recognizers.word_graphs import random_scores

needs_recordings = pytest.mark.skipif(
    not RECORDINGS.is_dir(), reason="the recordings of people are not on this machine"
)
ACCEPTED = 0.5
QUIET = np.zeros(8000, np.int16)


@pytest.fixture(scope="module")
def engine(companion):
    manager = ResourceManager((), FakeClock())
    recognizer = CtcRecognizer(Description("ears", "Hri.Ctc"), manager)
    recognizer.activate()
    recognizer.start(companion)
    yield recognizer
    recognizer.deactivate()
    manager.close()


def piece(samples, number=1):
    return Segment(0.0, len(samples) / 16000, samples, number=number)


def said(text):
    return np.concatenate([QUIET, spoken(text), QUIET])


def recording(name):
    with wave.open(str(RECORDINGS / name)) as file:
        return np.frombuffer(file.readframes(file.getnframes()), np.int16)


@pytest.mark.parametrize(
    "text",
    [
        "go forward",
        "please come with me",
        "turn left ninety degrees",
        "turn around",
        "what is your name",
        "go to sleep",
        "come here",
        "yes please",
        "stop",
        "yes",
        "no",
    ],
)
def test_a_command_is_heard(engine, text):
    hypothesis = engine.decode(piece(said(text)))
    assert hypothesis.text == text
    assert hypothesis.confidence >= ACCEPTED


@pytest.mark.parametrize(
    "text", ["the weather in november is terrible", "university", "my sister lives in boston"]
)
def test_other_talk_is_not(engine, text):
    assert engine.decode(piece(said(text))).confidence < ACCEPTED


@needs_recordings
def test_a_person_is_heard_by_the_robot(engine, companion, write):
    grammar = load_grammar(
        write("public <go> = go (forward | back) (one | two | ten | eleven) (meters | feet);")
    )
    engine.start(grammar)
    hypothesis = engine.decode(piece(recording("robot/goforward.wav")))
    engine.start(companion)
    assert hypothesis.text == "go forward ten meters"
    assert hypothesis.confidence >= ACCEPTED


def test_words_have_times_in_order_within_the_sound(engine):
    sound = said("please come with me")
    words = engine.decode(piece(sound)).words
    assert [word.text for word in words] == ["please", "come", "with", "me"]
    times = [time for word in words for time in (word.start, word.end)]
    assert times == sorted(times)
    assert times[0] > 0.4
    assert times[-1] < len(sound) / 16000 - 0.3


def test_what_else_it_may_have_been_is_told(engine):
    hypothesis = engine.decode(piece(said("turn left fifteen degrees")))
    others = [alternative.text for alternative in hypothesis.alternatives]
    assert "turn left fifty degrees" in others
    assert hypothesis.text not in others
    assert sum(alternative.share for alternative in hypothesis.alternatives) < 1.0


def test_words_come_while_it_is_spoken_and_the_end_is_the_same(engine):
    sound = said("please come with me")
    partial = [engine.advance(piece(sound[:end], number=7)) for end in range(0, len(sound), 3200)]
    assert "please" in partial
    assert partial[-1].startswith("please come")
    assert engine.decode(piece(sound, number=7)) == engine.decode(piece(sound, number=8))


def test_the_words_are_there_when_the_pause_is_over(engine, monkeypatch):
    sound = said("please come with me")
    open_piece = Segment(3.0, 3.0 + len(sound) / 16000, sound, number=9, quiet=0.3)
    longer = np.concatenate([sound, np.zeros(4800, np.int16)])
    ended = Segment(3.0, 3.3 + len(sound) / 16000, longer, number=9, quiet=0.6)

    engine.advance(open_piece)
    monkeypatch.setattr(engine, "_network", None)  # What is asked again would fail.

    assert engine.decode(ended).text == "please come with me"


def test_what_is_said_after_a_pause_counts(engine):
    first = said("please come")
    both = np.concatenate([first, said("with me")])

    engine.advance(Segment(0.0, len(first) / 16000, first, number=9, quiet=0.4))
    hypothesis = engine.decode(Segment(0.0, len(both) / 16000, both, number=9, quiet=0.4))

    assert hypothesis.text == "please come with me"


def test_a_rule_that_is_not_active_is_not_heard(engine):
    sound = piece(said("stop"))
    assert engine.decode(sound, {"stop"}).text == "stop"
    other = engine.decode(sound, {"follow", "come"})
    assert other.text != "stop"
    assert other.confidence < ACCEPTED
    assert engine.decode(sound, set()).text == ""


@pytest.mark.parametrize(
    "samples",
    [np.zeros(0, np.int16), np.zeros(100, np.int16), np.zeros(32000, np.int16)],
    ids=["nothing", "less than a window", "silence"],
)
def test_no_sound_is_no_command(engine, samples):
    assert engine.decode(piece(samples)).confidence < ACCEPTED


def test_the_old_grammar_stays_when_the_new_one_is_refused(engine, write):
    with pytest.raises(HriError, match="no word"):
        engine.start(load_grammar(write("public <nothing> = <NULL>;")))
    assert engine.decode(piece(said("stop"))).text == "stop"


def test_a_grammar_may_change_while_another_piece_is_decoded(engine, companion):
    sound = piece(said("please come with me"))
    changing = threading.Thread(target=lambda: [engine.start(companion) for _ in range(5)])
    changing.start()
    texts = {engine.decode(sound).text for _ in range(5)}
    changing.join()
    assert texts == {"please come with me"}


def test_without_a_grammar_nothing_is_decoded(resources):
    recognizer = CtcRecognizer(Description("ears", "Hri.Ctc"), resources)
    recognizer.activate()
    assert recognizer.advance(piece(QUIET)) == ""
    with pytest.raises(NotAvailable, match="grammar"):
        recognizer.decode(piece(QUIET))


@given(st.integers(0, 2**32 - 1), st.integers(1, 20))
def test_scores_count_from_the_likeliest_class(seed, frames):
    scores = scores_of(random_scores(seed, frames))
    assert (scores.max(axis=1) == 0.0).all()
    assert (scores <= 0.0).all()


@given(st.lists(st.floats(-1000, 0), min_size=1, max_size=8))
def test_shares_are_chances(scores):
    chances = shares(scores)
    assert abs(chances.sum() - 1.0) < 1e-6
    assert chances.argmax() in np.flatnonzero(np.array(scores) >= max(scores) - 1e-9)


@given(st.floats(-50, 50), st.floats(-50, 50))
def test_what_fits_hardly_better_than_other_words_is_trusted_less(one, other):
    low, high = sorted([one, other])

    assert 0.0 <= confidence(low) <= confidence(high) <= 1.0


def test_a_margin_counts_by_the_root_of_the_phones():
    word = Span(0, 0, 6, (0, 0, -1, 1, 2, -3))
    states = (3, 3, -4, 3, 4, 5, 6, 7, 8, 9)

    assert margin(Path(-4.0, ("go",), (word,)), -10.0) == pytest.approx(6.0 / 3**0.5)
    both = (word, Span(1, 6, 16, states))
    assert margin(Path(-4.0, ("go", "on"), both), -10.0) == pytest.approx(6.0 / 11**0.5)
