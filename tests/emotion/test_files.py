from collections.abc import Callable
from pathlib import Path

import pytest

from hri.core.errors import AuthoringError, HriError
from hri.emotion.display import LABELS, display_path, load_display
from hri.emotion.emotions import NAMES
from hri.emotion.model import load_emotions
from hri.emotion.personality import load_personality
from hri.emotion.stimulus import load_stimuli

SHIPPED = ("neutral", "optimist", "pessimist", "shy", "hot_tempered", "easy_going")


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str, str], Path]:
    """Writes a file into a search folder that comes before the house."""
    monkeypatch.setenv("HRI_PATH", str(tmp_path))

    def written(name: str, text: str) -> Path:
        path = tmp_path / "emotions" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.mark.parametrize("name", SHIPPED)
def test_the_shipped_files_load(name: str) -> None:
    model = load_emotions(name)
    assert model.personality.name == name
    assert set(model.display.looks) == set(LABELS)
    assert {"praise", "scold", "ignored", "bump", "person_seen", "battery_low"} <= set(
        model.stimuli
    )


def test_every_emotion_can_be_caused() -> None:
    caused = {name for spec in load_stimuli().values() for name in spec.emotions}
    assert caused == set(NAMES)


def test_an_optimist_differs_only_as_the_ordering_allows() -> None:
    optimist, pessimist = load_personality("optimist"), load_personality("pessimist")
    assert optimist.baseline > pessimist.baseline
    assert optimist.positive.gain > pessimist.positive.gain
    assert optimist.negative.gain < pessimist.negative.gain
    assert (optimist.return_s, optimist.follow_s) == (pessimist.return_s, pessimist.follow_s)


def test_an_unknown_personality_is_named_with_a_remedy() -> None:
    with pytest.raises(HriError, match='did you mean "optimist"'):
        load_personality("optimst")


def test_a_personality_can_be_a_path(tmp_path: Path) -> None:
    path = tmp_path / "grumpy.toml"
    path.write_text("[baseline]\npleasure = -0.5\n", encoding="utf-8")
    assert load_personality(str(path)).baseline == (-0.5, 0.0, 0.0)


@pytest.mark.parametrize(
    ("text", "line", "what"),
    [
        ("[emotion.angr]\ngain = 2\n", 1, 'did you mean "anger"'),
        ("[positive]\ngain = -1\n", 2, "from 0 to 5"),
        ("[baseline]\npleasure = 1.0\n", 2, "from -0.9 to 0.9"),
        ("[baseline]\npleasur = 0.1\n", 2, 'did you mean "pleasure"'),
        ("[mood]\nreturn_s = nan\n", 2, "from 1 to 86400"),
        ("expresiveness = 1\n", 1, 'did you mean "expressiveness"'),
    ],
)
def test_a_wrong_personality_is_refused_with_its_place(
    tmp_path: Path, text: str, line: int, what: str
) -> None:
    path = tmp_path / "wrong.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(AuthoringError, match=what) as caught:
        load_personality(str(path))
    assert caught.value.place.line == line


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ('[stimulus.x]\nwords = "x"\nemotions = { joi = 1 }\n', 'did you mean "joy"'),
        ('[stimulus.x]\nwords = "x"\nemotions = { joy = 1.0 }\n', "from 0 to 0.95"),
        ("[stimulus.x]\nemotions = { joy = 0.5 }\n", "words"),
        ('[stimulus.praise]\nwords = "x"\nemotions = { joy = 0.5 }\n', "taken already"),
        ('[stimulus.temperament]\nwords = "x"\nemotions = { joy = 0.5 }\n', "taken already"),
        ('[stimuli.x]\nwords = "x"\n', 'did you mean "stimulus"'),
    ],
)
def test_wrong_stimuli_are_refused(write: Callable[[str, str], Path], text: str, what: str) -> None:
    write("stimuli/wrong.toml", text)
    with pytest.raises(AuthoringError, match=what):
        load_stimuli()


def test_a_file_of_the_user_adds_stimuli(write: Callable[[str, str], Path]) -> None:
    write("stimuli/mine.toml", '[stimulus.tickled]\nwords = "x"\nemotions = { joy = 0.5 }\n')
    assert {"tickled", "praise"} <= set(load_stimuli())


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ('"happy"', '"hapy"', 'did you mean "happy"'),
        ("joy =", "joi =", 'did you mean "joy"'),
        ("minimum = 0.75", "minimum = 1.5", "from 0.1 to 1"),
        ("[drive]", "[driv]", 'did you mean|"drive" is missing'),
    ],
)
def test_a_wrong_display_is_refused(tmp_path: Path, old: str, new: str, what: str) -> None:
    text = display_path().read_text(encoding="utf-8")
    path = tmp_path / "display.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(AuthoringError, match=what):
        load_display(path)
