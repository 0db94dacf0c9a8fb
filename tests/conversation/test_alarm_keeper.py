"""Promises of a run and their file: kept, taken over by the next run, and forgotten on request."""

import json
from pathlib import Path

import pytest
import trio

from hri.conversation.alarm_file import alarm_file, forget, recall
from hri.conversation.alarm_keeper import TRY_AGAIN, AlarmKeeper
from hri.conversation.alarms import AlarmKind
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.signals import Event

TIMER, REMINDER = AlarmKind.TIMER, AlarmKind.REMINDER


@pytest.fixture(autouse=True)
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


class Run:
    """A robot that keeps its promises in a file, on the fake clock."""

    def __init__(self, path: Path | None = None) -> None:
        self.clock = FakeClock()
        self.events: list[Event] = []
        bus = EventBus(self.clock)
        bus.subscribe("memory.*", self.events.append)
        self.keeper = AlarmKeeper(path or alarm_file(), self.clock, bus)
        self.alarms = self.keeper.alarms

    def add(self, kind: AlarmKind, about: str, after: float = 60.0) -> None:
        self.alarms.add(kind, self.keeper.instant().wall + after, about, after)

    def live(self, seconds: float = 1.0) -> None:
        for _ in range(round(seconds / 0.1)):
            self.clock.advance(0.1)
            self.keeper.poll()

    def names(self) -> list[str]:
        return [alarm.about for alarm in self.alarms]


def test_the_next_run_has_what_this_one_promised() -> None:
    first = Run()
    first.add(TIMER, "tea")
    first.add(REMINDER, "call Eva")
    first.live()
    again = Run()
    assert again.names() == ["tea", "call Eva"]
    again.alarms.remove(next(iter(again.alarms)))
    again.live()
    assert Run().names() == ["call Eva"]
    assert alarm_file().stat().st_mode & 0o777 == 0o600


def test_it_is_kept_before_that_is_said_and_once_only() -> None:
    run = Run()

    async def promise() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(run.clock.drive)
            run.add(TIMER, "tea")
            assert await run.keeper.kept()
            (alarm,) = recall(alarm_file()).alarms.values()
            assert await run.keeper.begin(alarm)
            (begun,) = recall(alarm_file()).alarms.values()
            assert not await Run().keeper.begin(begun), "another run knows that it had begun"
            await run.keeper.end(begun)
            assert not recall(alarm_file()).alarms
            nursery.cancel_scope.cancel()

    trio.run(promise)


def test_what_names_someone_who_is_forgotten_goes_while_the_robot_runs() -> None:
    run = Run()
    run.add(REMINDER, "call Eva")
    run.add(TIMER, "tea")
    run.live()
    forget(alarm_file(), "eva")
    run.add(TIMER, "pasta")
    run.live()
    assert sorted(run.names()) == ["pasta", "tea"]
    assert "Eva" not in alarm_file().read_text()
    alarm_file().unlink()
    run.live()
    assert not run.names()


def test_a_disk_that_takes_nothing_is_said_once_and_tried_again(tmp_path: Path) -> None:
    run = Run()
    alarm_file().parent.parent.mkdir(exist_ok=True)
    alarm_file().parent.write_text("in the way")
    run.add(TIMER, "tea")
    run.live(3.0)
    assert [event.name for event in run.events] == ["memory.failed"]
    alarm_file().parent.unlink()
    run.live(TRY_AGAIN + 1.0)
    assert Run().names() == ["tea"]


def test_a_run_without_a_file_keeps_nothing() -> None:
    clock = FakeClock()
    keeper = AlarmKeeper(None, clock, EventBus(clock))
    keeper.alarms.add(TIMER, keeper.instant().wall + 1.0)
    keeper.poll()
    assert not alarm_file().exists()


GOOD = {"id": 1, "kind": "timer", "about": "", "due": 1.0, "length": 1.0}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{",
        '{"schema": 2}',
        *(
            json.dumps({"schema": 1, "last_id": 1, "wall": 1, "uptime": 1, "boot": "", **wrong})
            for wrong in (
                {"alarms": {}},
                {"alarms": [GOOD] * 101},
                {"alarms": [{**GOOD, "kind": "egg"}]},
                {"alarms": [{**GOOD, "about": "x" * 201}]},
                {"alarms": [{**GOOD, "due": 1e99}]},
                {"alarms": [{**GOOD, "id": 0}]},
                {"alarms": [], "wall": "noon"},
            )
        ),
    ],
)
def test_a_file_that_cannot_be_used_is_set_aside(text: str) -> None:
    alarm_file().parent.mkdir(parents=True)
    alarm_file().write_text(text)
    with pytest.raises(HriError, match=r"alarms\.json"):
        recall(alarm_file())
    run = Run()
    run.add(TIMER, "tea")
    run.live()
    assert Run().names() == ["tea"]
    assert alarm_file().with_name("alarms.unusable-1.json").read_text() == text


def test_a_file_that_others_may_write_is_not_used() -> None:
    run = Run()
    run.add(TIMER, "tea")
    run.live()
    alarm_file().chmod(0o666)
    with pytest.raises(HriError, match="someone else"):
        recall(alarm_file())
