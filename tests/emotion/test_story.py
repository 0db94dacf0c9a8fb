"""Stories: what happens in plain words, and what one would expect to be felt."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from hri.core import paths
from hri.core.errors import AuthoringError
from hri.emotion.explanation import explained
from hri.emotion.model_spec import load_emotions
from hri.emotion.stimulus import load_stimuli
from hri.emotion.story import Expected, Felt, Moment, load_story, played

STORIES = sorted((paths.house() / "emotions" / "stories").glob("*.txt"))
ENOUGH = 0.9
"""Of all expectations, those that must be met: writers who did not know the program wrote them."""


def moments_of(path: Path) -> Sequence[Moment]:
    story = load_story(path, load_emotions)
    return list(played(story, load_emotions(story.personality)))


def story_of(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "story.txt"
    path.write_text(text, encoding="utf-8")
    return path


def test_what_happens_in_the_stories_is_felt_as_expected() -> None:
    assert len(STORIES) >= 30
    moments = [moment for path in STORIES for moment in moments_of(path)]
    expected = [moment for moment in moments if isinstance(moment.line.what, Expected)]
    kinds = {moment.line.what.kind for moment in expected if isinstance(moment.line.what, Expected)}
    assert kinds == {"", "not", "mood", "because"}
    for kind in kinds:
        of_kind = [
            moment.failure == ""
            for moment in expected
            if isinstance(moment.line.what, Expected) and moment.line.what.kind == kind
        ]
        assert sum(of_kind) >= ENOUGH * len(of_kind), kind


def test_no_answer_in_the_stories_has_a_hole() -> None:
    for path in STORIES:
        for moment in moments_of(path):
            assert moment.because.startswith("I ")
            assert moment.because.endswith(".")
            assert "{" not in moment.because
            assert "  " not in moment.because


def test_who_comes_late_is_waited_for(tmp_path: Path) -> None:
    text = """title: Late
0:00  hope: Anna comes (worth 0.8, likely 0.9, within 5 min)
      waiting: Anna is not here yet
      fulfilled: Anna came
      failed: Anna did not come
1:00  expect because: Anna is not here yet
9:00  expect: fear
12:00 happened: Anna comes (by Anna)
12:01 expect because: Anna came
"""
    moments = moments_of(story_of(tmp_path, text))
    assert [moment.failure for moment in moments] == [""] * 5
    assert moments[0].because == "I am hopeful even though Anna is not here yet."


def test_an_apology_is_said_with_what_it_was_for(tmp_path: Path) -> None:
    text = "0:00 Anna kicked me\n0:05 Anna said sorry\n0:06 expect because: so I am less angry"
    moments = moments_of(story_of(tmp_path, text))
    told = "I was angry because Anna kicked me. But then Anna said sorry, so I am less angry now."
    assert moments[-1].because == told
    assert moments[-1].failure == ""


def test_names_stand_where_the_words_have_somebody(tmp_path: Path) -> None:
    text = """0:00 somebody praised me (0.5)
0:01 Jo was rude to me
0:02 Al is with me
0:03 over: Al is with me
"""
    felt = [line.what for line in load_story(story_of(tmp_path, text), load_emotions).lines]
    assert felt == [
        Felt("praise", 0.5, None),
        Felt("insulted", 1.0, "Jo"),
        Felt("company", 1.0, "Al"),
        Felt("company", 0.0, "Al"),
    ]


def test_one_story_is_another_for_each_personality() -> None:
    """The worrier worries sooner, the proud one forgives later, the gentle one minds others."""

    def lived(name: str, personality: str) -> dict[str, float]:
        model = load_emotions(personality)
        story = load_story(paths.house() / "emotions" / "stories" / f"{name}.txt", load_emotions)
        moments = list(played(story, model))
        sums = dict.fromkeys(("fear", "anger", "pity", "pride"), 0.0)
        for moment in moments:
            for emotion in sums:
                sums[emotion] += moment.state.emotions[emotion]
        return sums

    neutral, worrier = (lived("the_package", who)["fear"] for who in ("neutral", "worrier"))
    assert worrier > 1.2 * neutral
    kicks = {who: lived("kicked_and_sorry", who)["anger"] for who in ("gentle", "neutral", "proud")}
    assert kicks["gentle"] < 0.7 * kicks["neutral"] < 0.7 * kicks["proud"]
    assert lived("sad_friend", "gentle")["pity"] > 1.1 * lived("sad_friend", "neutral")["pity"]
    praised = {who: lived("ten_praises", who)["pride"] for who in ("neutral", "proud")}
    assert praised["proud"] > 1.2 * praised["neutral"]


def test_what_is_over_is_said_in_the_past(tmp_path: Path) -> None:
    text = "0:00 I am all alone\n30:00 over: I am all alone\n"
    told = [
        moment.because for moment in moments_of(story_of(tmp_path, text + "30:01 expect: relief"))
    ]
    assert told[-1] == "I am relieved because I am not alone anymore."
    battery = load_stimuli()["battery_low"]
    assert battery.past_words(is_pleasant=False) == "my battery was low"
    assert battery.past_words(is_pleasant=True) == "my battery is not low anymore"
    model = load_emotions("neutral")
    last = moments_of(story_of(tmp_path, text))[-1].affect
    told = explained(model, model.dynamics(), last, "sad")
    assert told == "I am still sad because I was all alone."


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("0:00 Anna prazed me", 'did you mean "{you} praised me"'),
        ("0:00 expect: joyy", 'no feeling "joyy" - did you mean "joy"'),
        ("0:00 expect mood: gud", 'no feeling "gud"'),
        ("0:00 deed: Ben lied (bad 1)", '"bad 1"'),
        ("0:00 hope: x (worth 2)", 'worth is "2" - write a number from 0 to 1'),
        ("0:00 hope: x (within long)", '"long" is not a time - write such as 5 min'),
        ("0:00 hope: x (appeal 1)", '"appeal" says nothing here'),
        ("0:00 failed: x", 'no goal "x" before'),
        ("0:00 over: Anna praised me", "does not last - leave out over:"),
        ("0:00 wish: x", 'no "wish:"'),
        (f"0:00 {'x' * 101} praised me", "person has 101 letters"),
        ("0:00 hope: x (within 1.2.3 min)", '"1.2.3 min" is not a time'),
        ("1:00 Anna praised me\n0:30 Anna praised me", "the times go back"),
        ("0:00 Anna praised me\nwaiting: x", "waiting belongs to no goal"),
        ("0:00 Anna praised me\nand then", "has no time"),
        ("hello", "begin with title:"),
    ],
)
def test_a_wrong_line_is_refused_with_its_place(tmp_path: Path, line: str, problem: str) -> None:
    path = story_of(tmp_path, line)
    with pytest.raises(AuthoringError) as caught:
        load_story(path, load_emotions)
    assert problem in str(caught.value)
    assert str(caught.value).startswith(f"{path}:{line.count(chr(10)) + 1}:")
