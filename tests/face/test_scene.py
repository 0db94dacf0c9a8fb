"""Scenes: who does what when, as a script says."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Expression, Phoneme, Span, Speech
from hri.face import load_face
from hri.face.lips.phonemes import sound_of
from hri.face.scene import Moment, Scene, load_scene, scene_of
from hri.hal.drivers.wav_file import write_wav

MODEL = load_face("robot")
RATE = 16000
TICK = 1 / 30
SAMPLE = Path(__file__).parents[2] / "docs" / "samples" / "face" / "hello.toml"


def mumble(text: str) -> Speech:
    """A voice that takes a tenth of a second for each letter, m and a in turns."""
    phonemes = tuple(Phoneme("ma"[n % 2], 0.1 * n, 0.1) for n in range(len(text)))
    samples = np.full(round(0.1 * len(text) * RATE), 1000, np.int16)
    return Speech(text, samples, RATE, phonemes)


@pytest.fixture
def scene(tmp_path: Path):  # type: ignore[no-untyped-def]
    """Loads the scene of a text."""

    def load(text: str) -> Scene:
        path = tmp_path / "scene.toml"
        path.write_text(text, encoding="utf-8")
        return load_scene(path, MODEL, mumble)

    return load


def played(scene: Scene, rate: float = 30.0, seed: int = 0) -> list[Moment]:
    return list(scene.moments(MODEL, rate, seed))


def weight(moments: list[Moment], time: float, channel: str) -> float:
    moment = moments[round(time / TICK)]
    assert moment.time == pytest.approx(time, abs=TICK)
    return float(moment.vector[MODEL.channels.index(channel)])


def test_steps_come_at_their_time_or_after_the_one_above_has_spoken(scene) -> None:  # type: ignore[no-untyped-def]
    cues = scene(
        """
        [[step]]
        at = 1
        say = "mamama"
        [[step]]
        gaze = [0.5, 0]
        [[step]]
        wait = 0.4
        express = "happy"
        [[step]]
        at = 2
        say = "mama"
        [[step]]
        wait = 0.5
        gesture = "nod"
        """
    ).cues
    assert [cue.at for cue in cues] == pytest.approx([1, 1, 1.4, 2, 2.9])


def test_the_face_does_what_the_script_says(scene) -> None:  # type: ignore[no-untyped-def]
    script = scene(
        """
        duration = 4
        [[step]]
        express = "sad"
        [[step]]
        at = 1
        say = "mamamama"
        [[step]]
        wait = 0.2
        express = "happy"
        weights = { browInnerUp = 0.9 }
        """
    )
    moments = played(script)
    assert len(moments) == 120
    assert weight(moments, 0.0, "mouthFrownLeft") > 0.8, "there from the first picture on"
    assert weight(moments, 1.05, "jawOpen") < 0.03, "closed for m"
    assert weight(moments, 1.15, "jawOpen") > 0.2, "open for a"
    assert {moment.caption for moment in moments[31:53]} == {"mamamama"}
    assert {moment.caption for moment in [*moments[:29], *moments[55:]]} == {""}
    assert weight(moments, 3.9, "mouthSmileLeft") > 0.8
    assert weight(moments, 3.9, "browInnerUp") == pytest.approx(0.9, abs=0.05)


def test_an_expression_that_passes_lasts_as_long_at_the_start_as_later(scene) -> None:  # type: ignore[no-untyped-def]
    step = '[[step]]\nat = {at}\nexpress = "happy"\nduration = 2.0\n'
    soon = played(scene("duration = 4.0\n" + step.format(at=0)))
    later = played(scene("duration = 4.0\n" + step.format(at=0.5)))

    assert weight(soon, 1.5, "mouthSmileLeft") > 0.8
    assert weight(soon, 1.5, "mouthSmileLeft") == pytest.approx(
        weight(later, 2.0, "mouthSmileLeft"), abs=0.02
    )


def test_the_same_scene_gives_the_same_weights(scene) -> None:  # type: ignore[no-untyped-def]
    script = scene('[[step]]\nat = 0.1\nsay = "mama"\n[[step]]\ngesture = "nod"\n')
    one, again, other = played(script), played(script), played(script, seed=4)
    for first, second in zip(one, again, strict=True):
        assert np.array_equal(first.vector, second.vector)
    assert any(not np.array_equal(a.vector, b.vector) for a, b in zip(one, other, strict=True))


def test_the_sound_is_where_it_is_said(scene) -> None:  # type: ignore[no-untyped-def]
    script = scene('[[step]]\nat = 0.5\nsay = "mama"\n[[step]]\nwait = 0.5\nsay = "mm"\n')
    samples, rate = script.sound()
    heard = np.flatnonzero(samples) / rate
    assert heard[0] == pytest.approx(0.5, abs=0.01)
    assert not ((heard > 0.91) & (heard < 1.39)).any()
    assert heard[-1] == pytest.approx(1.6, abs=0.01)
    assert len(samples) / rate == pytest.approx(script.duration, abs=0.01)
    assert scene('[[step]]\nexpress = "sad"').sound() is None


def test_a_recording_is_said_with_its_phonemes_or_without(scene, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    tone = (8000 * np.sin(np.arange(RATE) / RATE * 2 * np.pi * 200)).astype(np.int16)
    write_wav(tmp_path / "tone.wav", tone, RATE)
    rows = [{"name": "m", "start": 0.0, "duration": 1.0, "stressed": False}]
    (tmp_path / "tone.json").write_text(json.dumps({"phonemes": rows}))
    heard = scene('[[step]]\nsound = "tone.wav"')
    told = scene('[[step]]\nsound = "tone.wav"\nphonemes = "tone.json"\nsay = "mmm"')
    assert heard.cues[0].speech.phonemes == ()
    assert weight(played(heard), 0.5, "jawOpen") > 0.1
    assert weight(played(told), 0.5, "jawOpen") < 0.02
    assert played(told)[9].caption == "mmm"


@pytest.mark.parametrize(
    ("alphabet", "viseme"), [("arpabet", "DD"), ("espeak", "TH"), (None, "TH"), ("ipa", None)]
)
def test_a_file_of_phonemes_says_how_they_are_written(scene, tmp_path, alphabet, viseme):  # type: ignore[no-untyped-def]
    """ "D" is the sound of "day" in the one alphabet, and of "this" in the other."""
    write_wav(tmp_path / "d.wav", np.zeros(RATE, np.int16), RATE)
    named = {"alphabet": alphabet} if alphabet else {}
    rows = [{"name": "D", "start": 0.0, "duration": 1.0}]
    (tmp_path / "d.json").write_text(json.dumps({**named, "phonemes": rows}))
    step = '[[step]]\nsound = "d.wav"\nphonemes = "d.json"\n'
    if viseme is None:
        with pytest.raises(AuthoringError, match="holds no phoneme times"):
            scene(step)
    else:
        sounds = scene(step).cues[0].speech.phonemes
        assert [sound_of(sound.name).visemes for sound in sounds] == [(viseme,)]


def test_one_speech_alone_is_a_scene() -> None:
    script = scene_of(mumble("mama"), Expression("happy"))
    moments = played(script)
    assert script.duration > 1.2
    assert weight(moments, 0.0, "cheekSquintLeft") > 0.5
    assert weight(moments, 0.25, "jawOpen") < 0.05
    assert weight(moments, 1.3, "mouthSmileLeft") > 0.9


def test_the_sample_plays() -> None:
    script = load_scene(SAMPLE, MODEL, mumble)
    assert len([cue for cue in script.cues if cue.speech]) == 3
    assert len(played(script)) == round(script.duration * 30)


@pytest.mark.parametrize(
    ("step", "place", "what"),
    [
        ('express = "hapy"', "3:1", 'did you mean "happy"'),
        ('express = "happy"\nintensity = 2', "4:1", "from 0 to 1"),
        ("intensity = 1", "", "unknown key"),
        ("gaze = [2, 0]", "3:1", "from -1 to 1"),
        ("gaze = [0, 0]\nlook_at = [1, 0, 0]", "3:1", "write one of them"),
        ('gesture = "nodd"', "3:1", 'did you mean "nod"'),
        ('play = "no.csv"', "", "no.csv"),
        ('gesture = "nod"\nplay = "a.csv"', "4:1", "write one of them"),
        ('state = "sleepy"', "3:1", "sleepy"),
        ("weights = { jawOpn = 1 }", "3:", 'did you mean "jawOpen"'),
        ('say = ""', "3:1", "letters"),
        ('say = "a"\nphonemes = "a.json"', "4:1", "unknown key"),
        ('sound = "nowhere.wav"', "3:1", "no such file"),
        ('at = 1\nwait = 1\nexpress = "sad"', "4:1", "both at and wait"),
        ("at = 1", "2:1", "does nothing"),
        ("at = 1e9\ngaze = [0, 0]", "3:1", "from 0 to 600"),
        ("valence = nan", "3:1", "from -1 to 1"),
        ('exprss = "happy"', "3:1", 'did you mean "express"'),
    ],
)
def test_a_mistake_has_its_place_and_a_remedy(scene, step: str, place: str, what: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(HriError) as caught:
        scene(f"duration = 1\n[[step]]\n{step}\n")
    assert not place or f"scene.toml:{place}" in str(caught.value)
    assert what in str(caught.value)


def test_nobody_says_two_things_at_once(scene) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(AuthoringError, match="two things are said"):
        scene('[[step]]\nsay = "mamama"\n[[step]]\nat = 0.2\nsay = "mama"\n')


@pytest.mark.parametrize("text", ["", "duration = 3", "[[step]]\n" * 3000])
def test_an_empty_or_endless_script_is_refused(scene, text: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(AuthoringError):
        scene(text)


@pytest.mark.parametrize("text", ["{", "[]", '{"phonemes": 3}', '{"phonemes": [{"name": "m"}]}'])
def test_broken_phoneme_times_are_refused(scene, tmp_path: Path, text: str) -> None:  # type: ignore[no-untyped-def]
    write_wav(tmp_path / "a.wav", np.ones(RATE, np.int16), RATE)
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(AuthoringError, match="hri say --phonemes"):
        scene('[[step]]\nsound = "a.wav"\nphonemes = "a.json"\n')


def test_a_caption_is_the_sentence_that_is_heard() -> None:
    spans = (
        Span("[gasp]", 0, 0.0, 0.3),
        Span("Who is there?", 7, 0.5, 1.2),
        Span("Me.", 21, 2, 2.4),
    )
    speech = Speech("[gasp] Who is there? Me.", np.zeros(24000, np.int16), 8000, sentences=spans)
    shown = [speech.caption(time) for time in (0.0, 0.4, 0.6, 1.9, 2.0, 3.0)]
    assert shown == ["[gasp]", "[gasp]", "Who is there?", "Who is there?", "Me.", "Me."]
    assert replace(speech, sentences=()).caption(1.0) == speech.text
