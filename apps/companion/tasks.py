"""What the companion does: it converses, wonders, notices, and obeys the keys.

converse    replies to speech, as `replies.toml` says
wonder      asks a yes/no question now and then
take_saved_replies  reads the replies again when they are saved
notice      reacts to a bump and a low battery, and feels ignored; the triggers in
            emotions/stimuli handle other events
acquaint    keeps the memory of people, and greets those whose face is known
heed_hands  waves back, stops before an open hand, looks where someone points
attend      nods to who talks for long, and shows that it thinks
pose        moves the base a little as a feeling begins to show
idle        does small things while nothing happens: looks about, hums, stretches, dozes off
watch_keys  space stops it, r releases a base that must be released, m mutes the microphone, v turns
            the camera off and on, c switches captions, escape ends
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from hri.conversation import NEVER, load_forms, may_begin
from hri.core import KEYBOARD, Event, HriError, Worker, caused_by
from hri.emotion import load_stimuli
from hri.face import FaceRenderer
from hri.hal import Screen
from hri.robot import App
from hri.task import TaskContext

from .acquaintance import (
    Acquaintance,
    acquaint,
    ask_for,
    check_memory,
    forget_me,
    forget_that,
    introduce,
    know_about_me,
    know_me,
)
from .actions import (
    come,
    eyes,
    fidget_again,
    follow,
    move,
    no_fidgeting,
    no_sounds,
    quiet,
    release,
    sleep,
    sounds_again,
    stop,
    turn,
    wake,
)
from .asking import ask, next_question
from .companion import Companion, authored_replies, vocabulary_of
from .hands import heed_hands
from .idling import authored_acts, idle
from .moving_by_feeling import pose
from .presence import attend
from .puzzled import puzzle
from .replies import FILE, FORMS, Replies, load_replies
from .reply_files import with_named_files
from .things import find, forget, learn, see, where

__all__ = [
    "acquaint",
    "ask_for",
    "attend",
    "check",
    "come",
    "converse",
    "eyes",
    "fidget_again",
    "find",
    "follow",
    "forget",
    "forget_me",
    "forget_that",
    "heed_hands",
    "idle",
    "introduce",
    "know_about_me",
    "know_me",
    "learn",
    "move",
    "no_fidgeting",
    "no_sounds",
    "notice",
    "pose",
    "quiet",
    "release",
    "see",
    "sleep",
    "sounds_again",
    "stop",
    "take_saved_replies",
    "turn",
    "wake",
    "watch_keys",
    "where",
    "wonder",
]

log = logging.getLogger("hri.task")

LOOK_EVERY = 1.0
"""Seconds between looks at whether the replies have been saved."""
READING_SECONDS = 0.05
"""What reading them takes on a fake clock."""
IGNORED_SECONDS = 25.0
"""Calm while someone is there, after which it feels ignored; again after each such time."""
ALONE_SECONDS = 60.0
"""Seconds in which nobody is seen or heard, after which it is alone."""


def check(context: TaskContext) -> None:
    """Read what the tasks will need, before anything is opened. Raises AuthoringError."""
    authored_replies(context)
    authored_acts(context)
    check_memory(context)


def _changed_at(files: Sequence[Path]) -> list[float]:
    """When each file was saved; 0 for one that cannot be looked at."""
    times = []
    for file in files:
        try:
            times.append(file.stat().st_mtime)
        except OSError:
            times.append(0.0)
    return times


async def take_saved_replies(context: TaskContext) -> None:
    """Read the replies again when they, or the grammar, have been saved; keep the old if wrong.

    Raises `replies.changed` (file), or `replies.refused` (file, error).
    """
    companion = Companion.of(context)
    files, forms = App.of(context).files(FILE), App.of(context).files(FORMS)
    worker: Worker[Replies] = context.clock.worker(READING_SECONDS)
    vocabulary = vocabulary_of(context, companion.listener.loaded_grammar)
    watched = [*with_named_files(files), *forms]
    seen = _changed_at(watched)
    with context.queue("grammar.changed") as queue:
        while True:
            has_new_grammar = False
            with context.clock.move_on_after(LOOK_EVERY):
                has_new_grammar = (await queue.get()).properties["reloaded"]
            grammar = companion.listener.loaded_grammar
            # That of a question has no commands.
            has_new_grammar &= grammar.path == vocabulary.grammar.path
            if not has_new_grammar and seen == _changed_at(watched):
                continue
            watched = [*with_named_files(files), *forms]
            seen = _changed_at(watched)
            grammar = grammar if has_new_grammar else vocabulary.grammar
            vocabulary = replace(vocabulary, grammar=grammar, stimuli=load_stimuli())
            try:
                vocabulary = replace(vocabulary, forms=load_forms(forms))
                worker.submit(partial(load_replies, files, vocabulary))
                while not (read := worker.poll()):
                    await context.clock.sleep(READING_SECONDS)
                companion.replies = read[0]
                companion.listener.call(read[0].name)
                context.events.raise_event("replies.changed", file=str(files[-1]))
            except HriError as error:
                context.events.raise_event("replies.refused", file=str(files[-1]), error=str(error))


async def converse(context: TaskContext) -> None:
    """Reply to everything that is heard, and show what is not understood."""
    companion, known = Companion.of(context), Acquaintance.of(context)
    with context.queue(
        "speech.heard", "speech.rejected", "speech.continued", "speech.confirmed"
    ) as queue:
        while True:
            event = await queue.get()
            heard = event.properties
            if event.name == "speech.continued":
                companion.hold()
            elif event.name == "speech.confirmed":
                companion.resume()
            elif event.name == "speech.rejected":
                puzzle(companion, heard)
            if event.name != "speech.heard":
                continue
            try:
                known.note(heard["rule"], heard["tags"])
                companion.reply(
                    heard["rule"],
                    heard.get("command") or heard["text"],
                    dict(heard["tags"]),
                    bool(heard.get("may_go_on")),
                    bool(heard.get("continues")),
                )
            except (HriError, LookupError, ValueError, TypeError) as error:
                # A reply that cannot be filled in costs this reply, not the companion.
                why = f"nothing fills in {{{error.args[0]}}}" if type(error) is KeyError else error
                log.error("the reply to <%s> failed: %s", heard["rule"], why)
                context.events.raise_event("task.failed", task="converse", error=str(error))


async def wonder(context: TaskContext) -> None:
    """Ask a question now and then, when someone is there and nothing goes on."""
    companion = Companion.of(context)
    wondered = NEVER
    while companion.replies.questions:
        await context.clock.sleep(0.5)
        if not may_begin(companion.scene(wondered)):
            continue
        if (question := next_question(companion)) is not None:
            wondered = context.clock.now()
            ask(companion, question)


async def notice(context: TaskContext) -> None:
    """React to what happens, and feel that nothing happens."""
    companion = Companion.of(context)
    calm_since = heard_at = context.clock.now()
    is_alone = False
    deeds = {
        "bumper.pressed": partial(_bumped, companion),
        "battery.lowered": partial(_talk_about, companion, "battery_low"),
    }
    people = ("person.seen", "speech.heard", "question.answered", "speech.rejected")
    others = (*people, "person.lost")
    with context.queue(*deeds, *others) as queue:
        while True:
            event: Event | None = None
            with context.clock.move_on_after(1.0):
                event = await queue.get()
            now = context.clock.now()
            is_met = companion.is_asleep or companion.person() is not None
            if is_met or (event is not None and event.name in people):
                heard_at = now
            if is_alone != (now - heard_at >= ALONE_SECONDS):
                is_alone = not is_alone
                companion.emotion.feel("alone", float(is_alone))
            if event is not None:
                calm_since = now
                if event.name in deeds:
                    deeds[event.name]()
                elif event.name == "person.seen":
                    companion.emotion.feel("company", 1.0, event.properties.get("person"))
                elif event.name == "person.lost":
                    companion.emotion.feel("company", 0.0)
            elif not companion.is_calm or companion.is_asleep:
                calm_since = now
            elif now - calm_since > IGNORED_SECONDS and companion.person() is not None:
                calm_since = now
                companion.emotion.feel("ignored")


def _bumped(companion: Companion) -> None:
    companion.motion.stop()  # no second try: the person decides
    companion.make("startle")
    _talk_about(companion, "bump")


def _talk_about(companion: Companion, words: str) -> None:
    """What hurts or worries it is talked about first, before any question."""
    if not companion.is_asleep:
        companion.last_contact = max(companion.last_contact, companion.context.clock.now())
        companion.tell(words)


async def watch_keys(context: TaskContext) -> None:
    """Obey the keys of the window; closing it ends the program."""
    companion = Companion.of(context)
    screen = context.resources.obtain("screen", Screen)
    renderer = context.behavior(FaceRenderer)
    while True:
        await context.clock.sleep(0.05)
        for key in screen.pressed_keys():
            with caused_by(KEYBOARD):
                if key == "space":
                    companion.guard.halt("someone pressed the stop key")
                elif key == "r":
                    companion.guard.release()
                elif key == "m":
                    muted = companion.listener.is_muted = not companion.listener.is_muted
                    context.events.raise_event("microphone.muted", muted=muted)
                elif key == "v":
                    companion.switch_camera(not companion.camera.is_on)
                elif key == "c":
                    renderer.captions_on = not renderer.captions_on
                elif key == "escape":
                    context.events.raise_event("window.closed")
            if key == "space":  # what it says then are its own words
                companion.reply("stop", "stop", {})
        if screen.is_closed:
            context.events.raise_event("window.closed")
            return
