"""The mouth follows the voice: from phonemes, or from the sound alone."""

import re
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.signals import Phoneme, Speech
from hri.face.lips.accents import FULL
from hri.face.lips.lip_player import LipPlayer, lip_track
from hri.face.lips.lipsync import FASTEST, ROUND_LEAD, STEP, LipTrack, PhonemeTrack
from hri.face.lips.phonemes import (
    ARPABET,
    BREATH,
    ESPEAK,
    ESPEAK_GLIDES,
    ESPEAK_REDUCED,
    Alphabet,
    mnemonics,
    sound_of,
)
from hri.face.lips.spans import (
    ARTICULATORS,
    CLOSED,
    HASTY,
    PRESSED,
    PULL,
    ROUNDED,
    SHORTEST,
    SHORTEST_ROUNDING,
    UNSTRESSED,
    spoken,
)
from hri.face.vocabulary import VISEMES
from tests.face.pixels import MODEL

RATE = 16000
FRAME = 1 / 30


def saying(*names: str, each: float = 0.09, stressed: str = "") -> Speech:
    """A speech of phonemes that last equally long."""
    phonemes = tuple(
        Phoneme(name, number * each, each, name == stressed) for number, name in enumerate(names)
    )
    return Speech("", np.zeros(round(len(names) * each * RATE), np.int16), RATE, phonemes)


def test_every_viseme_has_sounds_and_every_sound_a_viseme() -> None:
    assert set(ESPEAK) == set(PULL) == set(VISEMES)
    for pair in ESPEAK_GLIDES.values():
        assert set(pair.split()) <= set(VISEMES)
    known = {*" ".join(ESPEAK.values()).split(), *ESPEAK_GLIDES, *ESPEAK_REDUCED.split(), BREATH}
    assert set(ARPABET.values()) <= known


@pytest.mark.parametrize(
    ("name", "visemes"),
    [("p", "PP"), ("'aI", "aa ih"), ("i:", "ih"), ("D", "TH"), ("n^", "nn"), ("§", "kk")],
)
def test_marks_of_stress_and_length_do_not_change_the_shape(name: str, visemes: str) -> None:
    assert sound_of(name).visemes == tuple(visemes.split())


def test_a_reduced_vowel_hardly_opens_the_mouth() -> None:
    assert sound_of("@").strength < 0.7
    weak, strong = map(sound_of, mnemonics(["AH0", "AH1"], Alphabet.ARPABET))
    assert weak.strength < strong.strength


def test_arpabet_is_told_from_espeak_by_its_vowels() -> None:
    assert mnemonics(["D", "I", "s", "S", "V"]) == ["D", "I", "s", "S", "V"]
    assert mnemonics(["D", "S"], Alphabet.ARPABET) == ["d", "s"]
    these = spoken(saying(*mnemonics(["DH", "IY1", "Z", "D", "EY1"])).phonemes)
    assert [segment.viseme for segment in these] == ["TH", "ih", "SS", "DD", "E", "ih"]


SOUNDS = st.sampled_from([*"aEsktlrmpbfvSh@wnTD", "i:", "oU", "u:", "_:", "aI@", "tS", "?!"])
LENGTHS = st.floats(0.0, 0.25)


@st.composite
def speeches(draw: st.DrawFn) -> tuple[Phoneme, ...]:
    """Any sounds of any lengths, with a gap here and there."""
    sounds = draw(st.lists(st.tuples(SOUNDS, LENGTHS, st.booleans()), min_size=1, max_size=20))
    phonemes, now = [], draw(st.floats(0, 0.5))
    for name, length, stressed in sounds:
        phonemes.append(Phoneme(name, now, length, stressed))
        now += length + (0.3 if stressed and length > 0.2 else 0.0)
    return tuple(phonemes)


def closing(phonemes: tuple[Phoneme, ...]) -> Iterator[tuple[str, float, float, bool]]:
    """Viseme, begin and end of each closure; whether one of the other kind is less than 0.3 s off.

    One that is shorter than 70 ms is shut before it sounds.
    """
    named = [(sound_of(p.name).visemes[0], p.start, p.start + p.duration) for p in phonemes]
    shut = [each for each in named if each[0] in CLOSED]
    for (viseme, start, end), (following, *_) in zip(named, [*named[1:], ("", 0, 0)], strict=True):
        if viseme in CLOSED and following != viseme:
            crowded = any(v != viseme and s < end + 0.3 and start < e + 0.3 for v, s, e in shut)
            yield viseme, min(start, end - 0.07), end, crowded


@given(speeches(), st.floats(0, FRAME))
@settings(max_examples=60, deadline=None)
@pytest.mark.proves("R05")
def test_the_lips_meet_for_p_b_m_f_v_whatever_is_around(
    phonemes: tuple[Phoneme, ...], phase: float
) -> None:
    """At 30 frames a second, in any phase, at least one frame shows each closure."""
    track = PhonemeTrack(phonemes)
    for viseme, start, end, is_crowded in closing(phonemes):
        if is_crowded and viseme != PRESSED:
            continue
        first = np.ceil((start - phase) / FRAME) * FRAME + phase
        frames = [t for t in np.arange(first, end + 1e-9, FRAME) if t <= end]
        for articulator in ("lips", "jaw"):
            assert max(track.weights(t, articulator).get(viseme, 0.0) for t in frames) >= 0.9
            around = np.arange(start - 0.03, end + 0.03, 0.002)
            shut = [track.weights(t, articulator).get(viseme, 0.0) >= 0.9 for t in around]
            assert 0.002 * sum(shut) >= 0.05


MILLISECONDS = st.integers(0, 150)
CLOSURES = st.tuples(st.sampled_from("pbmfv"), MILLISECONDS)
BETWEEN = st.tuples(st.sampled_from(["a", "i:", "u:", "s", "_:"]), MILLISECONDS)


@given(st.lists(CLOSURES | BETWEEN, min_size=1, max_size=12))
@settings(max_examples=100, deadline=None)
@pytest.mark.proves("R05")
def test_lips_that_meet_are_not_on_the_teeth(sounds: list[tuple[str, int]]) -> None:
    """However many P and F come one after the other: each P is shut for 50 ms, and no F in it."""
    ends = np.cumsum([length for _, length in sounds]).tolist()
    phonemes = tuple(
        Phoneme(name, (end - length) / 1000, length / 1000)
        for (name, length), end in zip(sounds, ends, strict=True)
    )
    track = PhonemeTrack(phonemes)
    for viseme, start, end, _ in closing(phonemes):
        if viseme == PRESSED:
            around = [track.weights(t) for t in np.arange(start - 0.03, end + 0.03, 0.002)]
            shut = [w.get("PP", 0.0) >= 0.9 and w.get("FF", 0.0) <= 0.1 for w in around]
            assert 0.002 * sum(shut) >= 0.05


@pytest.mark.parametrize("names", ["vb", "bv", "avba", "abva", "fbvm"])
def test_of_p_and_f_that_touch_both_are_seen(names: str) -> None:
    """Such as in "move behind" and "subfield", at the pace of quick talk."""
    track = lip_track(saying(*names, each=0.07))
    times = np.arange(-0.15, 0.07 * len(names) + 0.05, 0.002)
    for one, other in (("PP", "FF"), ("FF", "PP")):
        shown = [track.weights(t) for t in times]
        alone = [w.get(one, 0.0) >= 0.9 and w.get(other, 0.0) <= 0.1 for w in shown]
        assert 0.002 * sum(alone) >= 0.05, one


@given(speeches())
@settings(max_examples=40, deadline=None)
def test_weights_stay_in_range_and_nothing_is_faster_than_a_mouth(
    phonemes: tuple[Phoneme, ...],
) -> None:
    track = PhonemeTrack(phonemes)
    end = phonemes[-1].start + phonemes[-1].duration
    times = np.arange(-0.2, end + 0.3, STEP)
    for articulator in ARTICULATORS:
        shapes = np.array([_row(track, t, articulator) for t in times])
        assert shapes.min() >= 0
        assert shapes.max() <= 1.2
        assert np.abs(np.diff(shapes, axis=0)).max() <= FASTEST[articulator] * STEP + 0.01


def _row(track: LipTrack, position: float, articulator: str) -> list[float]:
    weights = track.weights(position, articulator)
    return [weights.get(viseme, 0.0) for viseme in VISEMES]


@given(speeches())
@settings(max_examples=200, deadline=None)
def test_shapes_come_in_order_and_only_closures_may_be_short(
    phonemes: tuple[Phoneme, ...],
) -> None:
    segments = PhonemeTrack(phonemes).segments
    for one, other in pairwise(segments):
        assert one.start <= one.end <= other.start + 1e-9
    for before, segment, after in zip(segments, segments[1:], segments[2:], strict=False):
        alone = {before.viseme, after.viseme} <= {*CLOSED, "sil"}
        least = SHORTEST_ROUNDING if segment.viseme in ROUNDED else SHORTEST[0]
        assert segment.duration >= least - 1e-9 or segment.viseme in CLOSED or alone


@pytest.mark.parametrize(("each", "is_shown"), [(0.05, True), (0.1, False)])
def test_a_short_shape_is_shown_at_the_pace_of_quick_talk(each: float, is_shown: bool) -> None:
    """A t of 45 ms is as long as its neighbors in quick talk, and nothing in slow talk."""
    names = "akasakatakasaka"
    ends = np.cumsum([0.045 if name == "t" else each for name in names]).tolist()
    starts = [0.0, *ends]
    sounds = [
        Phoneme(name, start, end - start)
        for name, start, end in zip(names, starts, ends, strict=False)
    ]
    assert ("DD" in [segment.viseme for segment in PhonemeTrack(sounds).segments]) == is_shown


@pytest.mark.parametrize("names", ["asaSasa", "istStsa", "sawasas", "kadZZtk"])
@pytest.mark.parametrize("each", [0.03, 0.05, 0.08])
def test_lips_round_however_short_the_sound_is(names: str, each: float) -> None:
    sounds = re.findall("dZ|tS|.", names)
    track = lip_track(saying(*sounds, each=each))
    number = next(n for n, name in enumerate(sounds) if sound_of(name).visemes[0] in ROUNDED)
    around = np.arange(number * each - ROUND_LEAD, (number + 1) * each, 0.005)
    rounded = [sum(track.weights(t).get(name, 0.0) for name in ROUNDED) for t in around]
    assert max(rounded) >= 0.7


def test_the_closure_is_over_when_the_vowel_sounds() -> None:
    track = lip_track(saying("a", "m", "a", each=0.12))
    assert track.weights(0.18)["PP"] > 0.99
    assert track.weights(0.31)["aa"] > 0.85
    assert track.weights(0.31).get("PP", 0.0) < 0.1


def test_an_h_has_the_shape_of_its_vowel() -> None:
    breath, vowel = spoken(saying("h", "u:").phonemes)
    assert breath.viseme == vowel.viseme == "ou"
    assert breath.strength < vowel.strength


def test_vowels_of_one_kind_are_not_all_alike() -> None:
    """Stressed and long ones are full: in "she sees three trees" the mouth is not frozen."""
    sounds = (
        Phoneme("i:", 0.0, 0.2, stressed=True),
        Phoneme("s", 0.2, 0.1),
        Phoneme("i:", 0.3, 0.2),
        Phoneme("s", 0.5, 0.1),
        Phoneme("I", 0.6, 0.05),
    )
    full, weaker, weakest = (s.strength for s in spoken(sounds) if s.viseme == "ih")
    assert full == 1
    assert weaker == pytest.approx(UNSTRESSED)
    assert HASTY * UNSTRESSED < weakest < weaker
    plain = [Phoneme(each.name, each.start, each.duration) for each in sounds]
    assert next(spoken(plain)).strength == 1, "where the voice marks no stress"


def test_a_glide_spends_more_time_at_its_begin() -> None:
    first, second = spoken(saying("aI", each=0.2).phonemes)
    assert (first.viseme, second.viseme) == ("aa", "ih")
    assert first.duration == pytest.approx(0.12)


def test_rounded_lips_set_out_before_the_sound() -> None:
    track = lip_track(saying("s", "u:", each=0.2))
    assert track.weights(0.17)["ou"] > 0.4
    assert track.weights(0.17, "jaw").get("ou", 0.0) < track.weights(0.17)["ou"]


def test_a_t_leaves_the_lips_to_its_vowels_and_takes_the_tongue() -> None:
    track = lip_track(saying("u:", "t", "u:", each=0.12))
    assert track.weights(0.18)["ou"] > 0.4
    assert track.weights(0.18, "tongue")["DD"] > 0.8


def test_stress_opens_the_jaw_wider_and_lifts_the_brows() -> None:
    plain, stressed = saying(*"tat", each=0.15), saying(*"tat", each=0.15, stressed="a")
    calm, keen = lip_track(plain), lip_track(stressed)
    assert keen.weights(0.225, "jaw")["aa"] > 1.08 * calm.weights(0.225, "jaw")["aa"]
    assert calm.emphasis(0.225) == 0
    assert keen.emphasis(0.225) > 0.9
    assert keen.emphasis(-1.0) == keen.emphasis(1.0) == 0


@given(speeches(), st.floats(-1, 6))
@settings(max_examples=40, deadline=None)
def test_emphasis_is_a_smooth_share(phonemes: tuple[Phoneme, ...], t: float) -> None:
    track = PhonemeTrack(phonemes)
    now, then = track.emphasis(t), track.emphasis(t + 1e-3)
    assert 0 <= now <= 1
    assert abs(now - then) < 0.03


def test_the_mouth_rests_before_and_after_the_words_and_in_a_gap() -> None:
    sounds = (Phoneme("a", 0.5, 0.1), Phoneme("a", 2.0, 0.1))
    track = PhonemeTrack(sounds)
    for position in (-1e6, 0.0, 1.3, 3.0, 1e6):
        assert max(track.weights(position).values(), default=0) < 0.05
    assert track.weights(2.05)["aa"] > 0.6


def test_a_track_may_be_asked_in_any_order() -> None:
    phonemes = saying(*"sapamifolu" * 6).phonemes
    times = np.arange(0, 5.4, 0.071)
    there, back = PhonemeTrack(phonemes), PhonemeTrack(phonemes)
    forth = [there.weights(t) for t in times]
    assert forth == [back.weights(t) for t in times[::-1]][::-1]


@pytest.mark.proves("R05")
def test_a_closed_mouth_is_closed_on_the_face() -> None:
    player = LipPlayer(MODEL, 0.0)
    player.say(saying("a", "m", "a", each=0.12))
    frames = {n: player.follow(n / 100, 0.01)[0] for n in range(-20, 20)}
    assert MODEL.weights(frames[18]).get("jawOpen", 0.0) < 0.02
    assert MODEL.weights(frames[6])["jawOpen"] > 0.4


@pytest.mark.parametrize(
    ("espeak", "arpabet", "visemes"),
    [
        ("m", "M", ("PP",)),
        ("f", "F", ("FF",)),
        ("s", "S", ("SS",)),
        ("n", "N", ("nn",)),
        ("k", "K", ("kk",)),
        ("A:", "AA", ("aa",)),
        ("E", "EH", ("E",)),
        ("i:", "IY", ("ih",)),
        ("O:", "AO", ("oh",)),
        ("u:", "UW", ("ou",)),
        ("aI", "AY", ("aa", "ih")),
        ("oU", "OW", ("oh", "ou")),
    ],
)
def test_a_sound_has_its_shape_in_both_alphabets(espeak, arpabet, visemes):
    assert sound_of(espeak).visemes == visemes
    assert mnemonics([arpabet], Alphabet.ARPABET) == [espeak]


def test_one_word_of_a_phrase_is_accented_not_each() -> None:
    """The longest; a second phrase has its own."""
    lengths = (0.1, 0.14, 0.1, 0.2, 0.3, 0.12)
    names = ("a", "E", "a", "O:", "_:", "a")
    ends = np.cumsum(lengths).tolist()
    sounds = [
        Phoneme(name, end - length, length, name != "_:")
        for name, length, end in zip(names, lengths, ends, strict=True)
    ]
    track = PhonemeTrack(sounds)
    at = [track.emphasis(end - length / 2) for length, end in zip(lengths, ends, strict=True)]
    assert at[3] == pytest.approx(1)
    assert at[5] == pytest.approx(0.12 / FULL)
    assert max(at[:2]) == 0


def test_of_two_words_the_louder_is_accented() -> None:
    sounds = tuple(Phoneme("a", 0.2 * n, 0.2, stressed=n in (1, 3)) for n in range(5))
    samples = np.full(RATE, 300, np.int16)
    samples[round(0.2 * RATE) : round(0.4 * RATE)] = 6000
    track = lip_track(Speech("", samples, RATE, tuple(_apart(sounds))))
    assert track.emphasis(0.3) > 0.9
    assert track.emphasis(0.7) < 0.1


def _apart(sounds: tuple[Phoneme, ...]) -> Iterator[Phoneme]:
    """Each other sound another one: equal neighbors are one shape."""
    for number, sound in enumerate(sounds):
        yield sound if number % 2 else Phoneme("k", sound.start, sound.duration)


def test_a_long_phrase_has_more_accents_than_one() -> None:
    sounds = [Phoneme("aE"[n % 2], 0.2 * n, 0.2, stressed=True) for n in range(20)]
    track = PhonemeTrack(sounds)
    times = np.arange(0, 4, 0.02)
    accented = np.array([track.emphasis(t) > 0.5 for t in times])
    assert 2 <= np.sum(np.diff(accented.astype(int)) == 1) <= 4
