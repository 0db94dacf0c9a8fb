"""Stateful work in a separate process, so that the robot loop never waits for it.

A service is made once by a factory, in a child process, and answers one question after the other.
Threads would not do: what holds the interpreter there keeps the loop waiting. The child sends its
answers through a pipe; arrays (pictures) are not copied on their way into it. It ends with the
program, however that ends, since its pipe is then closed; when it dies or hangs it is restarted.
"""

from __future__ import annotations

import contextlib
import logging
import os
import pickle
import signal
import struct
import subprocess
import traceback
from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial
from typing import Any, BinaryIO, Generic, TypeVar

from hri.core import child
from hri.core.errors import HriError, NotAvailable
from hri.core.realtime import join_realtime

Question = TypeVar("Question")
Answer = TypeVar("Answer")

PATIENCE = 5.0
"""Seconds for an answer; a child that takes longer hangs, and is ended."""
PATIENCE_AT_START = 30.0
"""Seconds to load libraries and models, on a slow machine."""
FIRST_PAUSE, LONGEST_PAUSE = 0.5, 30.0
"""Seconds before a dead child is started again; doubled by each failure in a row."""
COMMAND = "from hri.core.service import serve; serve()"
COURTESY = 5
"""How much the child yields to the robot loop where there are few processors (Unix `nice`)."""
LENGTH = struct.Struct("<Q")
MOST_PARTS = 10_000
"""Most arrays in a valid message."""

log = logging.getLogger("hri.service")


class Service(ABC, Generic[Question, Answer]):
    """Answers one question at a time, off the robot loop."""

    @property
    @abstractmethod
    def is_busy(self) -> bool:
        """True while a question is being answered, and while the service starts."""

    @abstractmethod
    def ask(self, question: Question) -> None:
        """Ask. Raises RuntimeError while it is busy."""

    @abstractmethod
    def poll(self) -> list[Answer]:
        """The answer, if it has come since the last call, else nothing; call it in every tick.

        Raises NotAvailable, once each time, when the question failed, or the service died; it is
        started again by itself, without its memory.
        """

    @abstractmethod
    def close(self) -> None:
        """End it at once; a second call does nothing."""


class ProcessService(Service[Question, Answer]):
    """A service in a child process."""

    def __init__(
        self, factory: Callable[[], Callable[[Question], Answer]], now: Callable[[], float]
    ) -> None:
        """`factory` must be known by name in a module, `now` gives seconds."""
        self._factory, self._now = factory, now
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="service", initializer=join_realtime)
        self._child: _Child | None = None
        self._future: Future[list[Answer]] | None = None
        self._failures = 0
        self._start_at = self._deadline = now()
        self._is_closed = False
        self.poll()

    @property
    def is_busy(self) -> bool:
        return self._future is not None or self._child is None

    @property
    def process_id(self) -> int | None:
        """Of the child; None while there is none."""
        return self._child.process.pid if self._child else None

    def ask(self, question: Question) -> None:
        if self.is_busy or self._child is None:
            raise RuntimeError("this service is busy - poll() it before you ask() again")
        child = self._child
        self._deadline = self._now() + PATIENCE
        self._future = self._pool.submit(lambda: [child.exchange(question)])

    def poll(self) -> list[Answer]:
        now = self._now()
        if self._future is None:
            if self._child is None and now >= self._start_at and not self._is_closed:
                self._start(now)
            return []
        if not self._future.done():
            if now > self._deadline and self._child is not None:
                self._child.kill()
            return []
        future, self._future = self._future, None
        try:
            answers = future.result()
        except _QuestionFailed as error:
            raise NotAvailable(str(error)) from error
        except Exception as error:
            raise NotAvailable(self._died(now, error)) from error
        if answers:
            self._failures = 0
        return answers

    def _start(self, now: float) -> None:
        try:
            child = self._child = _Child()
        except OSError as error:
            self._start_at = now + self._pause()
            raise NotAvailable(f"a process cannot be started: {error} - free memory") from error
        self._deadline = now + PATIENCE_AT_START
        self._future = self._pool.submit(lambda: child.prepare(self._factory))

    def _pause(self) -> float:
        self._failures += 1
        return min(LONGEST_PAUSE, FIRST_PAUSE * 2.0 ** (self._failures - 1))

    def _died(self, now: float, error: Exception) -> str:
        """Clear away, plan the next start, and say what has happened."""
        why = str(error) if isinstance(error, HriError) else "its process ended"
        if self._child is not None:
            if now > self._deadline:
                why = "its process did not answer"
            self._child.close()
            self._child = None
        pause = self._pause()
        self._start_at = now + pause
        return f"{why} - it is started again in {pause:g} s"

    def close(self) -> None:
        self._is_closed = True
        if self._child is not None:
            self._child.kill()
        self._pool.shutdown(wait=True, cancel_futures=True)
        if self._child is not None:
            self._child.close()
            self._child = None


class InlineService(Service[Question, Answer]):
    """A service that answers at once, and shows its answer when a worker shows its result."""

    def __init__(
        self,
        factory: Callable[[], Callable[[Question], Answer]],
        submit: Callable[[Callable[[], Answer]], None],
        poll: Callable[[], list[Answer]],
    ) -> None:
        """`submit` and `poll` are those of a worker (`hri.core.clock.Worker`)."""
        self._expert = _Expert(factory)
        self._submit, self._poll = submit, poll
        self._is_busy = False

    @property
    def is_busy(self) -> bool:
        return self._is_busy

    def ask(self, question: Question) -> None:
        if self.is_busy:
            raise RuntimeError("this service is busy - poll() it before you ask() again")
        self._is_busy = True
        self._submit(lambda: self._expert.answer(question))

    def poll(self) -> list[Answer]:
        try:
            answers = self._poll()
        except Exception as error:
            self._is_busy = False
            raise NotAvailable(_reason(error)) from error
        self._is_busy = self._is_busy and not answers
        return answers

    def close(self) -> None:
        self._is_busy = False


class _QuestionFailed(HriError):
    """The child lives, but this question was too much for it."""


class _Child:
    """The process and its two pipes."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(
            child.command("-c", COMMAND),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=child.environment(),
            bufsize=0,
        )

    def prepare(self, factory: object) -> list[Any]:
        """Let the child make its service; gives no answer yet."""
        try:
            self.exchange(factory)
        except _QuestionFailed as error:
            raise NotAvailable(str(error)) from error
        return []

    def exchange(self, question: object) -> Any:
        """Send, and wait for what comes back."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        _send(self.process.stdin, question)
        is_well, answer = _receive(self.process.stdout)
        if not is_well:
            reason, trace = answer
            log.debug("a service failed: %s", trace)
            raise _QuestionFailed(reason)
        return answer

    def kill(self) -> None:
        self.process.kill()

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                # What was not sent before it died does not matter any more.
                with contextlib.suppress(OSError):
                    pipe.close()


def serve() -> None:
    """Live as the child: make the service, then answer until the program closes the pipe."""
    for number in (signal.SIGINT, signal.SIGHUP):  # for the program, which ends us
        signal.signal(number, signal.SIG_IGN)
    if hasattr(os, "nice"):
        os.nice(COURTESY)
    # Libraries print to where the answers go; let them print beside.
    answers: BinaryIO = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)
    questions: BinaryIO = os.fdopen(0, "rb", buffering=0, closefd=False)
    with contextlib.suppress(EOFError, BrokenPipeError):
        expert = _Expert(_receive(questions))
        _send(answers, _attempt(expert.prepare))
        while True:
            question = _receive(questions)
            _send(answers, _attempt(partial(expert.answer, question)))


class _Expert(Generic[Question, Answer]):
    """What the factory makes; made again after a question that failed, whose trace it may bear."""

    def __init__(self, factory: Callable[[], Callable[[Question], Answer]]) -> None:
        self._factory = factory
        self._made: Callable[[Question], Answer] | None = None

    def prepare(self) -> None:
        self._made = self._factory()

    def answer(self, question: Question) -> Answer:
        made, self._made = self._made or self._factory(), None
        answer = made(question)
        self._made = made
        return answer


def _attempt(work: Callable[[], Any]) -> tuple[bool, Any]:
    try:
        return True, work()
    except Exception as error:
        return False, (_reason(error), traceback.format_exc())


def _reason(error: Exception) -> str:
    return str(error) if isinstance(error, HriError) else f"{type(error).__name__}: {error}"


def _send(pipe: Any, message: object) -> None:
    """Write a message; its arrays go from where they are."""
    arrays: list[pickle.PickleBuffer] = []
    head = pickle.dumps(message, protocol=5, buffer_callback=arrays.append)
    parts = [memoryview(head), *(array.raw() for array in arrays)]
    sizes = [LENGTH.pack(len(parts)), *(LENGTH.pack(part.nbytes) for part in parts)]
    for part in (memoryview(b"".join(sizes)), *parts):
        sent = 0
        while sent < part.nbytes:
            sent += pipe.write(part[sent:])


def _receive(pipe: Any) -> Any:
    """Read a message. Raises EOFError when the other side has ended."""
    (count,) = LENGTH.unpack(_read(pipe, LENGTH.size))
    if not 0 < count <= MOST_PARTS:
        raise EOFError("no message")
    sizes = [size for (size,) in LENGTH.iter_unpack(_read(pipe, count * LENGTH.size))]
    head, *arrays = [_read(pipe, size) for size in sizes]
    return pickle.loads(head, buffers=arrays)


def _read(pipe: Any, count: int) -> bytearray:
    data = bytearray(count)
    view, filled = memoryview(data), 0
    while filled < count:
        got = pipe.readinto(view[filled:])
        if not got:
            raise EOFError("the pipe is closed")
        filled += got
    return data
