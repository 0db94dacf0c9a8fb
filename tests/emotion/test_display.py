import csv
from dataclasses import astuple, replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core import paths
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import EmotionState, Expression, Prosody
from hri.core.toml import load_toml
from hri.emotion.display import (
    EXPRESSIONS,
    LABELS,
    DisplayRule,
    Felt,
    display_path,
    felt_now,
    load_display,
)
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import EMOTIONS, INDEX, NAMES
from hri.emotion.model_spec import load_emotions
from hri.face import vocabulary
from tests.emotion.streams import Stream, models, play, streams
from tests.recorded import SHARED, needs_shared

SCHROEDER = "emotion_tables/schroeder_mary_prosody.tsv"
DISPLAY = load_display()
axes = st.floats(-1, 1)
shares = st.floats(0, 1)


def coordinates(name: str) -> Felt:
    emotion = EMOTIONS[INDEX[name]]
    return emotion.pleasure, emotion.arousal, emotion.dominance


def test_it_knows_what_faces_can_show() -> None:
    assert EXPRESSIONS == vocabulary.EXPRESSIONS


def test_every_face_of_the_house_can_show_every_label() -> None:
    wanted = {look.expression for look in DISPLAY.looks.values()}
    for name in ("robot", "person", "eyes"):
        settings = load_toml(paths.find("faces", name) / "face.toml")
        assert wanted <= set(settings.table("expressions").keys()), name


def test_every_label_has_a_look_and_words_of_its_own() -> None:
    words = [DISPLAY.looks[label].words for label in LABELS]
    assert len(set(words)) == len(words)
    assert all(DISPLAY.looks[name].expression != "neutral" for name in NAMES)


def test_what_feels_bad_never_shows_as_a_smile_nor_the_other_way_round() -> None:
    valence = {label: place[0] for label, place in vocabulary.AFFECT.items()}
    for emotion in EMOTIONS:
        # Those without a place, such as guilty, are neither smile nor frown.
        shown = valence.get(DISPLAY.looks[emotion.name].expression, emotion.pleasure)
        assert shown * emotion.pleasure > 0, emotion.name


@needs_shared(SCHROEDER)
def test_the_voice_follows_schroeder() -> None:
    lines = [line for line in (SHARED / SCHROEDER).read_text().splitlines() if line[0] != "#"]
    rows = {row["parameter"]: row for row in csv.DictReader(lines, delimiter="\t")}
    for name, rule in (("rate", DISPLAY.rate), ("pitch", DISPLAY.pitch)):
        row = rows[name]
        assert rule.arousal == float(row["activation"])
        assert rule.pleasure == float(row["evaluation"])
        assert rule.dominance == float(row["power"])
    plain = float(rows["volume"]["constant"])
    volume_per_arousal = 100 * float(rows["volume"]["activation"]) / plain
    assert DISPLAY.volume.arousal == pytest.approx(volume_per_arousal)
    semitones = rows["range"]
    range_per_arousal = 100 * float(semitones["activation"]) / float(semitones["constant"])
    assert DISPLAY.range.arousal == pytest.approx(range_per_arousal)
    for name, rule in (("volume", DISPLAY.volume), ("range", DISPLAY.range)):
        assert rule.pleasure == float(rows[name]["evaluation"])
        assert rule.dominance == float(rows[name]["power"])


def test_a_file_without_a_range_leaves_the_melody_alone(tmp_path) -> None:
    lines = display_path().read_text(encoding="utf-8").splitlines(keepends=True)
    path = tmp_path / "display.toml"
    path.write_text("".join(line for line in lines if not line.startswith("range")))

    anger = EmotionState("anger", 0.5, 0.0, 0.5, 0.0)
    assert load_display(path).prosody(anger).range == 1.0


def test_anger_and_sadness_sound_as_published() -> None:
    anger, sadness = coordinates("anger"), coordinates("sadness")
    assert DISPLAY.rate.value(anger) == pytest.approx(1.19, abs=0.01)
    assert DISPLAY.pitch.value(anger) == pytest.approx(1.10, abs=0.01)
    assert DISPLAY.pitch.value(sadness) == pytest.approx(0.89, abs=0.01)
    assert DISPLAY.rate.value(sadness) == pytest.approx(0.75), "capped, published is 0.74"


@settings(deadline=None)
@given(axes, axes, axes)
def test_everything_that_follows_stays_within_limits(p: float, a: float, d: float) -> None:
    state = EmotionState("calm", 0.0, p, a, d, {"joy": 1.0, "anger": 1.0, "fear": 0.7})
    felt = felt_now(state)
    assert (np.abs(felt) <= 1).all()
    prosody = DISPLAY.prosody(state)
    assert (np.abs(astuple(prosody.quality)) <= 1).all()
    assert 0.75 <= prosody.rate <= 1.25
    assert 0.8 <= prosody.pitch <= 1.2
    assert 0.7 <= prosody.volume <= 1.3
    assert 0.5 <= prosody.range <= 1.6
    assert 0.6 <= DISPLAY.speed.value(felt) <= 1.2


def test_nothing_felt_changes_nothing() -> None:
    calm = EmotionState("calm", 0.0, 0.0, 0.0, 0.0)
    assert DISPLAY.prosody(calm) == Prosody()
    assert DISPLAY.speed.value(felt_now(calm)) == 1.0


def test_half_a_fear_trembles_half_as_much() -> None:
    whole, half = (
        DISPLAY.prosody(EmotionState("fear", share, 0.0, 0.0, 0.0, {"fear": share}))
        for share in (1.0, 0.5)
    )
    assert whole.quality.tremble > 0.5
    assert half.quality.tremble == pytest.approx(whole.quality.tremble / 2)
    assert 1.0 < half.pitch <= whole.pitch


@pytest.mark.parametrize(
    ("line", "what"),
    [("fear = { breath = -0.5 }", "breath"), ("fear = { wobble = 1 }", "wobble")],
)
def test_a_mistake_in_the_voice_of_an_emotion_has_its_line(tmp_path, line: str, what: str) -> None:
    text = display_path().read_text(encoding="utf-8")
    begin = text.index("fear = {", text.index("[voice.of]"))
    path = tmp_path / "display.toml"
    path.write_text(text[:begin] + line + text[text.index("\n", begin) :], encoding="utf-8")
    with pytest.raises(AuthoringError, match=what) as refused:
        load_display(path)
    assert refused.value.place.line == text[:begin].count("\n") + 1


def test_an_emotion_shows_before_the_mood_has_moved() -> None:
    felt = felt_now(EmotionState("joy", 0.7, 0.0, 0.0, 0.0, {"joy": 0.7}))
    assert felt[0] > 0.4
    assert DISPLAY.speed.value(felt) > 1.1


def test_the_face_follows_the_label_above_the_mood() -> None:
    joy = EmotionState("joy", 0.5, 0.4, -0.2, 0.0)
    happy = DISPLAY.expression(joy)
    assert happy == Expression("happy", pytest.approx(0.7), valence=0.4, arousal=-0.2)
    reserved = DISPLAY.expression(joy, expressiveness=0.5)
    assert reserved == Expression("happy", pytest.approx(0.35), valence=0.2, arousal=-0.1)
    scared = DISPLAY.expression(EmotionState("fear", 1.0, -1.0, 1.0, 0.0), expressiveness=2.0)
    assert scared == Expression("scared", 1.0, valence=-1.0, arousal=1.0)


def test_the_ashamed_look_down_and_the_proud_hold_their_eyes_up() -> None:
    assert DISPLAY.eyes(coordinates("shame")).y < -0.3
    assert DISPLAY.eyes(coordinates("pride")).y > 0.2
    assert DISPLAY.eyes((0.0, 0.0, 0.0)).y == 0.0


def test_who_is_polite_shows_little_of_an_anger_that_is_felt() -> None:
    angry = EmotionState("anger", 0.8, -0.2, 0.3, 0.1, {"anger": 0.8, "joy": 0.0})
    shown = DISPLAY.shown(angry, "polite")
    assert shown.label == "anger"
    assert 0.2 < shown.intensity < 0.4
    assert shown.emotions["anger"] == shown.intensity
    assert (shown.valence, shown.arousal) == (angry.valence, angry.arousal)
    assert angry.emotions["anger"] == 0.8, "what is felt stays as it is"


def test_a_disappointment_hides_behind_a_smile() -> None:
    felt = EmotionState("disappointment", 0.7, -0.1, 0.0, 0.0, {"disappointment": 0.7, "joy": 0.1})
    shown = DISPLAY.shown(felt, "polite")
    assert shown.label == "joy"
    assert shown.emotions["disappointment"] == 0.0
    assert shown.emotions["joy"] == pytest.approx(1 - 0.9 * 0.3**0.3)
    assert DISPLAY.expression(shown).label == "happy"


def test_what_is_hidden_altogether_leaves_a_calm_face() -> None:
    felt = EmotionState("hate", 0.7, -0.4, 0.0, 0.0, {"hate": 0.7})
    shown = DISPLAY.shown(felt, "polite")
    assert (shown.label, shown.intensity, shown.emotions["hate"]) == ("calm", 0.0, 0.0)


def test_behind_what_is_hidden_the_next_feeling_shows() -> None:
    felt = EmotionState("hate", 0.7, -0.4, 0.0, 0.0, {"hate": 0.7, "joy": 0.1, "surprise": 0.4})
    shown = DISPLAY.shown(felt, "polite")
    assert (shown.label, shown.intensity) == ("surprise", 0.4)


def test_a_weakened_feeling_steps_behind_a_stronger_one() -> None:
    emotions = {"anger": 0.6, "surprise": 0.5}
    shown = DISPLAY.shown(EmotionState("anger", 0.6, 0.0, 0.0, 0.0, emotions), "polite")
    assert (shown.label, shown.intensity) == ("surprise", 0.5)
    emotions["surprise"] = shown.emotions["anger"] * 0.9
    shown = DISPLAY.shown(EmotionState("anger", 0.6, 0.0, 0.0, 0.0, emotions), "polite")
    assert shown.label == "anger"


@settings(deadline=None)
@given(models, streams, st.floats(0, 100))
def test_rules_about_what_is_not_felt_change_nothing(
    model: Dynamics, stream: Stream, until: float
) -> None:
    state = model.read(play(model, stream, until))
    unfelt = [name for name in NAMES if not state.emotions[name]]
    rules = {name: DisplayRule(name, 2.0) for name in unfelt}
    shown = replace(DISPLAY, rules={"idle": rules}).shown(state, "idle")
    assert shown.label == state.label
    assert shown.intensity == pytest.approx(state.intensity, abs=1e-12)


def test_a_state_without_intensities_can_be_shown_too() -> None:
    assert DISPLAY.shown(EmotionState("anger", 0.5, 0.0, 0.0, 0.0), "polite").label == "calm"


def test_without_rules_all_is_shown_and_unknown_rules_are_refused() -> None:
    felt = EmotionState("joy", 0.7, 0.0, 0.0, 0.0, {"joy": 0.7})
    assert DISPLAY.shown(felt) is felt
    with pytest.raises(HriError, match='did you mean "polite"'):
        DISPLAY.shown(felt, "polit")


@settings(deadline=None)
@given(
    st.dictionaries(st.sampled_from(NAMES), shares),
    st.sampled_from(sorted(DISPLAY.rules)),
    st.data(),
)
def test_what_is_shown_stays_within_limits(
    emotions: dict[str, float], rules: str, data: st.DataObject
) -> None:
    label = data.draw(st.sampled_from([*emotions, "calm", "hostile"]))
    shown = DISPLAY.shown(
        EmotionState(label, emotions.get(label, 0.2), 0.0, 0.0, 0.0, emotions), rules
    )
    assert all(0 <= intensity <= 1 for intensity in shown.emotions.values())
    assert 0 <= shown.intensity <= 1
    expression = DISPLAY.expression(shown)
    assert expression.label in EXPRESSIONS
    assert 0 <= expression.intensity <= 1


def test_moods_may_go_by_their_former_names(tmp_path: Path) -> None:
    text = display_path().read_text().replace("trusting =", "dependent =")
    path = tmp_path / "display.toml"
    path.write_text(text)

    assert load_display(path).looks == DISPLAY.looks


def felt(label: str, intensity: float) -> EmotionState:
    return EmotionState(label, intensity, 0.0, 0.0, 0.0)


def test_the_base_moves_for_what_is_felt_strongly_enough() -> None:
    assert DISPLAY.motion(felt("calm", 1.0)) is None
    for emotion, motion in DISPLAY.motions.items():
        assert DISPLAY.motion(felt(emotion, motion.above)) == motion
        assert DISPLAY.motion(felt(emotion, motion.above - 0.01)) is None
        assert DISPLAY.motion(felt(emotion, motion.above), 0.5) is None


def test_the_base_ends_as_it_began() -> None:
    """It would lose sight of the people if each feeling turned it a little."""
    assert DISPLAY.motions
    for emotion, motion in DISPLAY.motions.items():
        assert sum(motion.turns) == pytest.approx(0.0), emotion


def test_the_shy_are_slower() -> None:
    dynamics = [load_emotions(name).dynamics() for name in ("shy", "neutral")]
    states = [one.read(one.rest(0.0)) for one in dynamics]
    shy, neutral = (DISPLAY.speed.value(felt_now(state)) for state in states)
    assert shy < 0.95 * neutral


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ("joy = { turns = [8] }", "above"),
        ("joy = { above = 0.5, turns = [90] }", "turns from -45 to 45 degrees"),
        ("joy = { above = 0.5, turns = [1, 1, 1, 1, 1, 1, 1, 1, 1] }", "write up to 8 turns"),
        ("joy = { above = 0.5, backs_off = 1 }", "backs_off"),
        ("joy = { above = 0.5, turn = [8] }", "turns"),
        ("joi = { above = 0.5 }", '"joy"'),
    ],
)
def test_a_broken_motion_is_refused_with_its_place(
    entry: str, message: str, tmp_path: Path
) -> None:
    written = display_path().read_text(encoding="utf-8")
    before, _, _ = written.partition("[motion]")
    file = tmp_path / "display.toml"
    file.write_text(f"{before}[motion]\n{entry}\n", encoding="utf-8")
    line = before.count("\n") + 2
    with pytest.raises(HriError) as caught:
        load_display(file)
    assert f"display.toml:{line}" in str(caught.value)
    assert message in str(caught.value)
