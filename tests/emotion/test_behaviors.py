import math
import os
import re
import shutil
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from hri.behavior.behavior import Context
from hri.behavior.ports import OutputPort
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import EmotionState, Event, Expression, HeadPose, People, Person, Stimulus
from hri.emotion.appraisal import GoalEvent
from hri.emotion.behaviors import EmotionDisplay, EmotionModel
from hri.face.behaviors import Face
from hri.hal.resource_manager import ResourceManager

SEEN = {"p1": "Anna", "p2": ""}
"""Who is seen in a test, by id: not all have names."""


class Feeling:
    """A running emotion model that is ticked ten times a second."""

    def __init__(self, personality: str = "neutral") -> None:
        self.clock = FakeClock()
        self.context = Context(self.clock, EventBus(self.clock), ResourceManager([], self.clock))
        self.events: list[Event] = []
        self.context.events.subscribe("emotion.changed", self.events.append)
        self.model = EmotionModel(personality=personality)
        self.model.start(self.context)

    def live(self, seconds: float) -> EmotionState:
        for _ in range(round(seconds * 10)):
            self.model.compute(self.clock.now(), 0.1)
            self.clock.advance(0.1)
        return self.model.feeling()

    def labels(self) -> list[str]:
        labels = [event.properties["label"] for event in self.events]
        return [b for a, b in zip(["", *labels], labels, strict=False) if a != b]


@pytest.mark.proves("R04")
def test_praise_makes_happy_for_a_while_and_lifts_the_mood() -> None:
    feeling = Feeling()
    feeling.live(1.0)
    feeling.context.events.raise_event("stimulus.felt", stimulus="praise", intensity=1.0)
    state = feeling.live(15.0)
    assert state.valence > 0.15
    state = feeling.live(20.0)
    assert state.label == state.mood == "exuberant"
    assert feeling.model.feeling_words() == "fine"
    assert abs(feeling.live(600.0).valence) < 0.03
    assert feeling.labels()[:3] == ["calm", "joy", "exuberant"]
    assert feeling.labels()[-1] == "calm"
    assert len(feeling.labels()) <= 6


@pytest.mark.parametrize(
    ("personality", "label"), [("neutral", "sadness"), ("hot_tempered", "anger")]
)
def test_a_scolding_depends_on_the_personality(personality: str, label: str) -> None:
    feeling = Feeling(personality)
    feeling.model.feel("scold")
    assert feeling.live(15.0).label == label
    assert feeling.live(60.0).valence < -0.1


def test_a_bump_surprises_and_then_annoys() -> None:
    feeling = Feeling()
    feeling.model.feel("bump")
    feeling.live(10.0)
    assert feeling.labels() == ["surprise", "anger"]


def test_being_ignored_makes_sad_slowly() -> None:
    feeling = Feeling()
    intensities = []
    for _ in range(24):
        feeling.model.feel("ignored")
        intensities.append(feeling.model.feeling().emotions["sadness"])
        feeling.live(25.0)
    assert feeling.labels() == ["calm", "sadness"]
    assert intensities == sorted(intensities)
    assert intensities[1] < 0.25 < intensities[-1] <= 0.45
    assert feeling.model.feeling().valence < -0.1
    assert feeling.model.why_words() == "I am sad because nobody has talked to me for a while."
    feeling.live(120.0)
    assert feeling.model.feeling().emotions["sadness"] < 0.05


@pytest.mark.proves("B24", "R04")
def test_an_optimist_soon_forgets_what_a_pessimist_broods_over() -> None:
    moods = {}
    for personality in ("optimist", "neutral", "pessimist"):
        feeling = Feeling(personality)
        for stimulus in ("person_seen", "scold", "praise", "bump"):
            feeling.model.feel(stimulus)
            feeling.live(20.0)
        moods[personality] = feeling.model.feeling().valence
    assert moods["optimist"] > moods["neutral"] + 0.1 > moods["pessimist"] + 0.2


def test_events_come_with_labels_and_at_most_one_a_second_without() -> None:
    feeling = Feeling()
    for _ in range(5):
        feeling.model.feel("praise")
        feeling.live(3.0)
    assert set(feeling.events[0].properties) == {"label", "valence", "arousal", "dominance"}
    for before, after in zip(feeling.events, feeling.events[1:], strict=False):
        if before.properties["label"] == after.properties["label"]:
            assert after.time - before.time >= 1.0
            assert abs(after.properties["valence"] - before.properties["valence"]) >= 0.1
    assert all(round(e.properties["valence"], 4) == e.properties["valence"] for e in feeling.events)


def test_it_says_why() -> None:
    feeling = Feeling()
    assert feeling.model.why() == ()
    assert feeling.model.why_words() == "I am calm, for no special reason."
    feeling.model.feel("scold")
    feeling.live(1.0)
    (cause,) = feeling.model.why()
    assert (cause.name, cause.share, cause.age_s) == ("scold", 1.0, pytest.approx(1.0))
    assert feeling.model.why_words() == "I am sad because you scolded me."
    assert feeling.model.feeling_words() == "sad"
    assert Feeling("pessimist").model.why_words() == "I am a little low because that is how I am."


def test_who_praised_it_is_named_unless_it_is_the_one_who_asks() -> None:
    feeling = Feeling()
    sent: OutputPort[People] = OutputPort()
    feeling.model.people.sources.append(sent)
    anna, ben = (Person(id, HeadPose(0.0, 0.0, 0.0), name=name) for id, name in SEEN.items())
    sent.value = People(0.0, (anna, ben), attended="p2")
    feeling.live(0.1)
    feeling.model.feel("praise", person="p1")
    assert feeling.model.why_words() == "I am happy because Anna praised me."
    assert feeling.model.why()[0].person == "Anna"
    sent.value = People(0.0, (anna, ben), attended="p1")
    feeling.live(0.1)
    assert feeling.model.why_words() == "I am happy because you praised me."
    feeling.context.events.raise_event("stimulus.felt", stimulus="scold", person="p2")
    feeling.live(10.0)
    assert feeling.model.why_words() == "I am sad because you scolded me."


def test_what_somebody_did_is_theirs_once_their_name_is_known() -> None:
    feeling = Feeling()
    sent: OutputPort[People] = OutputPort()
    feeling.model.people.sources.append(sent)
    somebody = Person("p1", HeadPose(0.0, 0.0, 0.0))
    sent.value = People(0.0, (somebody,))
    feeling.live(0.1)
    for person in ("p1", "Anna", "p2"):
        feeling.model.feel("petted", person=person)
        feeling.live(0.1)
    before = feeling.model.feeling()
    sent.value = People(1.0, (replace(somebody, name="Anna"),))
    feeling.model.compute(feeling.clock.now(), 0.1)
    assert feeling.model.feeling().emotions == pytest.approx(before.emotions, abs=1e-9)
    shares = {cause.person: cause.share for cause in feeling.model.why()}
    assert set(shares) == {"Anna", "p2"}
    assert shares["Anna"] > 0.6
    feeling.model.feel("petted", person="p1")
    assert set(shares) == {cause.person for cause in feeling.model.why()}


def test_who_says_their_name_is_known_by_it_until_they_go() -> None:
    feeling = Feeling()
    feeling.model.feel("praise", person="p1")
    feeling.model.feel("petted")
    feeling.model.know({"p1": "Anna", "": "Ben"})
    feeling.model.feel("praise", person="")
    assert {cause.person for cause in feeling.model.why()} == {"Anna", "Ben", None}
    feeling.model.know({"": "Ben"})
    feeling.model.feel("petted", person="p1")
    assert {cause.person for cause in feeling.model.why()} == {"Anna", "Ben", "p1", None}


def test_who_is_forgotten_is_no_cause_by_name() -> None:
    feeling = Feeling()
    feeling.model.know({"p1": "Anna"})
    feeling.model.feel("praise", person="p1")
    before = feeling.model.feeling()
    feeling.model.forget("Anna")
    assert {cause.person for cause in feeling.model.why()} == {None}
    assert feeling.model.feeling().emotions == pytest.approx(before.emotions, abs=1e-9)


def test_who_asks_about_a_feeling_hears_about_that_one() -> None:
    feeling = Feeling()
    feeling.model.feel("praise")
    feeling.live(30.0)
    feeling.model.feel("bump")
    assert feeling.model.feeling().label == "surprise"
    why = feeling.model.why_words
    assert why() == why("surprised") == why("neutral") == why("so")
    assert why("disgusted") == f"I am not disgusted. {why()}"
    assert why("afraid") == "I am also afraid because I bumped into something."
    feeling.live(4.0)
    assert why("afraid") == "I am a little afraid because I bumped into something."
    assert why("scared").startswith("I am a little scared because I bumped")


def test_a_network_can_send_stimuli() -> None:
    feeling = Feeling()
    source = OutputPort[Stimulus]()
    feeling.model.stimulus.sources.append(source)
    source.value = Stimulus("praise", 0.8)
    feeling.model.compute(0.0, 0.0)
    assert feeling.model.feeling().label == "joy"


def test_nonsense_from_elsewhere_is_told_and_moves_nothing() -> None:
    feeling = Feeling()
    told: list[Event] = []
    feeling.context.events.subscribe("stimulus.refused", told.append)
    source = OutputPort[Stimulus]()
    feeling.model.stimulus.sources.append(source)
    source.value = Stimulus("skold")
    feeling.live(1.0)
    source.value = None
    for intensity in (2.0, math.nan, "much", None):
        raise_event = feeling.context.events.raise_event
        raise_event("stimulus.felt", stimulus="praise", intensity=intensity)
    raise_event("stimulus.felt")
    reasons = [event.properties["reason"] for event in told]
    assert 'no stimulus "skold" - did you mean "scold"?' in reasons[0]
    assert len(reasons) == 3
    assert feeling.live(1.0).label == "calm"


def test_unknown_stimuli_are_refused_and_after_stop_nothing_is_felt() -> None:
    feeling = Feeling()
    with pytest.raises(HriError, match='did you mean "scold"'):
        feeling.model.feel("skold")
    feeling.model.stop()
    feeling.context.events.raise_event("stimulus.felt", stimulus="praise")
    assert feeling.model.feeling().label == "calm"


def test_the_display_passes_on_what_is_felt() -> None:
    feeling = Feeling()
    display = EmotionDisplay()
    state, override = OutputPort[EmotionState](), OutputPort[Expression]()
    display.state.sources.append(state)
    display.override.sources.append(override)
    display.start(feeling.context)
    display.compute(0.0, 0.0)
    assert display.expression.value is None
    feeling.model.feel("praise")
    state.value = feeling.model.feeling()
    display.compute(0.1, 0.1)
    assert display.expression.value is not None
    assert display.expression.value.label == "happy"
    assert display.expression.value.intensity > 0.8
    assert display.prosody.value is not None
    assert display.prosody.value.rate > 1.0
    assert display.speed.value is not None
    assert 1.0 < display.speed.value <= 1.2
    assert display.arousal.value is not None
    assert display.arousal.value > 0.0
    override.value = Expression("asleep", 1.0)
    display.compute(0.2, 0.1)
    assert display.expression.value == Expression("asleep", 1.0)


def test_a_smile_fades_into_the_mood_and_does_not_grow_again() -> None:
    feeling, display, face = Feeling(), EmotionDisplay(), Face()
    display.state.sources.append(feeling.model.state)
    face.expression.sources.append(display.expression)
    display.start(feeling.context)
    face.start(feeling.context)
    feeling.model.feel("praise")
    smiles = []
    for _ in range(600):
        feeling.live(0.1)
        now = feeling.clock.now()
        display.compute(now, 0.1)
        face.compute(now, 0.1)
        assert face.weights.value is not None
        smiles.append(face.weights.value.values.get("mouthSmileLeft", 0.0))
    assert feeling.labels() == ["joy", "exuberant"]
    peak = smiles.index(max(smiles))
    assert peak < 20
    fading = smiles[peak:]
    assert max(later - one for one, later in pairwise(fading)) < 0.01
    assert max(later - one for one, later in zip(fading, fading[30:], strict=False)) < 0.02
    assert 0.1 < smiles[-1] < 0.6 * max(smiles)


def test_a_shy_one_shows_less() -> None:
    shown = []
    for personality in ("neutral", "shy"):
        display = EmotionDisplay(personality=personality)
        display.start(Feeling().context)
        source = OutputPort[EmotionState]()
        source.value = EmotionState("joy", 0.5, 0.0, 0.0, 0.0, {"joy": 0.5})
        display.state.sources.append(source)
        display.compute(0.0, 0.0)
        assert display.expression.value is not None
        shown.append(display.expression.value.intensity)
    assert shown[1] < shown[0]


def test_a_personality_has_its_voice(tmp_path, monkeypatch) -> None:
    file = tmp_path / "emotions" / "personalities" / "shy.toml"
    file.parent.mkdir(parents=True)
    own = paths.find("emotions", "personalities/shy.toml").read_text()
    file.write_text('voice = "warm"\n' + own)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    display = EmotionDisplay(personality="shy")
    display.start(Feeling().context)
    source = OutputPort[EmotionState]()
    source.value = EmotionState("joy", 0.5, 0.0, 0.0, 0.0, {"joy": 0.5})
    display.state.sources.append(source)
    display.compute(0.0, 0.0)
    assert display.prosody.value is not None
    assert display.prosody.value.voice == "warm"


def test_the_mood_is_told_by_its_name_when_that_changes() -> None:
    feeling = Feeling()
    moods: list[Event] = []
    feeling.context.events.subscribe("mood.changed", moods.append)
    feeling.live(1.0)
    feeling.model.feel("praise")
    feeling.live(400.0)
    names = [event.properties["label"] for event in moods]
    assert names[0] == names[-1] == "calm"
    assert 3 <= len(names) <= 5
    # It is named once joy has faded, and from then on each minute.
    gaps = [later.time - one.time for one, later in pairwise(moods[1:])]
    assert min(gaps) >= 59.0
    assert set(moods[1].properties) == {"label", "pleasure", "arousal", "dominance"}
    assert moods[1].properties["pleasure"] > 0.05


def test_the_valence_that_is_told_is_the_pleasure_of_the_mood() -> None:
    feeling = Feeling()
    feeling.model.feel("scold")
    feeling.live(20.0)
    told = feeling.events[-1].properties
    assert feeling.model.mood.value is not None
    assert told["valence"] == pytest.approx(feeling.model.mood.value[0], abs=0.15)
    assert told["valence"] < 0


@given(st.lists(st.floats(0.01, 30.0), max_size=20))
@settings(max_examples=20, deadline=None)
def test_what_is_felt_does_not_depend_on_the_ticks(ticks: list[float]) -> None:
    ticked, idle = Feeling(), Feeling()
    for feeling in (ticked, idle):
        feeling.model.feel("praise", 0.8, "Ann")
    for dt in ticks:
        ticked.model.compute(ticked.clock.now(), dt)
        ticked.clock.advance(dt)
    idle.clock.advance(ticked.clock.now())
    for feeling in (ticked, idle):
        feeling.model.feel("bump")
    assert ticked.model.feeling() == idle.model.feeling()
    assert ticked.model.why() == idle.model.why()


def test_hopes_and_deeds_are_appraised() -> None:
    feeling = Feeling()
    feeling.model.appraise(GoalEvent("charger", utility=0.9, likelihood_after=0.9))
    assert feeling.model.feeling().label == "hope"
    assert feeling.model.why_words() == "I am hopeful because of the charger."
    feeling.live(5.0)
    feeling.model.appraise(GoalEvent("charger", 0.9, likelihood_before=0.9, likelihood_after=0.0))
    assert feeling.model.feeling().emotions["disappointment"] > 0.5


def test_the_battery_is_felt_in_steps() -> None:
    feeling = Feeling()
    battery = OutputPort[float]()
    feeling.model.battery.sources.append(battery)
    for level in (1.0, 0.4, None, math.nan):
        battery.value = level
        feeling.live(0.2)
    assert feeling.model.feeling().drives["energy"] == pytest.approx(0.6, abs=0.01)
    for level in (0.4, 0.395, 0.2, -1.0):
        battery.value = level
        feeling.live(0.2)
    assert feeling.model.feeling().drives["energy"] == 1.0
    battery.value = 0.5
    feeling.live(400.0)
    assert feeling.model.feeling().drives["energy"] == pytest.approx(0.5, abs=0.01)
    assert feeling.model.feeling().valence < -0.02


def test_what_a_port_sends_is_the_label_and_the_mood() -> None:
    feeling = Feeling()
    feeling.model.feel("praise")
    state = feeling.live(1.0)
    assert feeling.model.label.value == state.label == "joy"
    assert feeling.model.mood.value == pytest.approx(
        (state.valence, state.arousal, state.dominance), abs=0.02
    )


# --- files that are saved while it runs ---


@pytest.fixture
def own_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of emotion files that a test may change."""
    shutil.copytree(paths.house() / "emotions", tmp_path / "emotions")
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    return tmp_path / "emotions"


def save(path: Path, text: str) -> None:
    """Write a file, and let it be newer than it was, whatever the clock of the disk is like."""
    before = path.stat().st_mtime
    path.write_text(text)
    os.utime(path, (before + 10, before + 10))


def test_a_file_that_is_saved_counts_from_then_on_and_feelings_go_on(own_files: Path) -> None:
    feeling = Feeling()
    told: list[Event] = []
    feeling.context.events.subscribe("emotions.*", told.append)
    feeling.model.feel("scold")
    before = feeling.live(3.0)
    save(own_files / "personalities" / "neutral.toml", "[negative]\ngain = 0.0\n")
    after = feeling.live(3.0)
    assert [event.name for event in told] == ["emotions.reloaded"]
    assert 0.7 * before.emotions["sadness"] < after.emotions["sadness"] < before.emotions["sadness"]
    feeling.model.feel("scold")
    assert feeling.model.feeling().emotions["sadness"] <= after.emotions["sadness"]


def test_a_wrong_file_is_told_once_and_changes_nothing(own_files: Path) -> None:
    feeling, untouched = Feeling(), Feeling()
    told: list[Event] = []
    feeling.context.events.subscribe("emotions.*", told.append)
    feeling.model.feel("scold")
    untouched.model.feel("scold")
    save(own_files / "stimuli" / "companion.toml", "[stimulus.praise]\nwords = 3\n")
    feeling.live(10.0)
    untouched.clock.advance(feeling.clock.now())
    (event,) = told
    assert event.name == "emotions.refused"
    assert "companion.toml:2:1" in event.properties["reason"]
    assert feeling.model.feeling() == untouched.model.feeling()
    feeling.model.feel("praise")
    assert feeling.model.feeling().emotions["joy"] > 0.3


def test_a_trigger_that_is_written_anew_is_listened_to(own_files: Path) -> None:
    feeling = Feeling()
    path = own_files / "stimuli" / "companion.toml"
    save(path, path.read_text() + "\n[stimulus.rain]\nwords = 'it rains'\n"
         "emotions = { sadness = 0.5 }\ntrigger = 'rain.began'\n")  # fmt: skip
    feeling.live(3.0)
    feeling.context.events.raise_event("rain.began")
    assert feeling.model.why_words() == "I am sad because it rains."


def test_the_face_follows_a_display_that_is_saved(own_files: Path) -> None:
    context = Feeling().context
    display = EmotionDisplay()
    display.start(context)
    source = OutputPort[EmotionState]()
    source.value = EmotionState("joy", 0.5, 0.0, 0.0, 0.0, {"joy": 0.5})
    display.state.sources.append(source)
    path = own_files / "display.toml"
    text = re.sub(r'(?m)^joy = .*"happy".*$', 'joy = {expression = "excited", words = "x"}',
                  path.read_text())  # fmt: skip
    save(path, text)
    shown = []
    for second in range(5):
        display.compute(float(second), 1.0)
        context.clock.advance(1.0)
        assert display.expression.value is not None
        shown.append(display.expression.value.label)
    assert shown[0] == "happy"
    assert shown[-1] == "excited"
    display.stop()


def test_display_rules_that_are_in_use_cannot_be_saved_away(own_files: Path) -> None:
    context = Feeling().context
    path = own_files / "display.toml"
    text = path.read_text()
    save(path, text + "\n[rules.wooden]\njoy = { gain = 0.0 }\n")
    display = EmotionDisplay(rules="wooden")
    display.check()
    display.start(context)
    source = OutputPort[EmotionState]()
    source.value = EmotionState("joy", 0.5, 0.0, 0.0, 0.0, {"joy": 0.5})
    display.state.sources.append(source)
    save(path, text)
    for second in range(5):
        display.compute(float(second), 1.0)
        context.clock.advance(1.0)
        assert display.expression.value is not None
        assert display.expression.value.label == "neutral"
    display.stop()
    with pytest.raises(HriError, match='no display rules "wooden"'):
        EmotionDisplay(rules="wooden").check()


def test_what_is_shown_is_what_the_display_rules_leave() -> None:
    feeling = Feeling()
    display = EmotionDisplay(rules="polite")
    state = OutputPort[EmotionState]()
    display.state.sources.append(state)
    display.start(feeling.context)
    assert display.shown.label == "calm"
    state.value = EmotionState("disappointment", 0.8, 0.0, 0.0, 0.0, {"disappointment": 0.8})
    display.compute(0.1, 0.1)
    assert display.shown.label == "joy"
