"""The memory of a run and its file: written off the loop, and forgotten on request."""

import logging
from collections.abc import Iterator
from datetime import timedelta
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, rule

from hri.conversation.memory import MOST_PEOPLE, Memory
from hri.conversation.memory_file import Contents, change, forget_all, keep, recall, without
from hri.conversation.memory_keeper import TRY_AGAIN, MemoryKeeper, file_of_run
from hri.conversation.relations import Relation
from hri.core.clock import FakeClock, RealClock
from hri.core.event_bus import EventBus
from hri.core.signals import Event
from hri.core.stored_data_index import noted

RELATIONS = {"likes": Relation("likes", "You like {value}.", several=True)}


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


class Run:
    """A robot that remembers in a file, on the fake clock."""

    def __init__(self, path: Path | None) -> None:
        self.clock = FakeClock()
        self.events: list[Event] = []
        bus = EventBus(self.clock)
        bus.subscribe("memory.*", self.events.append)
        self.keeper = MemoryKeeper(path, RELATIONS, self.clock, bus)

    @property
    def memory(self) -> Memory:
        return self.keeper.memory

    def live(self, seconds: float = 2.0) -> None:
        for _ in range(round(seconds / 0.1)):
            self.clock.advance(0.1)
            self.keeper.poll(self.clock.now())

    def meet(self, name: str, *likes: str) -> int:
        now = self.clock.wall()
        id = self.memory.introduce(name, now).id
        self.memory.allow(id, now, "word")
        for value in likes:
            self.memory.learn(id, "likes", value, now)
        return id

    def told(self) -> list[str]:
        return [event.name for event in self.events]


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "people.db"


def names(file: Path) -> list[str]:
    return [person.name for person in (recall(file) or Contents({})).people.values()]


def test_what_is_learned_is_on_the_disk_soon_and_known_in_the_next_run(file: Path) -> None:
    run = Run(file)
    id = run.meet("Anna")
    run.live(1.0)
    assert names(file) == ["Anna"]
    run.memory.learn(id, "likes", "jazz", run.clock.wall())
    run.live(1.0)
    assert Run(file).memory.told(id) == ("You like jazz.",)


def test_the_end_of_a_run_waits_for_the_last_fact(file: Path) -> None:
    run = Run(file)
    run.meet("Anna", "jazz")
    run.keeper.close()
    assert names(file) == ["Anna"]


def test_without_consent_nothing_is_written_at_all(file: Path) -> None:
    run = Run(file)
    run.memory.learn(run.memory.introduce("Anna", run.clock.wall()).id, "likes", "jazz",
                     run.clock.wall())  # fmt: skip
    run.live()
    run.keeper.close()
    assert not file.exists()
    assert run.told() == []


def test_a_run_alone_writes_nothing(tmp_path: Path) -> None:
    run = Run(None)
    run.meet("Anna")
    run.live()
    run.keeper.close()
    assert list(tmp_path.rglob("*.db")) == []


@pytest.mark.parametrize(
    ("is_fake", "is_to_repeat", "is_kept"),
    [(False, False, True), (True, False, False), (False, True, False)],
)
def test_fake_time_and_runs_that_repeat_live_alone(
    is_fake: bool, is_to_repeat: bool, is_kept: bool
) -> None:
    clock = FakeClock() if is_fake else RealClock()
    assert (file_of_run(clock, is_to_repeat) is not None) == is_kept


def test_nothing_is_written_while_nothing_happens(file: Path) -> None:
    run = Run(file)
    run.meet("Anna")
    run.live()
    before = file.stat()
    run.live(5.0)
    assert file.stat().st_mtime_ns == before.st_mtime_ns
    assert file.stat().st_ino == before.st_ino


def test_who_asks_to_be_forgotten_is_gone_from_the_disk_within_a_second(file: Path) -> None:
    run = Run(file)
    id = run.meet("Quillobrand", "klezmer")
    run.meet("Ben")
    run.live()
    run.memory.forget(id)
    run.live(1.0)
    data = file.read_bytes()
    assert b"Quillobrand" not in data
    assert b"klezmer" not in data
    assert names(file) == ["Ben"]
    assert run.told() == []


def test_a_fact_that_is_to_be_forgotten_is_gone_too(file: Path) -> None:
    run = Run(file)
    id = run.meet("Anna", "klezmer", "tea")
    run.live()
    run.memory.unlearn(id, "likes", "klezmer")
    run.live(1.0)
    assert b"klezmer" not in file.read_bytes()
    assert run.memory.people[0].values("likes") == ("tea",)


def test_a_robot_that_runs_forgets_whom_hri_forget_forgot(file: Path) -> None:
    run = Run(file)
    anna, ben = run.meet("Anna", "jazz"), run.meet("Ben", "Anna", "tea")
    run.live()
    change(file, lambda kept: without(kept, "anna"))
    run.live(1.0)
    assert run.memory.person(anna) is None
    assert run.told() == ["memory.forgotten"]
    run.memory.learn(ben, "likes", "jam", run.clock.wall())
    run.live(1.0)
    assert names(file) == ["Ben"]
    assert run.memory.people[0].values("likes") == ("tea", "jam")
    assert b"Anna" not in file.read_bytes()


def test_what_was_forgotten_outside_does_not_come_back_with_what_was_learned_meanwhile(
    file: Path,
) -> None:
    run = Run(file)
    anna, ben = run.meet("Anna", "jazz"), run.meet("Ben", "Anna")
    run.live()
    change(file, lambda kept: without(kept, "anna"))
    run.memory.learn(anna, "likes", "tea", run.clock.wall())
    run.memory.learn(ben, "likes", "jam", run.clock.wall())
    run.live(1.0)
    assert names(file) == ["Ben"]
    assert run.memory.person(anna) is None
    assert run.memory.people[0].values("likes") == ("jam",)


def test_after_all_was_forgotten_there_is_no_file_until_someone_new_allows_it(file: Path) -> None:
    run = Run(file)
    run.meet("Anna")
    run.live()
    forget_all(file)
    run.live()
    assert not file.exists()
    assert run.memory.people == ()
    assert run.told() == ["memory.forgotten"]
    run.meet("Ben")
    run.live()
    assert names(file) == ["Ben"]


def test_a_file_that_cannot_be_used_is_set_aside_with_one_line(
    file: Path, caplog: pytest.LogCaptureFixture
) -> None:
    file.write_text("broken")
    with caplog.at_level(logging.ERROR):
        run = Run(file)
    (record,) = caplog.records
    assert "not a database" in record.message
    assert "people.unusable-1.db" in record.message
    assert "\n" not in record.message
    run.meet("Ben")
    run.live()
    assert names(file) == ["Ben"]
    assert file.with_name("people.unusable-1.db").read_text() == "broken"


def test_what_is_in_the_way_is_not_overwritten(
    file: Path, caplog: pytest.LogCaptureFixture
) -> None:
    file.mkdir()
    run = Run(file)
    run.meet("Anna")
    run.live()
    run.keeper.close()
    assert file.is_dir()
    assert len(caplog.records) == 1


def test_a_disk_that_refuses_is_told_once_and_tried_again(file: Path) -> None:
    run = Run(file)
    run.meet("Anna")
    file.parent.joinpath("people.db").mkdir()
    run.live(3 * TRY_AGAIN)
    assert run.told() == ["memory.failed"]
    file.rmdir()
    run.live(TRY_AGAIN + 1)
    assert names(file) == ["Anna"]


def test_two_robots_do_not_write_over_each_other(file: Path) -> None:
    one, other = Run(file), Run(file)
    one.meet("Anna")
    one.live()
    other.live()
    assert [person.name for person in other.memory.people] == ["Anna"]
    other.meet("Ben")
    other.live()
    one.live()
    assert [person.name for person in one.memory.people] == ["Anna", "Ben"]


def test_what_two_robots_learn_of_a_person_comes_together(file: Path) -> None:
    one = Run(file)
    id = one.meet("Anna", "jazz", "tea")
    one.live()
    other = Run(file)
    one.memory.learn(id, "likes", "jam", one.clock.wall())
    one.memory.unlearn(id, "likes", "tea")
    other.memory.learn(id, "likes", "honey", other.clock.wall())
    one.live()
    other.live()
    one.live()
    for run in (one, other, Run(file)):
        assert set(run.memory.people[0].values("likes")) == {"jazz", "jam", "honey"}


def test_two_robots_do_not_fill_the_file_beyond_its_limit(file: Path) -> None:
    one, other = Run(file), Run(file)
    for number in range(MOST_PEOPLE):
        one.meet(f"Anna {number}")
    other.memory.last_id = MOST_PEOPLE
    other.meet("Ben")
    one.live()
    other.live()
    assert other.told() == ["memory.failed"]
    assert len(names(file)) == MOST_PEOPLE


def test_two_robots_that_meet_people_at_the_same_time_say_so(file: Path) -> None:
    one, other = Run(file), Run(file)
    one.meet("Anna")
    other.meet("Ben")
    one.live()
    other.live()
    assert names(file) == ["Anna"]
    assert other.told() == ["memory.failed"]


def test_a_file_elsewhere_is_noted_so_that_it_can_be_forgotten(file: Path) -> None:
    run = Run(file)
    run.meet("Anna")
    run.live()
    assert noted("people") == [file]


def test_a_memory_of_long_ago_is_a_new_meeting(file: Path) -> None:
    run = Run(file)
    id = run.meet("Anna")
    run.live()
    kept = recall(file)
    assert kept is not None
    keep(file, kept)
    again = Run(file)
    meeting = again.memory.meet(id, again.clock.wall() + timedelta(days=1))
    assert meeting.away is not None
    assert meeting.person.meetings == 2


@pytest.fixture(autouse=True)
def quiet(caplog: pytest.LogCaptureFixture) -> Iterator[None]:
    yield
    assert all("\n" not in record.message for record in caplog.records)


class Forgetting(RuleBasedStateMachine):
    """Whatever is learned and forgotten, inside and outside, file and memory agree in the end."""

    def __init__(self) -> None:
        super().__init__()
        self.folder = TemporaryDirectory()
        self.file = Path(self.folder.name, "people.db")
        self.run = Run(self.file)
        self.gone: set[int] = set()

    def teardown(self) -> None:
        self.run.live()
        assert (recall(self.file) or Contents({})).people == self.run.memory.remembered
        assert not self.gone & {person.id for person in self.run.memory.people}
        self.run.keeper.close()
        self.folder.cleanup()

    @rule(name=st.sampled_from(["Anna", "Ben", "Clara"]))
    def meet(self, name: str) -> None:
        self.run.meet(name)

    @rule(data=st.data(), value=st.sampled_from(["Anna", "Ben", "jazz", "tea"]))
    def act(self, data: st.DataObject, value: str) -> None:
        memory, now = self.run.memory, self.run.clock.wall()
        if not memory.people:
            return
        id = data.draw(st.sampled_from([person.id for person in memory.people]))
        match data.draw(st.sampled_from(["learn", "unlearn", "forget"])):
            case "learn":
                memory.learn(id, "likes", value, now)
            case "unlearn":
                memory.unlearn(id, "likes", value)
            case "forget":
                memory.forget(id)
                self.gone.add(id)

    @rule(name=st.sampled_from(["Anna", "Ben", ""]))
    def forget_outside(self, name: str) -> None:
        before = (recall(self.file) or Contents({})).people
        if name:
            change(self.file, partial(without, name=name))
        else:
            forget_all(self.file)
        after = (recall(self.file) or Contents({})).people
        self.gone |= before.keys() - after.keys()

    @rule(seconds=st.sampled_from([0.1, 0.2, 1.0]))
    def live(self, seconds: float) -> None:
        self.run.live(seconds)


TestForgetting = Forgetting.TestCase
TestForgetting.settings = settings(max_examples=25, stateful_step_count=15)
