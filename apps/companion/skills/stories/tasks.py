"""Stories with a face for each line, and jokes that need two."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from hri.core import Table, load_toml
from hri.robot import verbs
from hri.task import Lane, TaskContext

FOLDER = Path(__file__).parent
WHO = str(FOLDER / "who.jsgf")
LONGEST = 60.0
"""Seconds for which a face is held at most."""
PAUSE = 0.5
"""Seconds between two lines of a story."""
PATIENCE = 10.0
"""Seconds for an answer."""


@dataclass(frozen=True)
class Line:
    """What is said, and the expression that goes with it."""

    say: str
    show: str


@dataclass(frozen=True)
class Story:
    """Its lines, and whom it is about."""

    hero: str
    lines: tuple[Line, ...]


@dataclass(frozen=True)
class Knock:
    """Who knocks, and how the joke ends."""

    who: str
    end: str


def read_tales(path: Path = FOLDER / "tales.toml") -> tuple[list[Story], list[Knock]]:
    """The stories and knock-knock jokes of a file. Raises AuthoringError for a mistake in it."""
    table = load_toml(path, "file of tales")
    stories = [_story(entry) for entry in table.array("story")]
    knocks = [_knock(entry) for entry in table.array("knock")]
    table.finish()
    if not stories or not knocks:
        raise table.error(None, "there is no story, or no joke", "write [[story]] and [[knock]]")
    return stories, knocks


def _story(entry: Table) -> Story:
    lines = [_line(one) for one in entry.array("lines")]
    story = Story(entry.string("hero"), tuple(lines))
    entry.finish()
    return story


def _line(entry: Table) -> Line:
    line = Line(entry.string("say"), entry.string("show"))
    entry.finish()
    return line


def _knock(entry: Table) -> Knock:
    knock = Knock(entry.string("who"), entry.string("end"))
    entry.finish()
    return knock


STORIES, KNOCKS = read_tales()


async def tell_story(context: TaskContext, hero: str = "") -> str | None:
    """Tell the story about that hero, or the one of all that was not told for the longest time.

    Whatever is said to it ends the story.
    """
    heroes = [story.hero for story in STORIES]
    told = _next(context, "story", [hero] if hero in heroes else heroes)
    story = STORIES[heroes.index(told)]
    face = Lane(context)
    try:
        with context.queue("speech.heard") as heard:
            for line in story.lines:
                face.start(verbs.show, line.show, LONGEST)
                await verbs.say(context, line.say)
                await context.clock.sleep(PAUSE)
                if heard:
                    return None
    finally:
        face.stop()
    return "The end."


async def tell_knock_joke(context: TaskContext) -> str | None:
    """Tell a joke with two questions; what answers none of them ends it."""
    names = [knock.who for knock in KNOCKS]
    knock = KNOCKS[names.index(_next(context, "knock", names))]
    for words in ("Knock, knock!", f"{knock.who}."):
        if await verbs.ask(context, words, PATIENCE, WHO, retries=1) is None:
            return None
    Lane(context).start(verbs.gesture, "laugh")
    return knock.end


def _next(context: TaskContext, kind: str, names: Sequence[str]) -> str:
    """The first of these that was not told yet, else the one that was told longest ago."""
    slot = context.board.slot(f"stories.{kind}")
    told: tuple[str, ...] = slot.value or ()
    name = min(names, key=lambda one: told.index(one) if one in told else -1)
    slot.set((*(one for one in told if one != name), name), context.clock.now())
    return name
