"""Sounds that are not words, measured in the sound; and what a file of them may say."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import AuthoringError
from hri.face.lips.phonemes import sound_of
from hri.hal.synthesizer import CHILD, MAN, WOMAN
from hri.speech.vocalizations.mouth_shapes import SHAPES
from hri.speech.vocalizations.vocalization import LOUDNESS, load_sounds

SOUNDS = load_sounds()
STEP = 240
"""Samples of a stretch of 10 ms."""


def levels(speech):
    """Decibels of each stretch, of the voice's loudness."""
    sound = speech.samples[: len(speech.samples) // STEP * STEP].reshape(-1, STEP) / 32768
    return 20 * np.log10(np.sqrt((sound**2).mean(axis=1)) / LOUDNESS + 1e-9)


def pitches(speech, low=70, high=700):
    """Hertz of the stretches that have a pitch, by autocorrelation."""
    size, found = 960, []
    for start in range(0, len(speech.samples) - size, STEP):
        part = speech.samples[start : start + size].astype(float)
        alike = np.correlate(part, part, "full")[size - 1 :] / np.arange(size, 0, -1)
        lags = slice(speech.rate // high, speech.rate // low)
        best = int(np.argmax(alike[lags])) + lags.start
        if alike[best] > 0.6 * alike[0] > 0:
            found.append(speech.rate / best)
    return np.array(found)


def calls(speech):
    """How often it swells, by 4 dB and more."""
    count, last_peak, last_dip = 0, -99.0, -99.0
    smooth = np.convolve(levels(speech), np.ones(3) / 3, "same")
    is_rising = True
    for level in smooth[smooth > smooth.max() - 30]:
        if is_rising:
            last_peak = max(last_peak, level)
            if level < last_peak - 4:
                count, is_rising, last_dip = count + 1, False, level
        else:
            last_dip = min(last_dip, level)
            if level > last_dip + 4:
                is_rising, last_peak = True, level
    return count + is_rising


def test_there_are_some_thirty():
    assert len(SOUNDS) >= 30
    assert all(sound.about for sound in SOUNDS.values())


@pytest.mark.parametrize("name", SOUNDS)
def test_each_is_as_loud_as_it_says_and_moves_the_lips(name):
    sound = SOUNDS[name]
    speech = sound.speech()
    assert 0.15 < speech.duration < 4
    heard = levels(speech)
    loud = 10 * np.log10((10 ** (heard[heard > heard.max() - 6] / 10)).mean())
    assert abs(loud - sound.loudness) < 3
    assert np.abs(speech.samples.astype(int)).max() < 32000
    steps = np.abs(np.diff(speech.samples.astype(int)))
    assert steps[:24].max() < 1500, "it does not click"
    assert all(sound_of(phoneme.name) is not None for phoneme in speech.phonemes)
    assert speech.phonemes[-1].start == pytest.approx(speech.duration, abs=0.01)
    again = sound.speech()
    assert np.array_equal(again.samples, speech.samples)


def test_strength_and_length():
    sigh = SOUNDS["sigh"]
    soft, plain, strong = (sigh.speech(strength=way) for way in ("soft", "", "strong"))
    assert levels(soft).max() < levels(plain).max() - 3 < levels(strong).max() - 5
    short, long = (sigh.speech(length=way).duration for way in ("short", "long"))
    assert short < 0.75 * plain.duration < 0.75 * long
    assert sigh.speech(strength="strong", length="long").text == "[sigh strong long]"


def test_a_man_a_woman_and_a_child_laugh_at_their_own_pitch():
    man, woman, child = (
        np.median(pitches(SOUNDS["ooh"].speech(tract))) for tract in (MAN, WOMAN, CHILD)
    )
    assert man < 0.7 * woman
    assert woman < 0.8 * child


@pytest.mark.parametrize(
    ("name", "semitones"),
    [("hm?", 6), ("huh?", 5), ("mm-hm", 4), ("uh-huh", 3), ("uh-uh", -4), ("aah", -3), ("aww", -3)],
)
def test_yes_goes_up_and_no_goes_down(name, semitones):
    found = 12 * np.log2(pitches(SOUNDS[name].speech()))
    way = np.median(found[-4:]) - np.median(found[:4])
    assert way > semitones - 1.5 if semitones > 0 else way < semitones + 1.5


@pytest.mark.parametrize(("name", "count"), [("laugh", 5), ("sob", 5), ("tsk", 3), ("cough", 2)])
def test_a_laugh_has_calls_and_a_sob_two_breaths_before(name, count):
    assert abs(calls(SOUNDS[name].speech()) - count) <= 1


def test_a_breath_has_no_pitch_and_a_hum_no_hiss():
    def high_share(name):
        power = np.abs(np.fft.rfft(SOUNDS[name].speech().samples.astype(float))) ** 2
        hertz = np.fft.rfftfreq(len(SOUNDS[name].speech().samples), 1 / 24000)
        return power[hertz > 2500].sum() / power.sum()

    assert high_share("hum") < 0.01
    assert high_share("gasp") > 0.1
    assert len(pitches(SOUNDS["blow"].speech())) < 10


def write(tmp_path, body):
    path = tmp_path / "sounds.toml"
    path.write_text(f"schema = 1\n\n[hic]\n{body}\n", encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("body", "what", "remedy"),
    [
        ('about = "x"\nparts = [{ shape = "oops", ms = 90 }]', "oops", "oo"),
        ('about = "x"\nparts = [{ shape = "ah", ms = 1 }]', "ms is 1", "from 10 to 2000"),
        (
            'about = "x"\nparts = [{ shape = "ah", ms = 90, voice = [0, 3] }]',
            "voice",
            "from 0 to 1",
        ),
        ('about = "x"\nparts = [{ shape = "ah", ms = 90, voice = [] }]', "voice", "write numbers"),
        ('about = "x"\nparts = []', "no parts", "write parts"),
        (
            'about = "x"\nrepeats = 12\nparts = [{ shape = "ah", ms = 900 }]',
            "it takes 16.2 s",
            "8 s",
        ),
        ('parts = [{ shape = "ah", ms = 90 }]', "about", ""),
        ('about = "x"\nwobble = 1\nparts = [{ shape = "ah", ms = 90 }]', "wobble", ""),
    ],
)
def test_a_broken_file_is_refused_with_place_and_remedy(tmp_path, body, what, remedy):
    path = write(tmp_path, body)
    with pytest.raises(AuthoringError) as refused:
        load_sounds(path)
    assert what in str(refused.value)
    assert remedy in str(refused.value)
    assert 3 <= refused.value.place.line <= 7


def test_a_file_of_ones_own_adds_sounds(tmp_path, monkeypatch):
    folder = tmp_path / "emotions"
    folder.mkdir()
    write(folder, 'about = "a hiccup"\nparts = [{ shape = "ih", ms = 90, voice = 1 }]')
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    assert {"hic", "giggle"} <= set(load_sounds())


amplitudes = st.lists(st.floats(0, 1), min_size=1, max_size=4).map(list)
parts = st.lists(
    st.tuples(
        st.sampled_from(sorted(SHAPES)),
        st.floats(10, 300),
        st.lists(st.floats(-24, 36), min_size=1, max_size=4),
        amplitudes,
        amplitudes,
        st.floats(-1, 1),
    ),
    min_size=1,
    max_size=4,
)


@settings(deadline=None, max_examples=30)
@given(parts, st.sampled_from(["soft", "", "strong"]), st.sampled_from(["short", "", "long"]))
def test_whatever_a_file_says_is_a_sound(tmp_path_factory, given_parts, strength, length):
    rows = [
        f'{{ shape = "{shape}", ms = {ms}, pitch = {pitch}, voice = {voice}, air = {air},'
        f" tension = {tension} }}"
        for shape, ms, pitch, voice, air, tension in given_parts
    ]
    path = write(tmp_path_factory.mktemp("sounds"), f'about = "x"\nparts = [{", ".join(rows)}]')
    speech = load_sounds(path)["hic"].speech(WOMAN, strength, length)
    assert len(speech.samples)
    assert np.abs(speech.samples.astype(int)).max() < 32767
    starts = [phoneme.start for phoneme in speech.phonemes]
    assert starts == sorted(starts)
