import json
from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from hri.behavior.behavior import Context
from hri.core.clock import FAKE_MORNING, FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event
from hri.emotion.affect import Affect
from hri.emotion.appraisal import ActionEvent, GoalEvent, name_of
from hri.emotion.behaviors import EmotionModel
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import (
    LONGEST_AWAY_S,
    Memory,
    dump,
    forget,
    keep,
    memory_file,
    parse,
    recall,
    without,
)
from hri.hal.resource_manager import ResourceManager

DYNAMICS = load_emotions("neutral").dynamics()
STEPS = st.lists(
    st.tuples(
        st.floats(0, 500),
        st.sampled_from(DYNAMICS.names),
        st.floats(0, 1),
        st.sampled_from([None, "Ann", "Bob"]),
    ),
    max_size=8,
)
Steps = list[tuple[float, str, float, str | None]]


def lived(steps: Steps, affect: Affect | None = None, start: float = 0.0) -> Affect:
    affect = affect or DYNAMICS.rest(start)
    for wait, name, intensity, person in steps:
        affect = DYNAMICS.feel(affect, name, intensity, affect.time + wait, person)
    return affect


def a_memory() -> Memory:
    affect = lived([(0, "praise", 1.0, "Ann"), (30, "scold", 0.7, "Bob"), (5, "bump", 1.0, None)])
    event = GoalEvent("charger", 0.8, likelihood_after=0.7)
    affect = DYNAMICS.appraise(affect, event, affect.time)
    return Memory(affect.imprint, affect.time + 3.0, 1e9)


class ClockOfDay(FakeClock):
    """A fake clock of a robot that is switched on at a time of the wall."""

    def __init__(self, morning: datetime = FAKE_MORNING) -> None:
        super().__init__()
        self._morning = morning

    def wall(self) -> datetime:
        return self._morning + timedelta(seconds=self.now())


class Run:
    """One run of a robot that remembers, begun some seconds after the fake morning."""

    def __init__(self, path: Path, begun: float = 0.0, personality: str = "neutral") -> None:
        self.clock = ClockOfDay(FAKE_MORNING + timedelta(seconds=begun))
        self.context = Context(self.clock, EventBus(self.clock), ResourceManager([], self.clock))
        self.events: list[Event] = []
        self.context.events.subscribe("memory.*", self.events.append)
        memory = str(path) if path.name else ""
        self.model = EmotionModel(memory=memory, personality=personality)
        self.model.start(self.context)

    def live(self, seconds: float, tick: float = 1.0) -> None:
        for _ in range(round(seconds / tick)):
            self.model.compute(self.clock.now(), tick)
            self.clock.advance(tick)


# --- the file ---


@given(STEPS, STEPS)
@settings(max_examples=40)
def test_what_is_kept_and_read_lives_on_to_the_last_bit(before: Steps, after: Steps) -> None:
    affect = lived(before)
    read = parse(dump(Memory(affect.imprint, affect.time, 0.0))).imprint
    again = DYNAMICS.resume(read, affect.time)
    assert lived(after, again) == lived(after, affect)


@given(STEPS, st.floats(0, 1e7))
@settings(max_examples=40)
def test_time_away_is_time_lived(steps: Steps, away: float) -> None:
    affect = lived(steps)
    memory = parse(dump(Memory(affect.imprint, affect.time, 5000.0)))
    awake = DYNAMICS.resume(memory.awakened(100.0, 5000.0 + away), 100.0)
    lived_on = DYNAMICS.read(DYNAMICS.advance(affect, affect.time + away))
    read = DYNAMICS.read(awake)
    assert read.label == lived_on.label or abs(read.intensity - lived_on.intensity) < 1e-6
    assert read.valence == pytest.approx(lived_on.valence, abs=1e-6)
    assert read.drives == pytest.approx(lived_on.drives, abs=1e-6)


def test_a_clock_that_was_set_back_or_far_ahead_is_no_harm() -> None:
    memory = a_memory()
    last = memory.imprint.time - memory.time
    assert memory.awakened(50.0, memory.wall - 1e6).time == pytest.approx(50.0 + last)
    far = memory.awakened(50.0, memory.wall + 1e12).time
    assert far == pytest.approx(50.0 + last - LONGEST_AWAY_S)


def test_only_the_user_can_read_it_and_nothing_else_is_left(tmp_path: Path) -> None:
    path = tmp_path / "state" / "feelings.json"
    keep(path, a_memory())
    keep(path, a_memory())
    assert path.stat().st_mode & 0o777 == 0o600
    assert [file.name for file in path.parent.iterdir()] == ["feelings.json"]
    assert recall(path) == a_memory()


def test_it_lies_in_the_state_folder_of_the_user(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert memory_file() == tmp_path / "hri" / "feelings.json"


DAMAGE: list[tuple[Callable[[Any], object], str]] = [
    (lambda data: data.update(schema=0), "it is of version 0, not 1"),
    (lambda data: data.pop("wall"), "the file has no wall"),
    (lambda data: data.update(time=True), "the file.time is not a number"),
    (lambda data: data.update(time=10**400), "an integer of 401 digits"),
    (lambda data: data["affect"]["causes"][0].update(person="\ud800"), "has halves of letters"),
    (lambda data: data.update(time=-1e9), "it mentions a time after it was written"),
    (lambda data: data.update(affect=[]), "affect is not a table"),
    (lambda data: data["affect"].update(label="joyy"), 'affect.label: no emotion "joyy"'),
    (lambda data: data["affect"]["fresh"][0]["charges"].update(joy=-1), "joy is -1, not 0 to"),
    (lambda data: data["affect"]["causes"][0].update(mood=[1, 2]), "a mood of 2 numbers, not 3"),
    (lambda data: data["affect"]["causes"][0].update(mood=[1e300] * 3), "mood is 1e+300, not"),
    (lambda data: data["affect"]["causes"][0].update(time=1e9), "time is 1e+09, not"),
    (lambda data: data["affect"]["needs"]["play"].update(level=2), "level is 2, not 0 to 1"),
    (lambda data: data["affect"]["relations"].update(Ann={}), "relations.Ann has no before"),
    (lambda data: data["affect"]["causes"][0].update(name=1), "causes[0].name is not a text"),
    (lambda data: data["affect"].update(causes="all"), "affect.causes is not a list"),
    (lambda data: data.update(has_ended=1), "the file.has_ended is neither true nor false"),
]


@pytest.mark.parametrize(("damage", "told"), DAMAGE, ids=[told for _, told in DAMAGE])
def test_what_is_wrong_is_told(damage: Callable[[Any], object], told: str) -> None:
    data = json.loads(dump(a_memory()))
    damage(data)
    with pytest.raises(HriError) as error:
        parse(json.dumps(data))
    assert told in str(error.value)


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, '{"schema": NaN}', "null", "7"])
def test_what_is_no_memory_at_all_is_told(text: str) -> None:
    with pytest.raises(HriError):
        parse(text)


# --- forgetting ---


def test_a_person_is_forgotten_but_what_they_did_stays_felt() -> None:
    imprint = lived([(0, "praise", 1.0, "Ann"), (9, "praise", 1.0, None), (9, "bump", 1.0, "Bob")])
    forgotten = without(without(imprint.imprint, "Ann"), "Bob")
    text = dump(Memory(forgotten, 100.0, 0.0))
    assert "Ann" not in text
    assert "Bob" not in text
    before, after = (
        DYNAMICS.read(DYNAMICS.advance(DYNAMICS.resume(each, 20.0), 20.0))
        for each in (imprint.imprint, forgotten)
    )
    assert after.emotions == pytest.approx(before.emotions, abs=1e-12)
    assert after.valence == pytest.approx(before.valence, abs=1e-12)


def test_forgetting_erases_a_person_or_all_that_there_is(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    assert not forget(path)
    assert not forget(path, "Ann")
    keep(path, a_memory())
    (tmp_path / "feelings.unusable-1.json").write_text("Ann")
    with pytest.raises(HriError, match='unknown person "Anne" - did you mean "Ann"'):
        forget(path, "Anne")
    assert forget(path, "Ann")
    assert "Ann" not in path.read_text()
    assert forget(path)
    assert list(tmp_path.iterdir()) == []


def test_what_is_called_by_a_persons_name_is_forgotten_with_them_and_nobody_else_is() -> None:
    affect = lived([(0, "praise", 1.0, "Ann Lee"), (1, "praise", 1.0, "ann")])
    for goal in ("the party of Ann", "the annual party"):
        affect = DYNAMICS.appraise(affect, GoalEvent(goal, 0.5, 0.7), affect.time)
    kept = dump(Memory(without(affect.imprint, "Ann"), affect.time, 1e9))
    assert "Ann Lee" in kept
    assert "the annual party" in kept
    assert '"ann"' not in kept
    assert "party of Ann" not in kept


def test_it_is_told_once_who_takes_part_by_name(tmp_path: Path) -> None:
    run = Run(tmp_path / "feelings.json")
    told: list[Any] = []
    run.context.events.subscribe("person.named", lambda event: told.append(event.properties))
    for person in ("Ann", "p1", None, "Ann"):
        run.model.feel("praise", 1.0, person)
    run.model.appraise(ActionEvent("rescue", 0.8, agent="Bob"))
    run.model.appraise(ActionEvent("blunder", -0.8))
    run.model.appraise(GoalEvent("exam", 0.5, 1.0, owner="Cid"))
    assert [properties["name"] for properties in told] == ["Ann", "Bob", "Cid"]


def test_it_keeps_only_after_a_yes_and_never_over_what_was_kept(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    run = Run(Path(""))
    run.model.memory_after_yes = str(path)
    run.model.feel("praise", 1.0, "Ann")
    run.live(5)
    assert run.model.may_ask_to_keep
    assert not path.exists()
    run.model.begin_keeping()
    assert not run.model.may_ask_to_keep
    run.live(5)
    run.model.stop()
    assert "Ann" in path.read_text()
    before = path.read_bytes()
    other = Run(Path(""))
    other.model.memory_after_yes = str(path)
    assert not other.model.may_ask_to_keep
    other.model.begin_keeping()
    other.live(5)
    other.model.stop()
    assert path.read_bytes() == before


def test_a_robot_that_runs_forgets_a_person_too(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    run = Run(path)
    run.model.feel("praise", 1.0, "Ann")
    run.live(5)
    before = run.model.feeling()
    assert forget(path, "Ann")
    run.live(2)
    assert [cause.person for cause in run.model.why()] == [None]
    assert before.valence <= run.model.feeling().valence < before.valence + 0.05
    run.model.feel("bump")
    run.live(5)
    run.model.stop()
    assert "Ann" not in path.read_text()
    assert [event.name for event in run.events] == ["memory.forgotten"]


def test_what_is_forgotten_just_before_the_next_writing_stays_forgotten(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    for wait in (1.1, 1.3, 1.5, 1.7, 1.9):
        path.unlink(missing_ok=True)
        run = Run(path)
        run.live(2.3, tick=0.1)
        run.model.feel("praise", 1.0, "Ann")
        run.live(wait, tick=0.1)
        forget(path, "Ann")
        run.model.feel("praise", 0.5, "Bob")
        run.live(6, tick=0.1)
        run.model.stop()
        assert "Ann" not in path.read_text()


def test_a_robot_that_runs_forgets_all_even_at_its_very_end(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    for seconds in (0, 3):
        run = Run(path)
        run.model.feel("praise", 1.0, "Ann")
        run.live(5)
        assert forget(path)
        run.live(seconds)
        run.model.stop()
        assert not path.exists() or "Ann" not in path.read_text()


def test_a_name_that_cannot_be_written_keeps_nothing_from_being_kept(tmp_path: Path) -> None:
    affect = lived([(0, "praise", 1.0, name_of("An\ud800na"))])
    keep(tmp_path / "feelings.json", Memory(affect.imprint, 1.0, 1e9))
    memory = parse((tmp_path / "feelings.json").read_text())
    assert {origin.person for origin in memory.imprint.habituation} == {"An?na"}


def test_two_robots_with_one_file_do_not_forget_for_each_other(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    one, other = Run(path), Run(path)
    one.model.feel("praise", 1.0, "Ann")
    one.live(5)
    other.model.feel("scold", 1.0, "Bob")
    other.live(5)
    one.live(5)
    assert [cause.name for cause in one.model.why()] == ["praise"]
    assert other.events == one.events == []


# --- in the robot ---


def test_a_robot_wakes_up_as_it_would_have_felt_by_then(tmp_path: Path) -> None:
    first = Run(tmp_path / "feelings.json")
    first.model.feel("scold", 1.0, "Ann")
    first.live(30)
    first.model.stop()
    second = Run(tmp_path / "feelings.json", begun=130)
    first.clock.advance(100.0)
    awake, on = second.model.feeling(), first.model.feeling()
    assert awake.valence == pytest.approx(on.valence, abs=1e-9)
    assert awake.valence < -0.05
    assert awake.drives == pytest.approx(on.drives, abs=1e-9)
    assert second.model.why_words() == first.model.why_words()


def test_who_reads_the_file_knows_whether_the_robot_runs(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    run = Run(path)

    def is_running() -> bool:
        memory = recall(path)
        assert memory is not None
        return memory.is_running(run.clock.wall().timestamp())

    for _ in range(10):
        run.live(30)
        assert is_running()
    run.clock.advance(1000.0)
    assert not is_running(), "its plug was pulled"
    run.live(30)
    assert is_running()
    run.model.stop()
    assert not is_running()


def test_whose_name_is_not_known_is_a_stranger_the_next_time(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    first = Run(path)
    for person in ("p1", "Ann"):
        first.model.feel("praise", 1.0, person)
    first.live(1)
    first.model.stop()
    second = Run(path)
    assert {cause.person for cause in second.model.why()} == {"Ann", None}
    second.model.stop()
    assert (memory := recall(path)) is not None
    assert set(memory.imprint.relations) == {"Ann"}


def test_a_link_to_nothing_is_put_aside(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    path.symlink_to(tmp_path / "gone")
    run = Run(path)
    (event,) = run.events
    assert f"links to {tmp_path / 'gone'}, which is not there" in event.properties["reason"]
    assert "feelings.unusable-1.json" in event.properties["reason"]
    run.model.stop()
    assert recall(path) is not None


def test_what_happens_is_kept_soon_for_the_day_the_plug_is_pulled(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    run = Run(path)
    run.live(1)
    assert (memory := recall(path)) is not None
    assert memory.imprint.fresh == {}
    run.live(10)
    run.model.feel("praise")
    run.live(3)
    assert (memory := recall(path)) is not None
    assert [origin.name for origin in memory.imprint.fresh] == ["praise"]


def test_a_disk_is_not_worn_out_by_a_robot_to_which_much_or_nothing_happens(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    run = Run(path)
    written = set()
    for second in range(120):
        if second < 60:
            run.model.feel("praise")
        run.live(1)
        written.add(path.stat().st_mtime_ns)
    assert 20 < len(written) <= 32


def test_without_a_file_nothing_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    clock = FakeClock()
    model = EmotionModel()
    model.start(Context(clock, EventBus(clock), ResourceManager([], clock)))
    model.feel("praise")
    for second in range(200):
        model.compute(float(second), 1.0)
    model.stop()
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_was_named_by_mistake_stays_where_it_is(tmp_path: Path) -> None:
    (tmp_path / "photos").mkdir()
    run = Run(tmp_path / "photos")
    run.live(100)
    run.model.stop()
    assert [file.name for file in tmp_path.iterdir()] == ["photos"]
    assert "nothing is kept" in run.events[0].properties["reason"]


def test_a_damaged_file_is_put_aside_with_a_message_and_kept(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    path.write_text('{"schema": 1, "ti')
    for number in (1, 2):
        run = Run(path)
        assert run.model.feeling().label == "calm"
        (event,) = run.events
        assert event.name == "memory.refused"
        assert f"feelings.unusable-{number}.json" in event.properties["reason"]
        run.model.stop()
        assert recall(path) is not None
        path.write_text('{"schema": 0}')
    assert (tmp_path / "feelings.unusable-1.json").read_text() == '{"schema": 1, "ti'


def test_what_cannot_be_written_is_told_once_and_tried_again(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    path = tmp_path / "file" / "feelings.json"
    run = Run(path)
    for _ in range(10):
        run.model.feel("praise")
        run.live(5)
    assert [event.name for event in run.events] == ["memory.failed"]
    assert run.model.feeling().label == "joy"
    (tmp_path / "file").unlink()
    run.model.stop()
    assert recall(path) is not None


def test_who_reads_the_file_knows_whose_it_is(tmp_path: Path) -> None:
    path = tmp_path / "feelings.json"
    run = Run(path, personality="optimist")
    run.model.stop()
    assert (memory := recall(path)) is not None
    assert memory.personality == "optimist"
    other = Run(path, personality="pessimist")
    assert other.model.feeling().valence < 0 < run.model.feeling().valence
