import pytest

from hri.behavior.behavior import Context
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Frame
from hri.hal.resource_manager import ResourceManager
from hri.vision.naming import FaceNames
from hri.vision.tracking.face_recognition import Acquaintances
from hri.vision.tracking.people import PeopleTracker
from tests.vision.stage import Player, Stage, standing
from tests.vision.tracking.test_people import ANNA, BEN

BROKEN = "tests.vision.test_naming:Broken"
MODEL = "tests.vision.tracking.test_face_recognition:Colors"
TICK = 1 / 15


class Broken:
    """A model that fails."""

    def embed(self, crop):
        raise RuntimeError("out of memory")


class Party:
    """People before a behavior that names them."""

    def __init__(self, stage: Stage, **parameters: str) -> None:
        self.stage, self.clock = stage, FakeClock()
        self.behavior = FaceNames("names", **parameters)
        resources = ResourceManager([], self.clock)
        self.events = EventBus(self.clock)
        self.behavior.start(Context(self.clock, self.events, resources))
        self.tracker = PeopleTracker(stage.detectors())

    def names(self, seconds: float = 2.5) -> list[str]:
        """Those of who is in sight after so many seconds."""
        for index in range(round(seconds / TICK)):
            self.stage.time = self.clock.now()
            frame = Frame(self.stage.image(), self.stage.time, index)
            self.behavior.image.sources[:] = [_Sent(frame)]
            self.behavior.people.sources[:] = [_Sent(self.tracker.see(frame))]
            self.behavior.compute(self.clock.now(), TICK)
            self.clock.advance(TICK)
        named = self.behavior.named.value
        assert named is not None
        return [person.name for person in named.persons]


class _Sent:
    def __init__(self, value: object) -> None:
        self.value = value


@pytest.fixture
def stage() -> Stage:
    return Stage([Player(standing(90), **ANNA), Player(standing(230), **BEN)])


def test_without_a_model_nobody_is_named_and_nothing_is_kept(stage):
    party = Party(stage)
    assert party.names() == ["", ""]
    assert not party.behavior._frames
    with pytest.raises(HriError, match="set its parameter model"):
        party.behavior.remember("p1", "Anna")


def test_nobody_is_named_before_somebody_says_who_it_is(stage):
    party = Party(stage, model=MODEL)
    assert party.names() == ["", ""]
    party.behavior._recognizer.known._alike = 0.95
    party.behavior.remember("p1", "Anna")
    assert party.names() == ["Anna", ""]
    assert party.behavior.forget("Anna")
    assert party.names() == ["", ""]


def test_names_outlive_the_program_only_in_the_file_that_was_set(stage, tmp_path):
    file = tmp_path / "faces.json"
    first = Party(stage, model=MODEL, file=str(file))
    first.names()
    assert not file.exists()
    first.behavior.remember("p2", "Ben")
    again = Party(stage, model=MODEL, file=str(file))
    assert "Ben" in again.names()
    again.behavior.forget_all()
    assert set(Party(stage, model=MODEL, file=str(file)).names()) == {""}


def test_whom_somebody_else_has_the_file_forget_a_running_robot_forgets(stage, tmp_path):
    file = tmp_path / "faces.json"
    party = Party(stage, model=MODEL, file=str(file))
    party.names()
    party.behavior.remember("p1", "Anna")
    party.behavior.remember("p2", "Ben")
    known = Acquaintances.load(file)
    known.forget("Anna")
    known.save(file)
    assert "Anna" not in party.names()
    party.behavior.remember("p2", "Benjamin")
    assert "Anna" not in file.read_text()
    file.unlink()
    assert party.names() == ["", ""]


def test_the_name_of_who_is_recognized_is_told_once(stage):
    party = Party(stage, model=MODEL)
    told = []
    party.events.subscribe("person.named", lambda event: told.append(event.properties))
    party.names()
    party.behavior._recognizer.known._alike = 0.95
    party.behavior.remember("p1", "Anna")
    party.names()
    assert told == [{"person": "p1", "name": "Anna"}]


def test_a_model_that_fails_costs_the_names_alone_and_is_told_once(stage, caplog):
    party = Party(stage, model=BROKEN)
    assert party.names(4.0) == ["", ""]
    (record,) = caplog.records
    assert "RuntimeError: out of memory" in record.message
    with pytest.raises(HriError, match="out of memory"):
        party.behavior.remember("p1", "Anna")


def test_who_is_not_seen_cannot_be_remembered(stage):
    party = Party(stage, model=MODEL)
    with pytest.raises(HriError, match="wait until they look"):
        party.behavior.remember("p7", "Zoe")


@pytest.mark.parametrize("model", ["no.such.module:Model", "math:Model", "math", ":x"])
def test_a_model_that_is_none_is_refused(stage, model):
    with pytest.raises(HriError, match="model"):
        Party(stage, model=model)
