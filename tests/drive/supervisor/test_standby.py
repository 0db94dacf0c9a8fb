"""The line between a supervisor and the thread of the program that stands by for it."""

import os
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field

import pytest

from hri.drive.supervisor.link import pair
from hri.drive.supervisor.standby import Lifeline, Standby
from hri.drive.supervisor.watchdog import AGAIN, LastWords, Silence

STOP, BYE = b"stop!", b"bye.."
NOBODY = 2**22 + 1
"""More than the id of any process."""


@dataclass
class Stage:
    """Both sides, and a pipe in place of the port."""

    ends: tuple[int, int] = field(default_factory=os.pipe)

    def __post_init__(self) -> None:
        self.ours, theirs = pair()
        self.lifeline, self.standby = Lifeline(self.ours), Standby(theirs, LastWords(STOP, BYE))

    @property
    def port(self) -> int:
        return self.ends[1]

    def lend(self) -> None:
        self.lifeline.lend(self.port, os.getpid())
        self.lifeline.beat(0.0)

    def heard(self) -> bytes:
        """What comes out of the port next; nothing once nobody has it any more."""
        return os.read(self.ends[0], len(STOP))


@pytest.fixture
def stage() -> Iterator[Stage]:
    stage = Stage()
    yield stage
    stage.lifeline.withdraw()
    stage.lifeline.beat(100.0)
    stage.ours.close()
    stage.standby.wait()
    for end in stage.ends:
        with suppress(OSError):
            os.close(end)


def test_for_a_supervisor_that_falls_silent_the_program_stops_the_base_again_and_again(
    stage,
) -> None:
    stage.lend()
    assert [stage.heard() for _ in range(3)] == [STOP] * 3


def test_for_a_supervisor_that_has_ended_the_last_word_is_the_farewell(stage) -> None:
    stage.lifeline.lend(stage.port, NOBODY)
    stage.lifeline.beat(0.0)
    while stage.heard() != STOP:  # the supervisor is silent; the program has the port
        continue
    stage.ours.close()
    stage.standby.wait()
    os.close(stage.port)
    told = list(iter(stage.heard, b""))
    assert told.count(BYE) == 2
    assert told.index(BYE) == told.count(STOP) >= 3


def test_after_some_seconds_of_stops_the_base_is_left_to_itself_and_not_spoken_to() -> None:
    ours, port = os.pipe()
    silence, waited = Silence(LastWords(STOP, BYE), AGAIN), 0.0
    while silence.patience is not None:
        waited += silence.patience
        silence.answer(port)
    os.close(port)
    with os.fdopen(ours, "rb") as pipe:
        told = pipe.read()
    assert 4.5 < waited < 5.5
    assert told == STOP * round(waited / AGAIN) + BYE * 2


def test_a_base_without_a_farewell_is_stopped_on_and_on() -> None:
    silence = Silence(LastWords(STOP), AGAIN)
    for _ in range(1000):
        silence.answer(None)
    assert silence.patience == AGAIN


def test_a_port_that_was_taken_back_is_closed_and_not_written_to(stage) -> None:
    stage.lend()
    stage.lifeline.withdraw()
    stage.lifeline.beat(0.0)
    os.close(stage.port)
    assert stage.heard() == b""


def test_a_port_that_was_lent_in_the_place_of_another_is_the_one_that_is_stopped(stage) -> None:
    stage.lend()
    first, stage.ends = stage.ends, os.pipe()
    stage.lend()
    os.close(first[1])
    assert os.read(first[0], len(STOP)) == b""
    os.close(first[0])
    assert stage.heard() == STOP


def test_a_word_that_finds_the_line_full_is_said_again() -> None:
    ours, theirs = pair()
    lifeline, ends = Lifeline(ours), os.pipe()
    theirs.setblocking(False)
    now = 0.0
    with ours, theirs:
        for now in range(10_000):  # nobody reads
            lifeline.beat(now)
        lifeline.lend(ends[1], os.getpid())
        lifeline.beat(now)
        with suppress(BlockingIOError):
            while theirs.recv(100) != b"+":
                continue
            raise AssertionError("it was said into a full line")
        lifeline.beat(now)
        assert theirs.recv(100) == b"+"
        lifeline.withdraw()
    for end in ends:
        os.close(end)
