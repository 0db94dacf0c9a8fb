"""`hri grammar test --audio`, `confuse` and `calibrate`, with an engine that knows the answers."""

from __future__ import annotations

import json
from contextlib import contextmanager

import numpy as np
import pytest

from hri.cli.grammar import calibrate, confuse, test as test_command
from hri.core.clock import FakeClock
from hri.hal.drivers.wav_file import write_wav
from hri.hal.recognizer import Hypothesis, Recognizer, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar.lint.expectations import meaning_of
from hri.speech.grammar.matching import parse
from hri.speech.synthesizers import flite
from hri.speech.trials import RecordedClip

RULES = "public <a> = turn left | turn right {right};\npublic <b> = go to the (ball | wall {far});"
WORDS = [("turn left", 0.9), ("turn right", 0.9), ("turn left", 0.3), ("go to the wall", 0.6)]
"""What the engine makes of sound, by its first sample."""


class Oracle(Recognizer):
    def _open(self):
        self._sound = []

    def start(self, grammar):
        pass

    def listen(self, samples, end):
        self._sound.append(samples)
        return []

    def flush(self):
        sound, self._sound = np.concatenate(self._sound), []
        return [Segment(0.0, 1.0, sound)]

    def decode(self, segment, rules=None):
        return Hypothesis(*WORDS[segment.samples[0]])


@pytest.fixture(autouse=True)
def oracle(monkeypatch):
    @contextmanager
    def started(options, grammar):
        with ResourceManager((), FakeClock()) as manager:
            engine = Oracle(Description("ears", "Test.Ears"), manager)
            engine.activate()
            yield engine

    for command in (test_command, confuse, calibrate):
        monkeypatch.setattr(command, "started_engine", started)


@pytest.fixture
def manifest(tmp_path):
    """Writes a manifest: for each line what the engine makes of it, and what was said."""

    def manifest(*lines):
        rows = ["file\tsentence\ttags", "# the kitchen"]
        for number, (answer, said) in enumerate(lines):
            write_wav(tmp_path / f"{number}.wav", np.full(1600, answer, np.int16), 16000)
            rows.append(f"{number}.wav\t{said}")
        path = tmp_path / "manifest.tsv"
        path.write_text("\n".join(rows) + "\n\n")
        return path

    return manifest


def test_recordings_that_are_understood_are_counted(grammar, write, manifest, capsys):
    path = manifest((0, "turn left"), (1, "\ta: right"), (2, "-"))

    assert grammar("test", "--audio", path, "--grammar", write(RULES)) == 0
    out = capsys.readouterr().out
    assert "commands right and accepted    2 of 2, 100 %" in out
    assert "others accepted                0 of 1, 0 %" in out


def test_columns_with_other_headings_are_of_no_concern(grammar, write, manifest, capsys):
    path = manifest((0, "turn left\thttps://example.com/a b"), (2, "-\tmine"))
    path.write_text(path.read_text().replace("sentence\ttags", "transcript\tsource"))

    assert grammar("test", "--audio", path, "--grammar", write(RULES)) == 0
    assert "commands right and accepted    1 of 1" in capsys.readouterr().out


def test_what_went_wrong_is_told_with_the_recording(grammar, write, manifest, capsys):
    path = manifest((1, "turn left"), (2, "turn left"), (0, "-"), (1, "turn left"))

    assert grammar("test", "--audio", path, "--grammar", write(RULES)) == 1
    out = capsys.readouterr().out
    assert '0.wav: "turn left" was taken for "turn right"' in out
    assert '1.wav: "turn left" was rejected: "turn left" with confidence 0.30' in out
    assert '2.wav: "-" was taken for "turn left"' in out
    assert '2 x "turn left" for "turn right"' in out


def test_the_right_words_with_another_meaning_are_told_with_both(grammar, write, manifest, capsys):
    path = manifest((0, "turn left\ta: left x=3"))

    assert grammar("test", "--audio", path, "--grammar", write(RULES)) == 1
    out = capsys.readouterr().out
    assert '0.wav: "turn left" was heard as a: {}, not as a: left=true x=3' in out


def test_programs_get_counts_and_recordings(grammar, write, manifest, capsys):
    path = manifest((0, "turn left"), (1, "turn left"))

    assert grammar("test", "--audio", path, "--grammar", write(RULES), "--json") == 1
    told = json.loads(capsys.readouterr().out)
    assert (told["commands"], told["right"], told["wrong"]) == (2, 1, 1)
    assert told["recordings"][1]["heard"][0]["tags"] == {"right": True}


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("0.wav", "1:1: no sentence"),
        ("0.wav\tfly to the moon", '1:1: the grammar does not allow "fly to the moon"'),
        ("0.wav\tx\ta: x==", "1:1: cannot read the tag"),
        ("none.wav\tturn left", "no such file"),
        ("file\tsentence\n# none yet", "1:1: no recording in this manifest"),
    ],
)
def test_a_mistake_in_a_manifest_is_told(grammar, write, tmp_path, capsys, line, message):
    (tmp_path / "manifest.tsv").write_text(line)
    assert grammar("test", "--audio", tmp_path / "manifest.tsv", "--grammar", write(RULES)) == 2
    assert message in capsys.readouterr().err


def test_a_file_of_sentences_finds_its_grammar(grammar, write, tmp_path, capsys):
    write(RULES, "mine")
    (tmp_path / "mine.txt").write_text("+ turn left\n- turn up\n")
    assert grammar("test", tmp_path / "mine.txt") == 0

    (tmp_path / "other.txt").write_text("+ turn up\n")
    assert grammar("test", tmp_path / "other.txt") == 2
    assert "add --grammar NAME, or put other.jsgf beside it" in capsys.readouterr().err

    (tmp_path / "other.txt").write_text("grammar mine\n+ turn up => a: x=1\n")
    assert grammar("test", tmp_path / "other.txt", "--json") == 1
    (failure,) = json.loads(capsys.readouterr().out)["failures"]
    assert (failure["line"], failure["came"]) == (2, 'is not understood beyond "turn"')


@pytest.mark.parametrize(
    "words",
    [
        ("confuse", "FILE", "--sentences", "-5"),
        ("confuse", "FILE", "-n", "0"),
        ("confuse", "FILE", "--farthest", "nan"),
        ("confuse", "FILE", "--strictness", "7"),
        ("calibrate", "FILE", "--sentences", "many"),
        ("calibrate", "FILE", "--foreign", "-0.1"),
        ("test", "FILE", "--strictness", "x"),
        ("expand", "FILE", "-n", "\u00b2"),
    ],
)
def test_numbers_out_of_range_are_refused(grammar, write, capsys, words):
    path = write(RULES)
    with pytest.raises(SystemExit) as ended:
        grammar(*(path if word == "FILE" else word for word in words))
    assert ended.value.code == 2
    assert f"{words[-1]} - write a number" in capsys.readouterr().err


def test_nothing_to_test_is_told(grammar, capsys):
    assert grammar("test") == 2
    assert "nothing to test" in capsys.readouterr().err


def test_pairs_that_sound_alike_are_shown_with_their_meanings(grammar, write, capsys):
    path = write(RULES)
    assert grammar("confuse", path) == 0
    out = capsys.readouterr().out
    assert "ball  ~  wall" in out
    assert '"go to the wall" => b: far=true' in out
    assert "1 pair no farther apart than 0.25 among 4 sentences" in out

    assert grammar("confuse", path, "--json") == 0
    (pair,) = json.loads(capsys.readouterr().out)["pairs"]
    assert pair["difference"] == ["ball", "wall"]


@pytest.fixture
def coded_voices(monkeypatch):
    """Voices whose sound tells the engine what to hear: all is "turn left" but one."""

    def spoken(grammar, sentences, voices):
        for sentence in sentences:
            found = parse(grammar, sentence)
            meaning = None if found is None else meaning_of(found)
            answer = 3 if "ball" in sentence or "wall" in sentence else int("right" in sentence)
            for voice in voices:
                samples = np.full(1600, answer if meaning else 2, np.int16)
                yield RecordedClip(voice, samples, 16000, sentence, meaning)

    monkeypatch.setattr(confuse, "spoken", spoken)
    monkeypatch.setattr(calibrate, "spoken", spoken)


def test_sentences_are_spoken_and_heard_again(grammar, write, coded_voices, capsys):
    path = write(RULES)
    assert grammar("confuse", path, "--speak", "--voices", "en-us", "en-gb") == 0
    out = capsys.readouterr().out
    assert '2 of 2 voices: "go to the ball" was taken for "go to the wall"' in out
    assert "4 sentences in 2 voices, right and accepted 6 of 8" in out

    assert grammar("confuse", path, "--speak", "--strictness", "0.8", "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert {missed["said"] for missed in told["missed"]} == {"go to the ball", "go to the wall"}


@pytest.mark.proves("R03")
def test_a_strictness_is_recommended(grammar, write, coded_voices, capsys):
    path = write(RULES)
    assert grammar("calibrate", path, "--voices", "en-us") == 0
    out = capsys.readouterr().out
    assert "<- recommended" in out
    assert "too few to be reliable: try 20 commands and 20 others" in out
    assert '<Parameter name="strictness" value="0.9"/>' in out

    assert grammar("calibrate", path, "--voices", "en-us", "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert told["too_few"] is True
    accepted = {one["strictness"]: one["foreign_accepted"] for one in told["scores"]}
    assert accepted[0.3] > 0 == accepted[0.35]


def test_recordings_without_other_talk_cannot_calibrate(grammar, write, manifest, capsys):
    path = manifest((0, "turn left"))
    assert grammar("calibrate", write(RULES), "--audio", path) == 2
    assert "no out-of-grammar recordings" in capsys.readouterr().err


@pytest.mark.parametrize("voice", ["martian", "flite:martian"])
def test_an_unknown_voice_is_told(grammar, write, capsys, voice):
    assert grammar("confuse", write(RULES), "--speak", "--voices", voice) == 2
    assert 'no voice "martian"' in capsys.readouterr().err


def test_flite_speaks_where_it_is_installed():
    if not flite.is_there():
        pytest.skip("flite is not installed: apt install flite")
    samples, rate = flite.speak("hello robot", "slt")
    assert rate == 16000
    assert np.abs(samples).max() > 1000
