import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from hri.cli.emotion.stimulus_timeline import read_timeline
from hri.core.errors import AuthoringError, HriError, Place
from hri.core.signals import EmotionState
from hri.emotion.display import LABELS, display_path, load_display
from hri.emotion.expectation import Expectation
from hri.emotion.model_spec import load_emotions
from hri.emotion.personality import load_personality, personality_path
from hri.emotion.reachability import unmet_expectations, unreachable_emotions, unreachable_stimuli
from hri.emotion.stimulus import load_stimuli

SHIPPED = (
    "neutral", "optimist", "pessimist", "shy", "hot_tempered", "easy_going", "curious", "gentle",
    "proud", "worrier",
)  # fmt: skip
TICKLED = '[stimulus.tickled]\nwords = "you tickled me"\n'


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


def test_every_emotion_can_be_caused_and_every_expectation_is_met() -> None:
    stimuli = load_stimuli()
    assert unreachable_emotions(stimuli) == []
    assert list(unmet_expectations(stimuli)) == []
    assert all(spec.expects for spec in stimuli.values())


def test_the_six_basic_emotions_are_caused_by_stimuli() -> None:
    caused = {name for spec in load_stimuli().values() for name in spec.emotions}
    assert {"joy", "sadness", "anger", "fear", "surprise", "disgust"} <= caused


def test_an_optimist_differs_only_as_the_ordering_allows() -> None:
    optimist, pessimist = load_personality("optimist"), load_personality("pessimist")
    assert optimist.baseline > pessimist.baseline
    assert optimist.positive.gain > pessimist.positive.gain
    assert optimist.negative.gain < pessimist.negative.gain
    assert (optimist.return_s, optimist.follow_s) == (pessimist.return_s, pessimist.follow_s)


def test_an_unknown_personality_is_named_with_a_remedy() -> None:
    with pytest.raises(HriError, match='did you mean "optimist"'):
        load_personality("optimst")


def test_names_may_be_written_with_hyphens() -> None:
    assert load_personality("hot-tempered") == load_personality("hot_tempered")
    assert load_personality("easy-going").name == "easy_going"


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
        ('[stimulus.other]\nwords = "x"\nemotions = { joy = 0.5 }\n', "taken already"),
        ('[stimulus."a.b"]\nwords = "x"\n', "not a valid stimulus name"),
        ('[stimuli.x]\nwords = "x"\n', 'did you mean "stimulus"'),
        ("schema = 2\n", "from 1 to 1"),
        (TICKLED + 'trigger = "touched"\n', "is not a trigger"),
        (f'[stimulus.x]\nwords = "{"x" * 300}"\n', "300 letters"),
        ('[stimulus.x]\nwords = "{you praised me"\n', "has a brace too many"),
        ('[stimulus.x]\nwords = "{} praised me"\n', "has a brace too many"),
        (TICKLED + "intensity = 2\n", "from 0 to 1"),
        (TICKLED + "intensity = true\n", "true or false"),
        (TICKLED + 'intensity = "value ** 2"\n', "has no place in a formula"),
        (TICKLED + 'intensity = "sine(value)"\n', 'no function "sine"'),
        (TICKLED + "satisfies = { plays = 0.1 }\n", 'did you mean "play"'),
        (TICKLED + "satisfies = { play = 2 }\n", "from 0 to 1"),
        (TICKLED + "relation = nan\n", "from -1 to 1"),
        (TICKLED + "[[stimulus.tickled.expect]]\ndominant = 'joi'\n", 'did you mean "joy"'),
        (TICKLED + "[[stimulus.tickled.expect]]\ntimes = 1.5\n", "whole number"),
        (TICKLED + "[[stimulus.tickled.expect]]\n" * 21, "21 expectations"),
        (TICKLED + "[[stimulus.tickled.expect]]\ntimes = 1e9\n", "from 1 to 100"),
        (TICKLED + "[[stimulus.tickled.expect]]\npleasure = [0.5, 0.1]\n", "least and the most"),
        (TICKLED + "[[stimulus.tickled.expect]]\nplesure = [0, 1]\n", 'did you mean "pleasure"'),
        (TICKLED + "[[stimulus.tickled.expect]]\nat_least = { joi = 1 }\n", 'mean "joy"'),
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
        ("schema = 1", "schema = 7", "from 1 to 1"),
        ("minimum = -0.6", "minimum = 0.6", "from -1 to 0"),
        ("[rules.polite]\nanger", "[rules.polite]\nangr", 'did you mean "anger"'),
        ('show = "joy"', 'show = "happy"', 'show is "happy"'),
        ("gain = 0.25", "gain = -1", "from 0 to 5"),
    ],
)
def test_a_wrong_display_is_refused(tmp_path: Path, old: str, new: str, what: str) -> None:
    text = display_path().read_text(encoding="utf-8")
    path = tmp_path / "display.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(AuthoringError, match=what):
        load_display(path)


def test_a_stimulus_is_as_strong_as_its_formula_says(write: Callable[[str, str], Path]) -> None:
    write(
        "stimuli/mine.toml",
        TICKLED
        + 'trigger = "head.touched"\nintensity = "clip(2 * value, 0, 1)"\nperson = "guest"\n',
    )
    tickled = load_stimuli()["tickled"]
    assert tickled.trigger == "head.touched"
    assert [tickled.intensity({"value": value}) for value in (-1, 0.25, 7)] == [0.0, 0.5, 1.0]
    assert tickled.doer({"value": 1}) == "guest"
    assert tickled.doer({"person": "Anna"}) == "Anna"
    assert load_stimuli()["bump"].doer({}) is None


def test_an_unmet_expectation_is_told_with_its_place(write: Callable[[str, str], Path]) -> None:
    path = write(
        "stimuli/mine.toml",
        TICKLED
        + "emotions = { joy = 0.5 }\n[[stimulus.tickled.expect]]\ndominant = 'joy'\n"
        + "[[stimulus.tickled.expect]]\nafter_s = 5\ndominant = 'anger'\nat_least = { joy = 0.9 }\n"
        + "at_most = { joy = 0.1 }\npleasure = [0.5, 1.0]\n"
        + "[[stimulus.tickled.expect]]\npersonality = 'nobody'\n",
    )
    told = [str(error) for error in unmet_expectations(load_stimuli())]
    assert [text.startswith(f"{path}:6:1: tickled, neutral, after 5 s") for text in told[:4]] == [
        True
    ] * 4
    assert "anger was to be dominant, but joy is" in told[0]
    assert "joy is 0.367, not 0.9 or more" in told[1]
    assert "joy is 0.367, not 0.1 or less" in told[2]
    assert "pleasure is" in told[3]
    assert told[4].startswith(f'{path}:12:1: no "nobody"')
    assert len(told) == 5


def test_what_can_never_be_felt_is_told(write: Callable[[str, str], Path]) -> None:
    write(
        "stimuli/mine.toml",
        TICKLED
        + 'emotions = { joy = 0.5 }\ntrigger = "bumper.presed"\n'
        + '[stimulus.faint]\nwords = "x"\nemotions = { joy = 0.5 }\nintensity = 0\n'
        + '[stimulus.empty]\nwords = "x"\n'
        + '[stimulus.full]\nwords = "x"\nemotions = { joy = 0.5 }\ntrigger = "battery.level"\n',
    )
    known = {spec.trigger for spec in load_stimuli().values() if spec.name != "tickled"}
    ends = {"drive.commanded"}
    told = list(unreachable_stimuli(load_stimuli(), known | ends, {"battery"}))
    assert len(told) == 3
    more = sorted(set(unreachable_stimuli(load_stimuli(), known, {"battery"})) - set(told))
    for stimulus, text in zip(("held_up", "stuck"), more, strict=True):
        assert text.startswith(f'{stimulus}: nothing raises "drive.commanded", which ends it')
    assert 'nothing raises "bumper.presed" - did you mean "bumper.pressed"?' in told[0]
    assert told[1].startswith("faint: its intensity is 0")
    assert told[2].startswith("empty: it moves nothing")


def test_an_emotion_that_only_a_stimulus_can_cause_is_missed_without_one() -> None:
    stimuli = load_stimuli()
    calm = {name: spec for name, spec in stimuli.items() if "disgust" not in spec.emotions}
    assert unreachable_emotions(calm) == ["disgust"]


def test_an_expectation_allows_for_rounding() -> None:
    state = EmotionState("joy", 0.3, 0.1, 0.0, 0.0, {"joy": 0.1 + 0.2})
    exact = Expectation(Place(Path("x")), at_most={"joy": 0.3}, at_least={"joy": 0.3})
    assert list(exact.failures(state)) == []


SHIPPED_TEXTS = {
    load_display: display_path().read_text(encoding="utf-8"),
    lambda path: load_personality(str(path)): personality_path("curious").read_text("utf-8"),
    lambda path: read_timeline(path, ["praise"]): '[[event]]\nt = 1\ngoal = "a"\nutility = 1\n',
}


@settings(deadline=None, max_examples=60)
@given(
    st.sampled_from(list(SHIPPED_TEXTS)),
    st.sampled_from(
        ["nan", "inf", "-1e999", "[", "{", "=", '"', "\n[x]\n", "\0", "9" * 5000, "é", ""]
    ),
    st.integers(0, 5000),
    st.integers(0, 30),
)
def test_no_damage_to_a_file_does_more_than_be_refused(
    load: Callable[[Path], object], noise: str, cut: int, gap: int
) -> None:
    text = SHIPPED_TEXTS[load]
    cut = cut % len(text)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "damaged.toml"
        path.write_text(text[:cut] + noise + text[cut + gap :], encoding="utf-8")
        with suppress(HriError):
            load(path)
