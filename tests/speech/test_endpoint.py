from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.hal.drivers.wav_file import read_wav
from hri.speech.endpoint import FRAME, LONGEST, PAUSE, PRE_ROLL, TRAILING, Endpointer, NoiseLevel
from hri.speech.recognizers.voice_activity import voice_detector
from tests.recorded import ORDERS, SHARED, needs_shared, spoken_by_a_person

RATE = 16000
SIZE = round(FRAME * RATE)


def noise(seconds, level=8.0, seed=1):
    return np.random.default_rng(seed).normal(0, level, round(seconds * RATE)).astype(np.int16)


def always(rate):
    """A detector that takes everything for a voice: the level alone decides."""
    return lambda frame: True


def pieces_of(sound, pause=PAUSE, detector=always, step=533):
    endpointer = Endpointer(RATE, detector, pause)
    found = []
    for first in range(0, len(sound), step):
        block = sound[first : first + step]
        found += endpointer.listen(block, (first + len(block)) / RATE)
    return found + endpointer.flush()


def words(*gaps, level=3000.0):
    """Loud half seconds with pauses of these lengths behind them, over a quiet room."""
    parts = [noise(1.0)]
    for number, gap in enumerate(gaps):
        parts += [noise(0.5, level, number), noise(gap, seed=number + 50)]
    return np.concatenate(parts)


def test_a_piece_has_what_comes_before_it_and_the_pause_that_ends_it():
    (piece,) = pieces_of(words(2.0))

    assert piece.start == pytest.approx(1.0 - PRE_ROLL, abs=2 * FRAME)
    assert piece.end == pytest.approx(1.5 + PAUSE, abs=0.1)
    assert piece.quiet == pytest.approx(piece.end - 1.5, abs=2 * FRAME)
    assert len(piece.samples) == round((piece.end - piece.start) * RATE)
    assert piece.noise_db == -65.0


def test_words_with_short_pauses_are_one_piece_and_with_long_ones_several():
    assert len(pieces_of(words(0.4, 0.4, 0.4, 1.0))) == 1
    assert len(pieces_of(words(0.9, 0.9, 0.9, 1.0))) == 4
    assert len(pieces_of(words(0.9, 0.9, 0.9, 1.5), pause=1.2)) == 1


def pieces_told(sound, pauses):
    """The pieces, where in the first pause that is 0.16 s old one is told what to wait for."""
    endpointer = Endpointer(RATE, always)
    found, told = [], False
    for first in range(0, len(sound), SIZE):
        block = sound[first : first + SIZE]
        found += endpointer.listen(block, (first + len(block)) / RATE)
        segment = endpointer.open_segment
        if segment is not None and segment.quiet >= 0.16 and not told:
            endpointer.wait(segment, pauses)
            told = True
    return found + endpointer.flush()


@pytest.mark.parametrize(("pauses", "seconds"), [(0.34, 0.2), (1.0, 0.6), (2.0, 1.2), (9.0, 3.0)])
def test_a_piece_waits_as_long_as_it_is_told(pauses, seconds):
    (piece,) = pieces_told(words(4.0), pauses)

    # A tenth of the pause may be voice.
    assert 0.9 * seconds - FRAME <= piece.quiet <= seconds + 3 * FRAME


def test_the_usual_pause_counts_again_as_soon_as_the_voice_goes_on():
    (piece,) = pieces_told(words(1.0, 2.0), 2.0)
    assert piece.end - piece.start == pytest.approx(PRE_ROLL + 0.5 + 1.0 + 0.5 + PAUSE, abs=0.15)

    first, second = pieces_told(words(0.15 + PAUSE / 3, 2.0), 0.34)
    assert first.quiet == pytest.approx(0.2, abs=3 * FRAME)
    assert second.quiet == pytest.approx(PAUSE, abs=3 * FRAME)


def test_a_click_in_a_pause_is_nobody_who_goes_on():
    sound = words(3.0)
    sound[round(1.9 * RATE) :][: SIZE // 2] = 3000

    (piece,) = pieces_told(sound, 2.0)

    assert piece.end == pytest.approx(1.5 + 1.2, abs=0.15)


def talk(seconds, level=300.0):
    """What a room full of people sounds like: noise that swells and dips four times a second."""
    sound = noise(seconds, level, 7)
    swell = np.sin(4 * np.pi * np.arange(len(sound)) / RATE) ** 2
    return (sound * (0.4 + 0.6 * swell)).astype(np.int16)


def over(background, *words):
    """Loud words, each from a second to another one, over a background."""
    sound = background.copy()
    for first, last in words:
        near = noise(last - first, 3000.0)
        sound[round(first * RATE) :][: len(near)] += near
    return sound


def test_talk_that_goes_on_is_neither_begun_with_nor_waited_for():
    (first, second) = pieces_of(over(talk(20.0), (8.0, 9.0), (14.0, 16.0)))

    assert first.start == pytest.approx(8.0 - PRE_ROLL, abs=0.1)
    assert first.end == pytest.approx(9.0 + TRAILING + PAUSE, abs=0.1)
    assert first.quiet == pytest.approx(PAUSE, abs=2 * FRAME)
    assert second.start == pytest.approx(14.0 - PRE_ROLL, abs=0.1)
    assert second.end == pytest.approx(16.0 + TRAILING + PAUSE, abs=0.1)


def test_talk_at_the_beginning_of_a_piece_is_cut_off_and_the_rest_is_another_piece():
    endpointer = Endpointer(RATE, always)
    sound = over(talk(5.0), (2.5, 3.0))
    begun = {}
    for first in range(0, len(sound), 800):
        finished = endpointer.listen(sound[first : first + 800], (first + 800) / RATE)
        if (snapshot := endpointer.open_segment) is not None:
            begun[snapshot.number] = snapshot.start
        if finished:
            break

    assert begun == {1: pytest.approx(0.0, abs=0.2), 2: pytest.approx(2.5 - PRE_ROLL, abs=0.15)}
    assert finished[0].number == 2
    assert finished[0].end < 4.0


def test_a_soft_voice_is_heard_in_a_quiet_room_and_so_is_a_soft_word_before_a_loud_one():
    room = noise(6.0)
    room[2 * RATE : 3 * RATE] += noise(1.0, 150.0)
    (piece,) = pieces_of(room)
    assert piece.start < 2.0 < 3.0 < piece.end

    room[3 * RATE : 4 * RATE] += noise(1.0, 600.0)
    (piece,) = pieces_of(room)
    assert piece.start < 2.0 < 4.0 < piece.end


def test_who_speaks_as_the_sound_begins_is_heard():
    (piece,) = pieces_of(over(noise(3.0), (0.0, 1.0)))

    assert piece.start == pytest.approx(0.0, abs=FRAME)


def test_pieces_are_numbered_and_their_snapshots_begin_one_another():
    endpointer = Endpointer(RATE, always)
    sound = words(1.0, 1.0)
    snapshots, finished = [], []
    for first in range(0, len(sound), 800):
        finished += endpointer.listen(sound[first : first + 800], (first + 800) / RATE)
        assert endpointer.is_hearing == (endpointer.open_segment is not None)
        if (snapshot := endpointer.open_segment) is not None:
            snapshots.append(snapshot)

    assert [piece.number for piece in finished] == [1, 2]
    for snapshot in snapshots:
        whole = finished[snapshot.number - 1]
        assert np.array_equal(whole.samples[: len(snapshot.samples)], snapshot.samples)
        assert snapshot.start == pytest.approx(whole.start)


def test_a_noise_that_starts_suddenly_is_known_for_one_within_seconds():
    sound = np.concatenate([noise(3.0), noise(60.0, 1000.0)])

    pieces = pieces_of(sound)

    assert len(pieces) == 1
    assert pieces[0].end < 6.5


@pytest.mark.parametrize("seed", range(3))
def test_noise_from_the_first_sample_on_is_given_up(seed):
    hiss = noise(10.0, 3000.0, seed)

    pieces = pieces_of(hiss, detector=voice_detector)

    assert sum(len(piece.samples) for piece in pieces) < len(hiss) / 2


def test_speech_over_a_noise_that_stays_is_heard():
    room = noise(12.0, 300.0)
    room[8 * RATE : 9 * RATE] += noise(1.0, 3000.0)

    assert 8.0 < pieces_of(room)[-1].end < 10.0


def test_an_endless_voice_is_cut_without_losing_a_sample():
    loud = np.concatenate([noise(1.0), np.tile(words(0.1)[-RATE // 2 :], 120)])

    pieces = pieces_of(loud)

    assert max(piece.end - piece.start for piece in pieces) <= LONGEST + 0.1
    first, second = pieces[:2]
    assert second.start <= first.end + 0.05


def test_a_loud_voice_that_never_ends_behind_a_soft_one_has_room():
    soft = np.concatenate([noise(0.5, 300.0), noise(0.3)] * 15)
    loud = np.concatenate([noise(0.5, 9000.0), noise(0.2)] * 40)

    first, *_ = pieces_of(np.concatenate([noise(1.0), soft, loud]))

    assert first.start == pytest.approx(13.0 - PRE_ROLL, abs=0.15)
    assert first.end - first.start == pytest.approx(LONGEST, abs=FRAME)


def test_an_offset_of_the_sound_is_no_voice():
    shifted = (noise(5.0).astype(np.int32) + 9000).astype(np.int16)

    assert pieces_of(shifted) == []
    (piece,) = pieces_of((words(2.0, level=2000.0).astype(np.int32) + 9000).astype(np.int16))
    assert 1.4 < piece.end - piece.quiet < 1.6


def test_an_hour_of_silence_costs_little_and_keeps_nothing():
    endpointer = Endpointer(RATE, voice_detector)
    minute = noise(60.0, 5.0)

    for number in range(10):  # the sixth part of an hour tells as much
        assert endpointer.listen(minute, 60.0 * (number + 1)) == []
    assert not endpointer.is_hearing
    assert len(endpointer._before) * SIZE < RATE
    assert len(endpointer._noise._least) <= 101


@settings(max_examples=30, deadline=None)
@given(
    st.lists(st.integers(-32768, 32767), max_size=30).map(lambda levels: np.repeat(levels, 300)),
    st.integers(1, 5000),
)
def test_whatever_comes_in_the_pieces_are_in_order_and_part_of_it(levels, step):
    sound = levels.astype(np.int16)

    pieces = pieces_of(sound, step=step)

    edges = [edge for piece in pieces for edge in (piece.start, piece.end)]
    assert edges == sorted(edges)
    assert sum(len(piece.samples) for piece in pieces) <= len(sound)


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=300))
def test_the_noise_is_never_above_the_loudest_of_the_last_two_seconds(powers):
    noise_level = NoiseLevel()
    for power in powers:
        level = noise_level.update(power)
    assert level <= max(-65.0, 10 * np.log10(max(powers) + 1e-12)) + 1e-6


def count_of(sound):
    """How many pieces a recording falls into, quiet around it."""
    return len(pieces_of(np.concatenate([noise(0.5), sound, noise(1.0)]), PAUSE, voice_detector))


def test_recorded_orders_are_whole():
    counts = [count_of(spoken_by_a_person(name)) for name in ORDERS]

    assert len(counts) == 10
    assert counts.count(1) >= len(counts) - 1
    assert 0 not in counts


@needs_shared("speech/real/digits")
def test_recorded_digits_are_whole():
    files = sorted((SHARED / "speech" / "real" / "digits").glob("*.wav"))[::10]
    counts = [count_of(read_wav(file, RATE)[0]) for file in files]

    assert counts.count(1) >= len(counts) - 1
