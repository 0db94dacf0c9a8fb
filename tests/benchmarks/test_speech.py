from collections import Counter
from functools import partial
from itertools import islice

import numpy as np
import pytest
from hypothesis import given, strategies as st

from benchmarks.speech import (
    accuracy,
    answers,
    barge_in,
    conditions,
    no_motion,
    others,
    peers,
    printed,
)
from benchmarks.speech.accuracy import MEASURES, outside
from benchmarks.speech.kitchen import kitchen
from benchmarks.speech.levels import above, active_power, frame_powers
from benchmarks.speech.manners import MANNERS
from benchmarks.speech.texts import blocks
from hri.bench.speech import flite_voices, samples
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import Hearing
from hri.bench.speech.samples import ORDERS, ROBOT, Recordings
from hri.bench.table import at_most, share, skipped
from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse
from tests.bench.heard import noise, piece

pytestmark = pytest.mark.slow


def test_no_sentence_from_outside_is_in_the_grammar():
    robot = load_grammar(ROBOT)
    assert len(outside()) == 42
    assert [sentence for sentence in outside() if parse(robot, sentence)] == []


@given(st.floats(-5, 30), st.floats(0.05, 1.0), st.integers(0, 100))
def test_speech_stands_above_babble_by_the_ratio_that_was_asked_for(ratio, loudness, seed):
    chance = np.random.default_rng(seed)
    speech = np.zeros(RATE, np.int16)
    speech[3200:12800] = chance.normal(0, 3000 * loudness, 9600)
    noise = chance.normal(0, 1, RATE)
    mixture = above(speech, noise, ratio).astype(np.float64)
    assert np.abs(mixture).max() <= 32000
    heard_noise = np.mean(mixture[:3200] ** 2) / np.mean(noise[:3200] ** 2)
    heard_speech = active_power(mixture[3200:12800]) - heard_noise
    gain = heard_speech / active_power(speech.astype(np.float64))
    assert 10 * np.log10(heard_speech / heard_noise) == pytest.approx(ratio, abs=2.0)
    assert gain <= 1.2


@pytest.mark.parametrize("condition", ["12 dB", "6 dB in a kitchen"])
def test_each_draw_of_the_noise_is_another_one_and_always_the_same(people, condition):
    said = [conditions.padded(clip) for clip in people.orders]

    def heard(draw):
        mixed = conditions.heard_in(condition, said, people.orders, draw)
        return np.concatenate([clip.samples for clip in mixed])

    assert np.array_equal(heard(1), heard(1))
    assert not np.array_equal(heard(0), heard(1))
    assert not np.array_equal(heard(1), heard(2))


def test_a_kitchen_is_never_still_and_now_and_then_loud(people):
    talkers = [clip.samples for clip in people.orders]
    sound = kitchen(talkers, 10 * RATE, np.random.default_rng(3))
    powers = 10 * np.log10(frame_powers(sound))
    assert powers.max() - np.median(powers) > 6.0
    assert np.median(powers) - powers.min() < 25.0


def test_silence_has_no_active_power():
    assert active_power(np.zeros(RATE)) == 0.0


@pytest.fixture
def people():
    """Recordings of nobody."""
    orders = tuple(noise(f"orders/{n}", slots={"coffeeDrink": "latte"}) for n in range(17))
    return Recordings(orders, (noise("read/1", "he might"),))


@pytest.fixture
def _silent_flite(monkeypatch):
    monkeypatch.setattr(
        flite_voices, "say", lambda sentence, voice: noise(sentence, sentence).samples
    )


def perfect(grammar, said, engine=""):
    """Hears what is of the grammar, and nothing else."""
    heard = []
    for clip in said:
        is_order = bool(clip.slots) and grammar == ORDERS
        is_command = clip.sentence in samples.commands()
        words = piece(clip.sentence, {"coffeeDrink": "latte"} if is_order else {})
        heard.append([words] if is_order or is_command else [])
    return Hearing(heard, 0.0)


def credulous(grammar, said, engine=""):
    """Hears the same command in everything."""
    return Hearing([[piece("stop")] for _ in said], 0.0)


@pytest.mark.usefixtures("_silent_flite")
def test_who_hears_right_passes_every_row(people):
    told = list(accuracy.rows(people, perfect, step=9, progress=str))
    named = [measure.name for measure in MEASURES]
    assert [row["what"] for row in told[: len(named)]] == named
    assert [row["what"].rpartition(" ")[2] for row in told[len(named) :]] == list(MANNERS)
    assert all(row.get("passed", True) for row in told)
    assert {row["rate"] for row in told} == {0.0, 1.0}


@pytest.mark.usefixtures("_silent_flite")
def test_who_accepts_everything_fails_every_row(people):
    told = list(islice(accuracy.rows(people, credulous, step=9, progress=str), len(MEASURES)))
    assert not any(row["passed"] for row in told)
    made_up = next(row for row in told if row["what"].startswith("sentences outside"))
    assert made_up["count"] == made_up["of"]
    assert '"stop" accepted' in made_up["clips"][0]


@pytest.mark.usefixtures("_silent_flite")
def test_rows_without_recordings_say_why_they_are_skipped():
    told = list(islice(accuracy.rows(None, perfect, step=9, progress=str), len(MEASURES)))
    measured = [row["what"] for row in told if "skipped" not in row]
    assert measured == [m.name for m in MEASURES if m.condition == "clean"][:3]
    assert all("--recordings" in row["skipped"] for row in told if "skipped" in row)


def test_rows_without_flite_say_how_to_install_it(people, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    told = islice(accuracy.rows(people, perfect, step=9, progress=str), len(MEASURES))
    needed = [measure.kind in ("commands", "outside") for measure in MEASURES]
    for row, is_of_flite in zip(told, needed, strict=True):
        assert ("apt install flite" in row.get("skipped", "")) == is_of_flite


def test_every_clip_keeps_its_own_pieces_though_they_are_heard_in_batches():
    said = [noise(str(n), str(n), seconds=0.01) for n in range(3 * accuracy.BATCH + 1)]

    def echo(grammar, batch, engine=""):
        return Hearing([[piece(clip.sentence)] for clip in batch], 0.0)

    assert all(outcome.is_right for outcome in accuracy.hear(ROBOT, said, echo))


@pytest.mark.parametrize("draw", [103, 109, 116])
def test_the_first_words_of_its_voice_are_not_obeyed_and_a_stop_word_over_them_is(draw):
    interruption = barge_in.interrupted(barge_in.NATURAL, -12.0, draw)

    assert interruption.obeyed == ()
    assert interruption.delay < 0.6


def test_sentences_have_the_heading_above_them():
    found = list(blocks("phrases.txt"))
    assert found[0][0] != ""
    assert ("near", "be cheerful my dear") in found
    assert not any(text.startswith("#") or text.endswith(":") for _, text in found)


def test_the_first_answer_in_what_was_heard_is_what_a_sentence_was_taken_for():
    def taken_for(*heard):
        return answers.Try("yes", "yes please", "slt", heard).answer

    yes, no = piece("yes", rule="yes"), piece("no", rule="no")
    assert taken_for(yes, no) == "yes"
    assert taken_for(piece("stop", rule="stop"), no) == "no"
    assert taken_for(piece("yes", rule="yes", is_accepted=False)) == ""
    assert taken_for() == ""


def test_a_turn_that_moves_the_base_is_reported_and_so_are_those_after_it():
    moving, careful = no_motion.life(["turn left", "follow me", "turn right"])
    assert [told.partition(" - ")[0] for told in moving] == ["turn left", "turn right"]
    assert [told.partition(" - ")[0] for told in careful] == [
        "turn left",
        "follow me",
        "turn right",
    ]


def test_dialogs_have_two_who_take_turns():
    for name, count in Counter(name for name, _ in blocks("dialogs.txt")).items():
        assert count >= 8, name


@pytest.mark.parametrize("kind", ["people", "dialogs", "talk"])
def test_a_minute_of_talk_is_always_the_same_and_another_one_is_different(
    people, kind, monkeypatch
):
    voices = {name: partial(_said, name) for name in others.TALKERS}
    monkeypatch.setattr(others, "TALKERS", voices)
    first, again, next_but_one = (others.talk(people, others.Minute(kind, n)) for n in (0, 0, 2))
    assert np.array_equal(first.sound, again.sound)
    assert not np.array_equal(first.sound, next_but_one.sound)
    if kind != "people":
        assert 60 <= len(first.sound) / RATE < 64
    middle = (first.ends[0] + first.ends[1]) / 2
    assert first.said(middle, middle) == first.sentences[1]
    assert first.said(0.1, middle) == " / ".join(first.sentences[:2])


def _said(voice, text):
    return noise(f"{voice}/{text}", text, seconds=0.06 * len(text)).samples


def test_the_robot_replies_with_what_needs_nothing_to_be_filled_in():
    assert "Hello! How nice." in others.replies()
    assert "Did you sleep well?" in others.replies()
    assert not any("{" in reply for reply in others.replies())


def test_a_table_has_the_figure_the_limit_and_whether_it_is_met():
    missed = printed.line(share("motions begun, typed", 3, 300, at_most(0)))
    words = "MISSED motions begun, typed 3 of 300 (1.0 %) at most 0 %"
    assert " ".join(missed.split()) == words
    assert printed.line(skipped("speaking", "flite is not installed")).endswith("not installed")


def test_hassil_takes_the_same_sentences():
    pytest.importorskip("hassil", reason="hassil is not installed")
    find = peers.finder(load_grammar(ROBOT))
    assert find("robot go to the door") is not None
    assert find("robot sing to the door") is None
