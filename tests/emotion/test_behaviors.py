import pytest

from hri.behavior.behavior import Context
from hri.behavior.ports import OutputPort
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.events import EventBus
from hri.core.signals import EmotionState, Event, Expression, Stimulus
from hri.emotion.behaviors import EmotionDisplay, EmotionModel
from hri.hal.manager import ResourceManager


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


def test_praise_makes_happy_for_a_while_and_lifts_the_mood() -> None:
    feeling = Feeling()
    feeling.live(1.0)
    feeling.context.events.raise_event("stimulus.felt", stimulus="praise", intensity=1.0)
    state = feeling.live(15.0)
    assert state.label == "joy"
    assert state.valence > 0.15
    state = feeling.live(20.0)
    assert state.label == "exuberant"
    assert abs(feeling.live(600.0).valence) < 0.02
    assert feeling.labels() == ["calm", "joy", "exuberant", "calm"]


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
    for _ in range(4):
        feeling.model.feel("ignored")
        intensities.append(feeling.model.feeling().emotions["sadness"])
        feeling.live(15.0)
    assert feeling.labels()[0] == "sadness"
    assert intensities[0] < intensities[1] < 0.5
    assert feeling.model.feeling().valence < -0.1


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
    assert feeling.model.why() == []
    assert feeling.model.why_words() == "I am calm, and there is no special reason."
    feeling.model.feel("scold")
    feeling.live(1.0)
    assert feeling.model.why() == [("scold", pytest.approx(1.0))]
    assert feeling.model.why_words() == "I am sad because you scolded me."
    assert feeling.model.feeling_words() == "sad"
    assert Feeling("pessimist").model.why_words() == "I am a bit down because that is how I am."


def test_a_network_can_send_stimuli() -> None:
    feeling = Feeling()
    source = OutputPort[Stimulus]()
    feeling.model.stimulus.sources.append(source)
    source.value = Stimulus("praise", 0.8)
    feeling.model.compute(0.0, 0.0)
    assert feeling.model.feeling().label == "joy"


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
