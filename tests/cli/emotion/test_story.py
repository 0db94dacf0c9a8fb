import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from hri.cli.emotion.story_film import scene_of_story
from hri.cli.main import main
from hri.core.signals import Prosody, Speech
from hri.emotion.model_spec import load_emotions
from hri.emotion.story import load_story, played

TEXT = """title: A short visit
0:00 I saw Anna
0:10 Anna praised me
0:12 expect: joy
0:13 expect because: Anna praised me
"""


@pytest.fixture
def story(tmp_path: Path) -> Path:
    path = tmp_path / "visit.txt"
    path.write_text(TEXT, encoding="utf-8")
    return path


def test_a_story_is_told_with_what_is_felt_and_said(
    story: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["emotion", "story", str(story)]) == 0
    told = capsys.readouterr().out
    assert "A short visit  (visit.txt, neutral)" in told
    assert "I am happy because Anna praised me" in told
    assert told.endswith("1 story: 2 of 2 expectations met\n")


def test_what_is_not_as_expected_is_printed_with_its_place(
    story: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with story.open("a", encoding="utf-8") as file:
        file.write("0:14 expect: anger\n")
    assert main(["emotion", "story", "--quiet", str(story.parent)]) == 1
    told = capsys.readouterr().out.splitlines()
    assert told == [
        f"{story}:6:1: expect: anger: joy leads, not anger",
        "1 story: 2 of 3 expectations met",
    ]


def test_a_story_as_json_and_as_a_picture(
    story: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "visit.png"
    assert main(["emotion", "story", str(story), "--json", "--plot", str(picture)]) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [line["t"] for line in lines] == [0, 10, 12, 13]
    assert [line["is_expectation"] for line in lines] == [False, False, True, True]
    assert lines[1]["label"] == "joy"
    with Image.open(picture) as drawn:
        assert drawn.size[0] == 1200


def test_a_plot_is_of_one_story(story: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emotion", "story", str(story), str(story), "--plot", "x.png"]) == 2
    assert "--plot is of one story, not 2" in capsys.readouterr().err


def test_a_folder_without_stories_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["emotion", "story", str(tmp_path)]) == 2
    assert "no story there" in capsys.readouterr().err


def test_a_film_has_the_face_and_the_answer_of_each_event(tmp_path: Path) -> None:
    path = tmp_path / "alone.txt"
    path.write_text("0:00 Anna praised me\n1:00 I am all alone\n30:00 over: I am all alone\n")
    model = load_emotions("neutral")
    moments = list(played(load_story(path, load_emotions), model))
    asked: list[tuple[str, Prosody]] = []

    def voice(text: str, prosody: Prosody) -> Speech:
        asked.append((text, prosody))
        return Speech(text, np.zeros(24000, np.int16), 24000)

    scene = scene_of_story(model, moments, voice)
    assert [text for text, _ in asked] == [
        "I am happy because Anna praised me.",
        "I am sad because I am all alone.",
        "I am relieved because I am not alone anymore.",
    ]
    assert [cue.speech.text for cue in scene.cues if cue.speech is not None] == [
        text for text, _ in asked
    ]
    assert asked[0][1].pitch > 1.0 > asked[1][1].pitch
    faces = [cue.expression.label for cue in scene.cues if cue.expression is not None]
    assert set(faces) == {"happy", "sad"}
    assert scene.duration == 12.0


def test_the_sound_of_a_film_needs_a_film(story: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["emotion", "story", str(story), "--wav", "x.wav"]) == 2
    assert "add --film FILE" in capsys.readouterr().err
