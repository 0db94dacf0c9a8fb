"""Dialogues with forms of people who have not seen the files, typed or spoken:
`python -m benchmarks.conversation.form_talks --out forms.txt`.

The orders and meetings are those of `docs/forms.md`, the timers, alarms and reminders the skills of
the companion. Each line comes when the robot has said all it says; null is silence until it speaks
again. Of a time in words the clock counts, "7:15 AM", or how long it is, "20 minutes from now". Who
speaks and is not understood says the line again, or answers in plain words once the robot asks;
says no to what is wrong; and answers what is asked beyond the lines.
"""

from __future__ import annotations

import argparse
import json
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.progress import progress
from benchmarks.speech.voices import NEW, VOICES
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import ONE_CORE
from hri.bench.workers import variables, worker_pool
from hri.conversation.alarm_keeper import AlarmKeeper
from hri.conversation.filling import ASKED, CONFIRMED
from hri.core.clock import FakeClock
from hri.core.paths import house
from hri.core.signals import Event, Samples
from hri.hal.resource import Description
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener, Voice
from hri.speech.turn import QUESTION
from hri.task.context import TaskContext
from hri.testing import live_for
from hri.testing.dialogues import TYPED, write_shown_files

FOLDER = Path(__file__).parent / "forms"
PAGE = "docs/forms.md"
BLIND = (Description("screen", "Hri.BlankScreen"), Description("camera", "Hri.BlankCamera"))
HELLO = "hello robot"
HEARD = "speech.heard"
HEARING = (HEARD, "speech.rejected")
CALM = 2.0
"""Seconds of silence after which a person says the next line."""
PATIENCE = 12.0
"""Seconds after which nobody waits for its next words."""
REPEATS = 2
"""Times that a person says again what the robot did not get."""
MOST_PLAIN = 6
"""Answers in plain words, after which a person gives up."""
LONGEST = 180.0
"""Seconds after which a dialogue hangs."""
SHORTEST = 30
"""Seconds: numbers from there on are durations, those below are hours."""
AHEAD = " from now"
CHANGED = "changed"
"""What is asked for after a no."""
AND = " and "
CHANGES = {
    "pizza": "{size} with {toppings}",
    "meeting": "{day} at {hour}",
    "timer": "{duration}",
    "alarm": "{when}",
    "reminder": "{deed}",
}
"""What a person says where something was wrong, or no slot is asked for."""
PLAIN = "plain"
CONFIRMING = re.compile("^robot: Shall I order .* pizza with |^robot: [A-Z][a-z]+day at ")
"""What a robot says that asks whether all is right, up to its last slot."""
READ_BACK = {PLAIN: "nothing on it"}
"""What the robot says for it, where that is another word."""
CLOCK = re.compile(r"\d+:\d\d [AP]M")
NOON = "at noon"
LENGTH = re.compile(rf"^(\d+) (second|minute|hour)s?{AHEAD}$")
SECONDS = {"second": 1, "minute": 60, "hour": 3600}
NOTED = re.compile(r"(Monday|Tuesday|Wednesday) at (\d+)\?")


@dataclass
class Played:
    """One dialogue, and how it went."""

    form: str
    says: Sequence[str | None]
    expects: Mapping[str, Any] | None
    why: str
    transcript: list[str] = field(default_factory=list)
    done: Mapping[str, Any] | None = None
    hangs: bool = False
    plain: int = 0
    """Answers that are none of those lines."""

    @property
    def is_as_expected(self) -> bool:
        """Whether that was done."""
        if self.hangs or (self.done is None) != (self.expects is None):
            return False
        done, expects = self.done or {}, self.expects or {}
        when = expects.get("when", "")
        clock, length = CLOCK.search(when), LENGTH.search(when)
        if clock is not None and clock[0] not in done["when"].replace(NOON, "12:00 PM"):
            return False
        if length is not None and done["duration"] != int(length[1]) * SECONDS[length[2]]:
            return False
        return all(done.get(key) == value for key, value in expects.items() if key != "when")


def play(dialogue: Mapping[str, Any], voice: str = "") -> Played:
    """Play one to a fresh robot: typed, or spoken by a voice of `benchmarks.speech.voices`."""
    found = Played(dialogue["form"], dialogue["says"], dialogue["expects"], dialogue["why"])
    with TemporaryDirectory() as folder, variables(HRI_PATH=folder):
        write_shown_files(house() / PAGE, Path(folder, "skills"))
        devices = BLIND if voice else TYPED
        robot = Robot("companion", "simulated", clock=FakeClock(), devices=devices, seed=1)
        talk = partial(_talk, found=found, robot=robot, person=voice)
        events = live_for(robot, LONGEST, *robot.app.load_tasks(), talk)
    found.hangs = robot.clock.now() >= LONGEST - 1.0
    found.done = _done(found, robot, events)
    return found


async def _talk(context: TaskContext, found: Played, robot: Robot, person: str) -> None:
    def note(event: Event) -> None:
        found.transcript.append(f"robot: {event.properties['text']}")

    context.events.subscribe("speech.said", note)
    voice = context.behavior(Voice)
    if person:  # It cannot see who speaks, and whether that is to it: someone greets it first.
        await _say(context, VOICES[NEW[0]](HELLO))
    await _until_calm(context, voice)
    for number, line in enumerate([*found.says, None], 1):
        is_last = number >= len(found.says)
        if person and is_last and _asked(context) and not _may_agree(context, found):
            break  # Nobody agrees to what is wrong.
        found.transcript.append("(silence)" if line is None else f"you: {line}")
        if line is None:
            await _until_it_speaks(context, found.transcript)
        elif person:
            await _speak(context, found, person, line)
        else:
            context.behavior(Listener).type_line(line)
            await context.clock.sleep(0.5)
        await _until_calm(context, voice)
    while person and _asked(context) and found.plain < MOST_PLAIN:
        await _speak_plainly(context, found, person)
        await _until_calm(context, voice)
    robot.finish()


def _asked(context: TaskContext) -> str:
    """The slot that is asked for; `CONFIRMED`, `CHANGED`, or empty for nothing."""
    tag = context.board.slot(ASKED).value
    return str(tag or "") or (CHANGED if context.board.slot(QUESTION).value else "")


def _may_agree(context: TaskContext, found: Played) -> bool:
    """Whether a last line answers: in a form that asks whether all is right only if it is."""
    if found.expects is None or found.form not in ("pizza", "meeting"):
        return True
    return _asked(context) == CONFIRMED and _is_right(found)


def _is_right(found: Played) -> bool:
    """Whether the robot asks for a yes to what is expected."""
    *_, question = (line for line in found.transcript if CONFIRMING.search(line))
    *_, end = CONFIRMING.split(question.rstrip("?"))
    first, last = [_spoken(value) for value in (found.expects or {}).values()]
    return first in question and end.replace(", ", AND) == READ_BACK.get(last, last)


def _plain(context: TaskContext, found: Played) -> str:
    """What a person answers in plain words."""
    asked = _asked(context)
    if found.expects is None:
        return "never mind"
    values = {slot: _spoken(value) for slot, value in found.expects.items()}
    if asked == CONFIRMED:
        return "yes" if _is_right(found) else "no"
    if asked == CHANGED:
        return CHANGES[found.form].format_map(values)
    return values[asked]


async def _speak_plainly(context: TaskContext, found: Played, person: str) -> None:
    found.plain += 1
    line = _plain(context, found)
    found.transcript.append(f"you, plainly: {line}")
    await _say(context, VOICES[person](line))


async def _speak(context: TaskContext, found: Played, person: str, line: str) -> None:
    """Say a line; where the robot does not get it again, or in plain words once it has asked."""
    events: list[Event] = []
    following = [context.events.subscribe(name, events.append) for name in HEARING]
    voice = context.behavior(Voice)
    for attempt in range(1 + REPEATS):
        events.clear()
        if attempt and _asked(context):
            await _speak_plainly(context, found, person)
        else:
            await _say(context, VOICES[person](line))
        await _until_calm(context, voice)
        found.transcript += [f"({one.name} {one.properties['text']})" for one in events]
        if any(one.name == HEARD for one in events):
            break
    for one in following:
        one.cancel()


def _spoken(value: Any) -> str:
    """A value of a slot as a person says it; a duration is in seconds."""
    if isinstance(value, list):
        return AND.join(value) or PLAIN
    if isinstance(value, int) and value >= SHORTEST:
        return f"{value // 60} minutes" if value % 60 == 0 else f"{value} seconds"
    text = f"{value:g}" if isinstance(value, float) else str(value)
    text = text.replace(":00", "").replace("AM", "in the morning").replace("your ", "my ")
    return f"in {text.removesuffix(AHEAD)}" if text.endswith(AHEAD) else text


async def _say(context: TaskContext, samples: Samples) -> None:
    world = context.resources.obtain("world", SimulatedWorld)
    world.sound.add(samples, RATE, context.clock.now())
    await context.clock.sleep(len(samples) / RATE)


async def _until_it_speaks(context: TaskContext, transcript: Sequence[str]) -> None:
    """Say nothing until it asks again, or gives up."""
    before, end = len(transcript), context.clock.now() + PATIENCE
    while len(transcript) == before and context.clock.now() < end:
        await context.clock.sleep(0.1)


async def _until_calm(context: TaskContext, voice: Voice) -> None:
    silent = 0.0
    while silent < CALM:
        await context.clock.sleep(0.1)
        silent = silent + 0.1 if voice.is_idle else 0.0


def _done(found: Played, robot: Robot, events: Sequence[Event]) -> Mapping[str, Any] | None:
    """What was done in the end; None for nothing."""
    if found.form == "pizza":
        orders = [event.properties for event in events if event.name == "pizza.ordered"]
        return _order(orders[-1]) if orders else None
    if found.form == "meeting":
        questions = [match for line in found.transcript if (match := NOTED.search(line))]
        is_noted = any("Noted" in line for line in found.transcript)
        return {"day": questions[-1][1], "hour": float(questions[-1][2])} if is_noted else None
    alarms = list(AlarmKeeper.of(robot.context).alarms)
    if not alarms:
        return None
    last = alarms[-1]
    when = AlarmKeeper.of(robot.context).when_words(last)
    return {"duration": last.length, "deed": last.about, "when": when}


def _order(properties: Mapping[str, Any]) -> dict[str, Any]:
    toppings = properties["toppings"] or ()
    return {"size": properties["size"], "toppings": list(toppings)}


def main() -> None:
    """Raises SystemExit with 1 when a dialogue hangs, or too few end as expected."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.conversation.form_talks", description=__doc__
    )
    parser.add_argument("--out", metavar="FILE", help="the transcript to write")
    parser.add_argument("--only", nargs="*", default=[], help="sets of dialogues, such as nine")
    parser.add_argument("--spoken", action="store_true", help="by two voices, in turns")
    options = parser.parse_args()
    files = [
        file
        for file in sorted(FOLDER.glob("*.json"))
        if file.stem in options.only or not options.only
    ]
    dialogues = [one for file in files for one in json.loads(file.read_text())]
    voices = [NEW[number % 2] if options.spoken else "" for number in range(len(dialogues))]
    with variables(**ONE_CORE), worker_pool(os.cpu_count() or 1) as pool:
        played = list(progress(pool.map(play, dialogues, voices), len(dialogues), "dialogues"))
    right = sum(one.is_as_expected for one in played)
    hangs = sum(one.hangs for one in played)
    if options.out:
        Path(options.out).write_text("\n\n".join(map(_told, played)) + "\n")
    print(f"{right} of {len(played)} end as expected ({right / len(played):.0%}), {hangs} hang")
    if options.spoken:
        print(
            f"in {sum(one.plain > 0 for one in played)} the person had to say more than the lines"
        )
    raise SystemExit(hangs > 0 or right < 0.9 * len(played))


def _told(one: Played) -> str:
    mark = "as expected" if one.is_as_expected else "OTHERWISE"
    head = f"--- {mark}: {one.form}, {one.why}\nexpected: {one.expects}\ndone: {one.done}"
    return "\n".join([head, *one.transcript])


if __name__ == "__main__":
    main()
