"""A service in a child process: it answers, remembers, fails in one line, and comes back."""

import os
import signal
import time
from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock, RealClock
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Frame

PICTURE = np.arange(480 * 640 * 3, dtype=np.uint32).astype(np.uint8).reshape(480, 640, 3)
TIMEOUT = 30.0


class Counter:
    """Counts its questions; some of them are too much for it."""

    def __init__(self, start=0):
        self.count = start

    def __call__(self, question):
        self.count += 1
        if question == "fail":
            raise HriError("the picture is upside down - turn it")
        if question == "break":
            return 1 / 0
        if question == "die":
            os.kill(os.getpid(), signal.SIGKILL)
        if question == "print":
            print("libraries print")
        if question == "who":
            return os.getpid()
        if isinstance(question, Frame):
            return (
                self.count,
                int(question.image.sum()),
                question.time,
                question.image.flags.writeable,
            )
        return self.count


def broken_factory():
    raise HriError("no model - fetch it")


@dataclass
class Asker:
    """Asks a service of a real clock and waits for the answer."""

    clock: RealClock
    service: object

    def until(self, is_over):
        """Poll until something holds; what came and what was told meanwhile."""
        answers, told = [], []
        end = self.clock.now() + TIMEOUT

        def look():
            try:
                answers.extend(self.service.poll())
            except NotAvailable as error:
                told.append(str(error))
            return is_over(answers, told)

        assert self.clock.advance_until(look, end - self.clock.now())
        return answers, told

    def ask(self, question):
        self.until(lambda *_: not self.service.is_busy)
        self.service.ask(question)
        return self.until(lambda answers, told: answers or told)


@pytest.fixture(scope="module")
def asker():
    clock = RealClock()
    service = clock.service(partial(Counter, 10), 0.05)
    yield Asker(clock, service)
    service.close()
    service.close()


def test_it_answers_in_another_process_and_remembers(asker):
    (who,), _ = asker.ask("who")
    assert who == asker.service.process_id != os.getpid()
    (first,), _ = asker.ask("count")
    (second,), _ = asker.ask("count")
    assert second == first + 1


def test_a_picture_arrives_as_it_was(asker):
    ((_, total, when, is_writable),), _ = asker.ask(Frame(PICTURE, 1.5, 3))
    assert (total, when, is_writable) == (int(PICTURE.sum()), 1.5, True)
    ((_, part, *_),), _ = asker.ask(Frame(PICTURE[::2, ::3], 1.5, 3))
    assert part == int(PICTURE[::2, ::3].sum())


def test_what_a_library_prints_does_not_get_between_the_answers(asker):
    asker.ask("print")
    (count,), _ = asker.ask("count")
    assert isinstance(count, int)


def test_a_question_that_fails_is_one_line_and_the_memory_is_made_anew(asker):
    _, told = asker.ask("fail")
    assert told == ["the picture is upside down - turn it"]
    _, told = asker.ask("break")
    assert told == ["ZeroDivisionError: division by zero"]
    assert asker.ask("count")[0] == [11]


def test_a_service_that_dies_is_told_once_and_comes_back(asker):
    before = asker.service.process_id
    answers, told = asker.ask("die")
    assert (answers, told) == ([], ["its process ended - it is started again in 0.5 s"])
    answers, told = asker.ask("count")
    assert (answers, told) == ([11], [])
    assert asker.service.process_id != before


def test_a_service_that_hangs_is_ended_and_comes_back(asker, monkeypatch):
    asker.until(lambda *_: not asker.service.is_busy)
    monkeypatch.setattr("hri.core.service.PATIENCE", 0.05)
    os.kill(asker.service.process_id, signal.SIGSTOP)
    _, told = asker.ask("count")
    assert told == ["its process did not answer - it is started again in 0.5 s"]
    monkeypatch.undo()
    assert asker.ask("count")[0] == [11]


def test_asking_does_not_wait_and_a_second_question_is_refused(asker):
    costs = []
    for _ in range(5):  # the interpreter may collect garbage in one of them
        asker.until(lambda *_: not asker.service.is_busy)
        begun = time.thread_time()
        asker.service.ask(Frame(PICTURE, 0.0, 0))
        costs.append(time.thread_time() - begun)
        with pytest.raises(RuntimeError, match="busy"):
            asker.service.ask("count")
        asker.until(lambda answers, told: answers)
    assert min(costs) < 0.01


def test_a_service_that_cannot_be_made_tells_so_and_is_tried_again_later():
    clock = RealClock()
    asker = Asker(clock, clock.service(broken_factory, 0.0))
    _, told = asker.until(lambda answers, told: told)
    assert told == ["no model - fetch it - it is started again in 0.5 s"]
    assert asker.service.is_busy
    _, told = asker.until(lambda answers, told: told)
    assert told == ["no model - fetch it - it is started again in 1 s"]
    asker.service.close()


def test_the_child_ends_with_the_program():
    clock = RealClock()
    asker = Asker(clock, clock.service(Counter, 0.0))
    asker.until(lambda *_: not asker.service.is_busy)
    child = asker.service._child.process
    child.stdin.close()  # as it is when a program is killed
    assert child.wait(timeout=TIMEOUT) == 0
    asker.service.close()


def test_on_the_fake_clock_the_answer_shows_up_after_its_modeled_latency():
    clock = FakeClock()
    service = clock.service(partial(Counter, 5), 0.25)
    assert not service.is_busy
    service.ask("who")
    assert service.is_busy
    clock.advance(0.2)
    assert service.poll() == []
    clock.advance(0.05)
    assert service.poll() == [os.getpid()]
    assert not service.is_busy
    service.close()


def test_on_the_fake_clock_it_fails_as_the_process_does():
    clock = FakeClock()
    service = clock.service(partial(Counter, 5), 0.0)
    for question, reason in (
        ("fail", "the picture is upside down - turn it"),
        ("break", "ZeroDivisionError: division by zero"),
    ):
        service.ask(question)
        with pytest.raises(NotAvailable) as error:
            service.poll()
        assert str(error.value) == reason
    service.ask("count")
    assert service.poll() == [6]
    broken = clock.service(broken_factory, 0.0)
    broken.ask("count")
    with pytest.raises(NotAvailable, match="no model - fetch it"):
        broken.poll()


class Pipe:
    """Takes and gives only a few bytes at a time, as pipes may."""

    def __init__(self, step):
        self.data, self.step = bytearray(), step

    def write(self, part):
        part = bytes(part[: self.step])
        self.data += part
        return len(part)

    def readinto(self, view):
        part = bytes(self.data[: min(self.step, len(view))])
        del self.data[: len(part)]
        view[: len(part)] = part
        return len(part)


@settings(max_examples=40, deadline=None)
@given(
    st.lists(
        st.one_of(
            st.text(), st.integers(), st.lists(st.integers(0, 255), max_size=40).map(np.array)
        ),
        max_size=5,
    ),
    st.integers(1, 100),
)
def test_a_message_arrives_whole_whatever_pieces_the_pipe_makes_of_it(message, step):
    from hri.core.service import _receive, _send

    pipe = Pipe(step)
    _send(pipe, message)
    got = _receive(pipe)
    assert [np.asarray(part).tolist() for part in got] == [
        np.asarray(part).tolist() for part in message
    ]
    with pytest.raises(EOFError):
        _receive(pipe)
