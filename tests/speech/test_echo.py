from __future__ import annotations

import numpy as np
import pytest

from hri.core.signals import Span, Speech
from hri.speech.echo import BLOCK, LEAD, REMEMBERED, EchoCanceller, Leftover, OwnVoice

RATE = 16000


def babble(seconds, seed=1, level=3000.0):
    """Noise that comes and goes like syllables."""
    chance = np.random.default_rng(seed)
    count = round(seconds * RATE)
    loudness = np.abs(np.sin(np.arange(count) * 2 * np.pi * 2 / RATE)) ** 2
    return (level * loudness * chance.normal(size=count)).astype(np.int16)


def in_room(samples, seed=2):
    """As a microphone hears it that stands near the loudspeaker."""
    chance = np.random.default_rng(seed)
    way = np.zeros(2000)
    way[400] = 0.4
    way[400:] += 0.03 * chance.normal(size=1600) * np.exp(-np.arange(1600) / 300)
    return np.convolve(samples, way)[: len(samples)].astype(np.int16)


def level(samples):
    return 10 * np.log10(np.mean(np.square(samples, dtype=np.float64)) + 1e-9)


def test_the_own_voice_is_taken_out_within_seconds():
    played = babble(4.0)
    heard = in_room(played)

    left = EchoCanceller().cancel(heard, played)

    assert level(left[-RATE:]) < level(heard[-RATE:]) - 20


def test_who_speaks_over_it_is_left():
    played, person = babble(6.0), babble(1.0, seed=3, level=1500)
    heard = in_room(played).astype(np.int32)
    heard[4 * RATE : 5 * RATE] += person

    left = EchoCanceller().cancel(heard.astype(np.int16), played)

    kept = left[4 * RATE : 5 * RATE]
    assert level(kept) > level(person) - 3
    assert np.corrcoef(kept, person)[0, 1] > 0.9
    assert level(left[-RATE // 2 :]) < level(in_room(played)[-RATE // 2 :]) - 20


def test_it_does_not_matter_how_the_sound_is_sliced():
    played = babble(1.0)
    heard = in_room(played)
    at_once, sliced = EchoCanceller(), EchoCanceller()

    parts = [sliced.cancel(heard[n : n + 533], played[n : n + 533]) for n in range(0, RATE, 533)]

    together = np.concatenate(parts)
    assert np.array_equal(together, at_once.cancel(heard, played))
    assert len(together) + len(sliced.flush()) == RATE
    assert len(together) % BLOCK == 0


def test_a_voice_that_nobody_hears_takes_nothing_away():
    person = babble(2.0, seed=3)

    left = EchoCanceller().cancel(person, babble(2.0))

    kept = slice(RATE, len(left))
    assert level(left[kept]) > level(person[kept]) - 1


def test_silence_and_full_scale_noise_do_no_harm():
    loud = np.full(RATE, 32767, np.int16)
    loud[::2] = -32768
    canceller = EchoCanceller()

    for heard, played in [(loud, loud), (loud * 0, loud), (loud, loud * 0), (loud * 0, loud * 0)]:
        assert len(canceller.cancel(heard, played)) <= RATE + BLOCK
    assert not canceller.cancel(loud[:512] * 0, loud[:512] * 0).any()


def test_what_was_played_is_known_from_the_position():
    sound = np.arange(RATE, dtype=np.int16)
    voice, speech = OwnVoice(RATE), Speech("count", sound, RATE)
    lead = round(LEAD * RATE)

    first = voice.played(speech, 0.5, 1600, 10.0)
    second = voice.played(speech, 0.62, 1600, 10.1)

    assert first[0] == 8000 - 1600 + lead
    assert second[0] == first[-1] + 1  # a little jitter is none of the sound's
    assert voice.played(speech, 0.9, 1600, 10.4)[0] == 14400 - 1600 + lead
    assert not voice.played(speech, 5.0, 1600, 15.0).any()
    assert not voice.played(None, 0.0, 1600, 16.0).any()


def test_how_much_was_left_is_known_by_the_time():
    loud, soft, leftover = babble(0.1), babble(0.1) // 4, Leftover()
    assert leftover.share(0.0, 1.0) == 1.0

    for tick in range(1, 21):
        leftover.add(loud, loud if tick > 10 else soft, loud, tick / 10)

    assert 0.05 < leftover.share(0.0, 0.8) < 0.07
    assert leftover.share(1.05, 2.0) == 1.0
    assert 0.5 < leftover.share(0.0, 2.0) < 0.6
    leftover.add(loud, loud, loud, 2.0 + REMEMBERED)
    assert leftover.share(0.0, 1.5) == 1.0  # long ago


def test_how_loud_is_what_was_left():
    left = Leftover()
    assert left.level_db(0.0, 1.0) == -120.0
    loud, soft = np.full(1600, 3277, np.int16), np.full(1600, 328, np.int16)
    left.add(loud, loud, loud, 0.1)
    left.add(loud, soft, loud, 1.0)
    assert left.level_db(0.0, 0.2) == pytest.approx(-20.0, abs=0.01)
    assert left.level_db(0.9, 1.0) == pytest.approx(-40.0, abs=0.1)


def test_what_its_voice_leaves_is_told_from_who_is_louder():
    voice, left = babble(8.0), Leftover()
    faint = (in_room(voice) * 0.05).astype(np.int16)
    faint[5 * RATE : 6 * RATE] += babble(1.0, seed=3, level=1500)
    assert left.above_least_db(0.0, 1.0) == np.inf

    for first in range(0, len(voice), 512):
        block = slice(first, first + 512)
        left.add(faint[block], faint[block], voice[block], (first + 512) / RATE)

    assert left.above_least_db(5.0, 6.0) > 20
    assert all(left.above_least_db(start, start + 1.0) < 3 for start in (1, 3, 7))
    left.add(faint[:512], faint[:512], voice[:0], 12.0)
    assert left.above_least_db(11.9, 12.0) == np.inf


def test_its_words_are_known_by_their_times():
    words = (Span("Say", 0, 0.0, 0.3), Span("stop", 4, 0.3, 0.6), Span("now.", 9, 0.6, 0.9))
    sound = np.zeros(RATE, np.int16)
    voice = OwnVoice(RATE)

    assert voice.said(0.0, 100.0) == []
    voice.played(Speech("Say stop now.", sound, RATE, words=words), 0.5, 1600, 10.0)
    assert voice.said(9.85, 10.0) == ["stop"]
    assert voice.said(0.0, 100.0) == ["say", "stop", "now"]
    voice.played(Speech("Say no more.", sound, RATE), 0.5, 1600, 10.0)
    assert voice.said(0.0, 1.0) == ["say", "no", "more"]
