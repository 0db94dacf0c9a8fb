"""The robot as the studio's server knows it, and the pages that look at it.

A page that reads too slowly gets the newest values, and misses old ones.
"""

from __future__ import annotations

import itertools
import json
import math
import secrets
from collections import deque
from dataclasses import dataclass, field
from typing import Any
from weakref import WeakValueDictionary

import trio

from hri.core.errors import HriError
from hri.studio.commands import PRESS
from hri.studio.connections import Seat
from hri.studio.event_memory import EventMemory
from hri.studio.link import PICTURES, TEXT, VALUE, Unpacker, packed_json
from hri.studio.request_queue import MOST_REQUESTS, MOST_STOPS, STOP

PATIENCE = 2.0
"""Seconds that the robot has to answer."""
MOST_PRESSES = 100
"""Stops that are known again when they come by another way."""
NETWORK_TOPICS = frozenset({"ports", "reasons", "thumbnails"})
"""Topics that only pages get that want values."""


@dataclass(eq=False)
class Page:
    """One page that looks, and what it does not have yet."""

    proof: str = ""
    """Why it may look: its cookie, or its token."""
    seat: Seat | None = None
    """Of its connection."""
    values: dict[str, str] = field(default_factory=dict)
    pictures: dict[int, bytes] = field(default_factory=dict)
    answers: list[str] = field(default_factory=list)
    events: EventMemory[str] = field(default_factory=EventMemory)
    sending_since: float = math.inf
    """Since when it has not read what is sent."""
    wanted: frozenset[str] = frozenset()
    news: trio.Event = field(default_factory=trio.Event)

    @property
    def wants_values(self) -> bool:
        """Whether it looks at a network."""
        return not self.wanted <= PICTURES.keys()

    def take(self) -> list[str | bytes]:
        """All that is new; the page has it from now on."""
        found: list[str | bytes] = [*self.answers, *self.values.values(), *self.events.take()]
        found += self.pictures.values()
        for waiting in (self.answers, self.values, self.pictures):
            waiting.clear()
        self.news = trio.Event()
        return found


@dataclass(eq=False)
class Question:
    """What the robot was asked, for all who wait for the answer."""

    command: str
    is_answered: trio.Event = field(default_factory=trio.Event)
    answer: dict[str, Any] = field(default_factory=dict)


class Hub:
    """The robot as the server knows it, and the pages that look at it."""

    def __init__(self, link: trio.SocketStream) -> None:
        self._link = link
        self._outbox: deque[bytes] = deque()
        self._is_sending = False
        # The answers that the robot owes another server, which was killed, are not for this one.
        self._numbers = itertools.count(secrets.randbits(48))
        # Without those for whose answer no one waits any more.
        self._questions: WeakValueDictionary[int, Question] = WeakValueDictionary()
        self._presses: dict[str, Question] = {}
        """The last stops that have a name."""
        self._wanted: list[str] = []
        self.values: dict[str, str] = {}
        """The newest value of each topic, as JSON."""
        self._events: EventMemory[str] = EventMemory(most_flood=0)
        self.pages: set[Page] = set()

    async def follow(self) -> None:
        """Take what the robot sends, until it has ended."""
        unpacker = Unpacker()
        async for data in self._link:
            for kind, content in unpacker.feed(bytes(data)):
                if kind == TEXT:
                    self._take(json.loads(content), content.decode())
                elif kind == VALUE:
                    self._pass_on(*content.decode().split("\n", 1))
                else:
                    self._show(kind, content)

    def _pass_on(self, topic: str, value: str) -> None:
        """Give pages the value of a topic, which is JSON."""
        self.values[topic] = value
        for page in self.pages:
            if topic not in NETWORK_TOPICS or page.wants_values:
                page.values[topic] = _as_message(topic, value)
                page.news.set()

    def _take(self, message: dict[str, Any], text: str) -> None:
        if "answer" in message:
            question = self._questions.pop(message["answer"], None)
            if question is not None:
                question.answer = message
                question.is_answered.set()
            return
        self._events.add(message["event"], text)
        for page in self.pages:
            page.events.add(message["event"], text)
            page.news.set()

    def _show(self, kind: int, content: bytes) -> None:
        name = next(name for name, number in PICTURES.items() if number == kind)
        for page in self.pages:
            if name in page.wanted:
                page.pictures[kind] = bytes((kind,)) + content
                page.news.set()

    async def add(self, page: Page) -> None:
        """Let a page look: it begins with the newest of everything."""
        page.values = {topic: _as_message(topic, value) for topic, value in self.values.items()}
        page.events.extend(self._events)
        page.news.set()
        self.pages.add(page)

    async def remove(self, page: Page) -> None:
        """It looks no more."""
        self.pages.discard(page)
        await self.want()

    async def want(self) -> None:
        """Tell the robot which pictures someone looks at."""
        wanted = sorted(frozenset[str]().union(*(page.wanted for page in self.pages)))
        if wanted != self._wanted:
            await self._send({"wanted": wanted})
            self._wanted = wanted

    async def ask(self, command: str, arguments: dict[str, Any], patience: float = PATIENCE) -> Any:
        """The robot's answer. Raises HriError for a refusal, Waiting where none comes in time."""
        return await self.answer(await self.begin(command, arguments), patience)

    async def begin(self, command: str, arguments: dict[str, Any]) -> Question:
        """Ask, and do not wait for the answer. The same press of Stop that comes by another way is
        the question that was asked already. Raises HriError.
        """
        press = arguments.get(PRESS, "") if command == STOP else ""
        if press in self._presses:
            return self._presses[press]
        question, number = Question(command), next(self._numbers)
        self._questions[number] = question
        message = {"number": number, "command": command, "with": arguments}
        await self._send(message, most=MOST_STOPS if command == STOP else MOST_REQUESTS)
        if press:
            self._presses[press] = question
            while len(self._presses) > MOST_PRESSES:
                del self._presses[next(iter(self._presses))]
        return question

    async def answer(self, question: Question, patience: float = PATIENCE) -> Any:
        """What it answers. Raises HriError for a refusal, Waiting where no answer comes in time."""
        with trio.move_on_after(patience):
            await question.is_answered.wait()
        if not question.answer:
            raise Waiting(question.command)
        if question.answer["error"] is not None:
            raise HriError(question.answer["error"])
        return question.answer["result"]

    async def _send(self, message: dict[str, Any], most: int = MOST_REQUESTS) -> None:
        """Whoever sends already sends this as well: no one else waits for a robot that reads
        nothing. Raises HriError when it has ended, or when `most` wait.
        """
        if len(self._outbox) >= most:  # of stops more may wait, so one waits behind all else
            raise HriError("the robot reads nothing - its process may be held up, or has ended")
        self._outbox.append(packed_json(message))
        if self._is_sending:
            return
        self._is_sending = True
        try:
            with trio.CancelScope(shield=True):  # a part of a message would make junk of the rest
                while self._outbox:
                    await self._link.send_all(self._outbox.popleft())
        except trio.BrokenResourceError:
            raise HriError("the robot has ended") from None
        finally:
            self._is_sending = False


def _as_message(topic: str, value: str) -> str:
    """What a page gets of a topic; `value` is JSON."""
    return f'{{"topic":"{topic}","value":{value}}}'


class Waiting(HriError):
    """The robot has not answered yet."""

    def __init__(self, command: str) -> None:
        stops = "it stops as soon as its loop goes on, unless it has ended"
        remedy = stops if command == STOP else "it may be busy, or has ended"
        super().__init__(f"the robot does not answer - {remedy}")
        self.is_certain = command == STOP
        """Whether it will be done."""
