"""Quiet voices are heard, and what is not quiet stays as it is."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.signals import Rejection, Utterance
from hri.hal.drivers.recording_level import loudest
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.automatic_level import LOUD_DB, MOST_DB, AutomaticLevel, too_quiet
from hri.speech.grammar import load_grammar
from hri.speech.hearing import hear
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.recognizers.ctc.loudness import USUAL_DB, leveled, speech_level
from hri.speech.understanding import understand
from tests.recorded import BOOK, ORDERS, spoken_by_a_person

RATE, FRAME = 16000, 320


@pytest.fixture(scope="module")
def engine():
    recognizer = CtcRecognizer(Description("ears", "Hri.Ctc"), ResourceManager((), FakeClock()))
    recognizer.activate()
    grammar = load_grammar("companion")
    recognizer.start(grammar)
    yield recognizer, grammar
    recognizer.deactivate()


@pytest.fixture(scope="module")
def hearing(engine):
    """What the companion hears in a recording."""
    recognizer, grammar = engine
    return lambda sound: list(hear(sound, RATE, recognizer, grammar))


def quieter(sound, db, seed=0):
    """As a sound card gives it: rounded to steps of 16 bits, which make a noise of their own."""
    dither = np.random.default_rng(seed).random(len(sound)) - 0.5
    return np.rint(sound * 10.0 ** (db / 20) + dither).astype(np.int16)


@pytest.mark.parametrize("db", [-20, -30, -40, -50, -60])
def test_a_quiet_recording_is_heard_as_surely_as_a_loud_one(hearing, db):
    sound = spoken_by_a_person("goforward")
    (loud,) = hearing(sound)
    (quiet,) = hearing(quieter(sound, db))
    assert isinstance(quiet, Utterance)
    assert (quiet.text, quiet.tags) == (loud.text, loud.tags)
    assert quiet.confidence > 0.9
    assert quiet.level_db == pytest.approx(loud.level_db + db, abs=1.5)


@pytest.mark.parametrize("db", [-30, -45])
def test_a_microphone_that_is_turned_down_is_heard_after_a_while(engine, db):
    recognizer, grammar = engine
    quiet = np.zeros(20 * RATE)
    voice = spoken_by_a_person("goforward")
    sound = quieter(np.concatenate([quiet, voice, quiet[: 2 * RATE]]), db)
    pieces = []
    for first in range(0, len(sound), 1000):
        pieces += recognizer.listen(sound[first : first + 1000], (first + 1000) / RATE)
    pieces += recognizer.flush()
    heard = [understand(recognizer, grammar, piece, 0.5, None) for piece in pieces]
    assert [one.text for one in heard if isinstance(one, Utterance)] == ["go forward ten meters"]
    assert heard[0].level_db < -40


@pytest.mark.parametrize("db", [-30, -50])
def test_quiet_speech_of_others_does_not_become_a_command(hearing, db):
    for name in (*BOOK[:2], *ORDERS[:5]):
        assert not any(
            isinstance(o, Utterance) for o in hearing(quieter(spoken_by_a_person(name), db))
        )


@pytest.mark.parametrize("db", [-30, -50, -70, -90])
def test_noise_does_not_become_a_command(hearing, db):
    white = np.random.default_rng(0).normal(size=5 * RATE) * 32768
    pink = np.fft.irfft(np.fft.rfft(white) / np.sqrt(np.arange(len(white) // 2 + 1) + 1)) * 50
    swelling = white * np.repeat(np.random.default_rng(1).random(50), RATE // 10) ** 3
    for noise in (white, pink, swelling):
        assert not any(isinstance(one, Utterance) for one in hearing(quieter(noise, db)))


def test_what_is_too_quiet_to_be_understood_says_so(hearing):
    murmur = quieter(spoken_by_a_person(BOOK[0]), -60)
    found = hearing(murmur)
    assert found
    for one in found:
        assert isinstance(one, Rejection)
        assert (
            one.detail
            == f"very quiet ({one.level_db:.0f} dBFS) - speak up, or raise the input level"
        )
    assert loudest(murmur, RATE) == pytest.approx(max(one.level_db for one in found), abs=2)
    assert too_quiet(-30.0) == too_quiet(None) == ""
    assert too_quiet(-120.0).startswith("no sound at all - unmute")


def stream(sound):
    """A sound as the automatic level gives it."""
    level, out = AutomaticLevel(), []
    for frame in sound[: len(sound) // FRAME * FRAME].reshape(-1, FRAME):
        power = np.var(frame.astype(float)) / 32768**2
        out.append(level.take(frame, 10 * np.log10(max(power, 1e-12))))
    return np.concatenate(out)


@given(st.floats(-120, -5), st.floats(-100, -5), st.integers(0, 99))
def test_nothing_becomes_louder_than_a_quiet_voice_and_nothing_quieter(noise, voice, seed):
    chance = np.random.default_rng(seed)
    parts = [10 ** (db / 20) * chance.normal(size=RATE) for db in (noise, voice, noise, voice)]
    sound = (np.concatenate(parts) * 32768).clip(-32768, 32767).astype(np.int16)
    heard = stream(sound)
    frames, before = heard.reshape(-1, FRAME).astype(float), sound.reshape(-1, FRAME).astype(float)
    after_db = 10 * np.log10(np.maximum(frames.var(axis=1), 1e-9) / 32768**2)
    before_db = 10 * np.log10(np.maximum(before.var(axis=1), 1e-9) / 32768**2)
    assert (after_db <= np.maximum(before_db, LOUD_DB) + 1).all()
    assert (np.abs(frames) >= np.abs(before)).all()
    assert (np.abs(frames) <= np.abs(before) * 10 ** (MOST_DB / 20) + 1).all()


def test_in_a_room_with_noise_nothing_is_changed():
    chance = np.random.default_rng(0)
    sound = np.concatenate([chance.normal(0, 25, RATE), chance.normal(0, 200, RATE)])
    assert np.array_equal(stream(sound.astype(np.int16)), sound.astype(np.int16))


def test_while_the_level_is_held_it_only_falls_and_nothing_is_learned():
    level, frame = AutomaticLevel(), np.ones(FRAME, np.int16)

    def gain(db, frames=1):
        for _ in range(frames):
            level.take(frame, db)
        return level.gain_db

    before = gain(-85.0, 1000)
    assert before == pytest.approx(20.0, abs=1.0)
    level.is_held = True
    assert gain(-105.0, 500) == before
    assert gain(-45.0) == pytest.approx(5.0)
    assert gain(-85.0, 500) == pytest.approx(5.0)
    level.is_held = False
    assert gain(-85.0) == pytest.approx(before, abs=0.1)


@given(st.floats(-100, 0))
def test_the_network_gets_speech_of_a_usual_level(db):
    voice = np.random.default_rng(0).normal(0, 3000, RATE) * 10 ** (db / 20)
    sound = voice.astype(np.int16)
    level = speech_level(sound)
    steps = leveled(sound)
    assert level < USUAL_DB or np.array_equal(steps, sound)
    if USUAL_DB - 60 < level < USUAL_DB:
        assert speech_level(steps) == pytest.approx(USUAL_DB, abs=0.1)
