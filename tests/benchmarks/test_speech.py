import numpy as np
import pytest
from hypothesis import given, strategies as st

from benchmarks.speech import accuracy, barge_in, conditions
from benchmarks.speech.accuracy import MEASURES, outside
from benchmarks.speech.kitchen import kitchen
from benchmarks.speech.levels import above, active_power, frame_powers
from benchmarks.speech.manners import MANNERS
from hri.bench.speech import flite_voices, samples
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import Hearing
from hri.bench.speech.samples import ORDERS, ROBOT, Recordings
from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse
from hri.speech.synthesizers.natural import NaturalVoice
from tests.bench.heard import noise, piece


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
    orders = tuple(noise(f"orders/{n}", slots={"coffeeDrink": "latte"}) for n in range(8))
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
    told = list(accuracy.rows(people, credulous, step=9, progress=str))[: len(MEASURES)]
    assert not any(row["passed"] for row in told)
    made_up = next(row for row in told if row["what"].startswith("sentences outside"))
    assert made_up["count"] == made_up["of"]
    assert '"stop" accepted' in made_up["clips"][0]


@pytest.mark.usefixtures("_silent_flite")
def test_rows_without_recordings_say_why_they_are_skipped():
    told = list(accuracy.rows(None, perfect, step=9, progress=str))[: len(MEASURES)]
    measured = [row["what"] for row in told if "skipped" not in row]
    assert measured == [m.name for m in MEASURES if m.condition == "clean"][:3]
    assert all("--recordings" in row["skipped"] for row in told if "skipped" in row)


def test_rows_without_flite_say_how_to_install_it(people, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    told = list(accuracy.rows(people, perfect, step=9, progress=str))
    needed = [measure.kind in ("commands", "outside") for measure in MEASURES]
    for row, is_of_flite in zip(told, needed, strict=False):
        assert ("apt install flite" in row.get("skipped", "")) == is_of_flite


def test_every_clip_keeps_its_own_pieces_though_they_are_heard_in_batches():
    said = [noise(str(n), str(n), seconds=0.01) for n in range(3 * accuracy.BATCH + 1)]

    def echo(grammar, batch, engine=""):
        return Hearing([[piece(clip.sentence)] for clip in batch], 0.0)

    assert all(outcome.is_right for outcome in accuracy.hear(ROBOT, said, echo))


@pytest.mark.parametrize("draw", [103, 109, 116])
def test_the_first_words_of_its_voice_are_not_obeyed_and_a_stop_word_over_them_is(draw):
    interruption = barge_in.interrupted(NaturalVoice, -12.0, draw)

    assert interruption.obeyed == 0
    assert interruption.delay < 0.6
