"""The tools: deeds, arguments, kinds. One table, `TOOLS`."""

from __future__ import annotations

import base64
import math
from collections.abc import Awaitable, Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import cv2
import trio

from hri.behavior.device_behaviors import CameraFrames
from hri.conversation.examples import nearest_sentence
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import quoted
from hri.core.signals import Frame, Image, Rejection, Utterance
from hri.drive.tasks import CRUISE
from hri.hal.camera import Camera
from hri.hal.emergency_stop import EmergencyStop
from hri.net.mcp import authored, proposals
from hri.net.mcp.arguments import Argument, Choice, Number, Text
from hri.net.mcp.checking import findings
from hri.net.mcp.names import without
from hri.net.mcp.permission import Kind
from hri.net.mcp.recent_events import MOST as MOST_EVENTS, RecentEvents, personal_rules
from hri.net.mcp.state import state
from hri.robot import Robot, verbs
from hri.speech.behaviors import Listener
from hri.speech.grammar import load_grammar, parse
from hri.speech.turn import QUESTION
from hri.speech.understanding import Heard
from hri.task.context import TaskContext
from hri.task.task import find_task
from hri.task.task_run import Job

BECAUSE = "an assistant told me to"
FARTHEST = 2.0
"""Meters of one move."""
SLOWEST = 0.05
"""m/s."""
LONGEST_SHOWN = 30.0
"""Seconds of an expression."""
LONGEST_ANSWER = 60.0
"""Seconds that a question waits."""
LONGEST_TASK = 120.0
"""Seconds after which a task of `run_task` is ended."""
WIDEST = 640
"""Pixels of a picture's longer side."""
QUALITY = 80
"""Of its JPEG, 0 to 100."""
NEXT_PICTURE = 3.0
"""Seconds to wait for it."""
UNDERSTOOD_WITHIN = 3.0
"""Seconds after which the answer does not wait for what becomes of a sentence."""
LOOK_EVERY = 0.02
FOR_PEOPLE = frozenset(("know_about_me", "forget", "forget_me", "forget_that"))
"""Commands of the companion about its memory, which only people give."""
TASKS = ("Hri.ComeHere", "Hri.FollowPerson", "Hri.WaitForPerson", "Hri.Wander")
"""What `run_task` can run in any app."""
SWITCHED_OFF = "the camera is switched off - a person switches it on, by a word or on the page"


@dataclass(frozen=True, slots=True)
class Asked:
    """The robot that is asked, in its loop, by one call."""

    robot: Robot
    context: TaskContext
    recent: RecentEvents

    def require_released(self) -> None:
        """Raise HriError while someone has stopped the base: only people let it go on."""
        for base in self.context.resources.opened(EmergencyStop):
            if base.is_latched:
                raise HriError(f"{base.explain()} - a person has to let it move again")


@dataclass(frozen=True, slots=True)
class Picture:
    """An answer that is a JPEG."""

    base64: str


@dataclass(frozen=True, slots=True)
class Tool:
    """Something that an assistant may ask for."""

    about: str
    kind: Kind
    do: Callable[..., Awaitable[Any]]
    """Takes `Asked` and the checked arguments; gives a `Picture` or JSON. Raises HriError."""
    arguments: Mapping[str, Argument] = field(default_factory=dict)
    longest: float = 20.0
    """Seconds after which it is ended."""


# --- reading ---


async def _state(asked: Asked) -> Any:
    heard = await asked.recent.last("speech.heard")
    return {"heard": heard, **state(asked.context, asked.recent.names.known(asked.context))}


async def _events(asked: Asked, after: float, most: float) -> Any:
    return {"events": await asked.recent.after(int(after), int(most))}


async def _look(asked: Asked) -> Picture:
    context = asked.context
    cameras = context.resources.opened(Camera)
    if not cameras:
        raise HriError("no camera is open - configure one, see `hri devices`")
    if not all(camera.is_on for camera in cameras):
        raise HriError(SWITCHED_OFF)
    frame = await _next_frame(context)
    picture = await context.blocking(_jpeg, frame.image)
    if not all(camera.is_on for camera in cameras):  # meanwhile
        raise HriError(SWITCHED_OFF)
    return Picture(picture)


async def _next_frame(context: TaskContext) -> Frame:
    """The next picture that a network sees. Raises HriError without one."""
    found: list[Frame] = []
    came = trio.Event()

    def see(frame: Frame, now: float) -> None:
        found.append(frame)
        came.set()

    with ExitStack() as stack:
        for name, runner in context.networks.runners.items():
            for one in runner.network.behaviors:
                if isinstance(one, CameraFrames):
                    watch = context.networks.watch(name, one.id, "raw_image", see)
                    stack.callback(watch.cancel)
        with context.clock.move_on_after(NEXT_PICTURE):
            await came.wait()
    if not found:
        raise HriError("no picture came - no network of the app sees, or the camera is lost")
    return found[0]


def _jpeg(image: Image) -> str:
    height, width = image.shape[:2]
    scale = min(1.0, WIDEST / max(height, width))
    turned = cv2.cvtColor(image, cv2.COLOR_RGB2BGR)
    if scale < 1:
        size = (max(1, round(width * scale)), max(1, round(height * scale)))
        turned = cv2.resize(turned, size, interpolation=cv2.INTER_AREA)
    _, data = cv2.imencode(".jpg", turned, (cv2.IMWRITE_JPEG_QUALITY, QUALITY))
    return base64.b64encode(data.tobytes()).decode("ascii")


async def _list_authored(asked: Asked, kind: str) -> Any:
    found = await asked.context.blocking(authored.listed, asked.robot.app)
    return {"files": [name for name, one in found.items() if kind in ("", one.kind)]}


async def _read_authored(asked: Asked, name: str) -> Any:
    app, blocking = asked.robot.app, asked.context.blocking
    return await blocking(lambda: authored.named(app, name).read())


async def _check_authored(asked: Asked, name: str, text: str) -> Any:
    app = asked.robot.app
    file = await asked.context.blocking(authored.named, app, name)
    found = await asked.context.blocking(findings, app, file, text or None)
    return {"is_fine": not found.wrong, "wrong": found.wrong, "remarks": found.remarks}


async def _stop(asked: Asked) -> Any:
    asked.robot.stop_until_released(BECAUSE)
    return "stopped; a person has to let it move again"


# --- expressing ---


async def _say(asked: Asked, text: str) -> Any:
    await verbs.say(asked.context, text)
    return "said"


async def _ask(asked: Asked, question: str, seconds: float, grammar: str) -> Any:
    context, path = asked.context, ""
    if grammar:
        file = await context.blocking(authored.named, asked.robot.app, grammar)
        if file.kind != "grammar":
            raise HriError(f'"{file.name}" is not a grammar - list_authored names some')
        path = str(file.path)
    answer = await verbs.ask(context, question, seconds, path)
    if not isinstance(answer, Utterance):
        return {"answer": answer}
    heard = await context.blocking(load_grammar, path)
    is_shown = answer.rule not in heard.made(personal_rules)
    text = without(asked.recent.names.known(context), answer.command or answer.text)
    return {"answer": text if is_shown else None, "rule": answer.rule}


async def _show(asked: Asked, expression: str, seconds: float) -> Any:
    await verbs.show(asked.context, expression, seconds)
    return "shown"


async def _gesture(asked: Asked, name: str, strength: float) -> Any:
    await verbs.gesture(asked.context, name, strength)
    return "made"


async def _propose_change(asked: Asked, name: str, text: str) -> Any:
    context, app = asked.context, asked.robot.app
    file = await context.blocking(authored.named, app, name)
    found = await context.blocking(findings, app, file, text)
    if found.wrong:
        raise HriError("not kept, it could not be used:\n" + "\n".join(found.wrong))
    kept = await context.blocking(proposals.keep, file, text)
    context.events.raise_event("mcp.proposed", file=file.name, draft=kept.name)
    return {"kept": kept.name, "for": file.name, "remarks": found.remarks}


# --- moving ---


async def _move(asked: Asked, distance_m: float, speed_m_s: float) -> Any:
    asked.require_released()
    return {"moved_m": round(await verbs.move(asked.context, distance_m, speed_m_s), 3)}


async def _turn(asked: Asked, angle_deg: float) -> Any:
    asked.require_released()
    turned = await verbs.turn(asked.context, math.radians(angle_deg))
    return {"turned_deg": round(math.degrees(turned), 1)}


async def _say_to_it(asked: Asked, text: str) -> Any:
    context = asked.context
    asked.require_released()
    if context.board.slot(QUESTION).value:
        raise HriError("it has asked a person something, who answers - try again in a while")
    listener = context.behavior(Listener)
    grammar = listener.loaded_grammar
    meant = await context.blocking(parse, grammar, text)
    personal = await context.blocking(grammar.made, personal_rules)
    if meant is not None and (meant.rule in personal | FOR_PEOPLE):
        raise HriError("only a person may say this to it - say what its grammar lists, of no one")
    told: list[Heard] = []
    listener.type_line(text, told.append)
    with context.clock.move_on_after(UNDERSTOOD_WITHIN):
        while not told:
            await context.clock.sleep(LOOK_EVERY)
    if not told:
        return {"understood": None, "reason": "not yet: other words came before"}
    if isinstance(heard := told[0], Rejection):
        nearest = await context.blocking(nearest_sentence, grammar, text)
        return {"understood": False, "reason": heard.reason, "nearest": nearest}
    return {"understood": True, "rule": heard.rule}


async def _run_task(asked: Asked, name: str) -> Any:
    asked.require_released()
    jobs = _tasks(asked.robot)
    if name not in jobs:
        raise HriError(f'no task "{quoted(name)}" - {did_you_mean(name, jobs)}')
    await jobs[name](asked.context)
    return "done"


def _tasks(robot: Robot) -> dict[str, Job]:
    """What `run_task` can run: some of every app, and what this one starts on events."""
    found: dict[str, Job] = {name: find_task(name) for name in TASKS}
    for part in (robot.app, *robot.app.all_skills()):
        for name in (one for names in part.on.values() for one in names):
            found[name] = robot.app.task_type(name, part)
    return found


_NAME = Text("as list_authored names it: grammars/companion.jsgf", longest=200)
TOOLS: Mapping[str, Tool] = {
    "state": Tool("what the robot hears, sees, feels and does now, and why", Kind.READS, _state),
    "events": Tool(
        "what happened lately, the oldest first; each event has a number",
        Kind.READS,
        _events,
        {
            "after": Number("the number of an event: only later ones", 0, 1e12, 0),
            "most": Number("how many, the newest", 1, MOST_EVENTS, 50),
        },
    ),
    "look": Tool("a picture of the camera, while its switch is on", Kind.READS, _look),
    "list_authored": Tool(
        "the files that say what it hears, replies, looks like, does and feels",
        Kind.READS,
        _list_authored,
        {"kind": Choice("only those of a kind", ("", *authored.KINDS), "")},
    ),
    "read_authored": Tool("the text of such a file", Kind.READS, _read_authored, {"name": _NAME}),
    "check_authored": Tool(
        "what is wrong with such a file, or would be with another text in it",
        Kind.READS,
        _check_authored,
        {
            "name": _NAME,
            "text": Text("instead of what it has", "", proposals.LONGEST, is_exact=True),
        },
        longest=90.0,
    ),
    "stop": Tool("stop the base at once, until a person lets it move again", Kind.STOPS, _stop),
    "say": Tool(
        "say a text, and wait until it is said",
        Kind.EXPRESSES,
        _say,
        {"text": Text("what is said")},
        longest=90.0,
    ),
    "ask": Tool(
        "ask a question: true or false for yes or no, also by nodding; null without an answer",
        Kind.EXPRESSES,
        _ask,
        {
            "question": Text("what is asked", longest=300),
            "seconds": Number("how long to wait for the answer", 1, LONGEST_ANSWER, 10),
            "grammar": Text("a grammar of other answers, as list_authored names it", "", 200),
        },
        longest=LONGEST_ANSWER + 60,
    ),
    "show": Tool(
        "show an expression on the face",
        Kind.EXPRESSES,
        _show,
        {
            "expression": Text("such as happy, sad, surprised", longest=60),
            "seconds": Number("how long", 0.5, LONGEST_SHOWN, 4),
        },
        longest=LONGEST_SHOWN + 10,
    ),
    "gesture": Tool(
        "make a gesture with the face",
        Kind.EXPRESSES,
        _gesture,
        {
            "name": Text("such as nod, shake, wink", longest=60),
            "strength": Number("how much", 0, 1.5, 1),
        },
    ),
    "propose_change": Tool(
        "keep another text for an authored file as a draft, if it is fine; a person applies it",
        Kind.EXPRESSES,
        _propose_change,
        {"name": _NAME, "text": Text("the whole file", None, proposals.LONGEST, is_exact=True)},
        longest=90.0,
    ),
    "move": Tool(
        "drive straight ahead, or back; it stops by itself before what is in the way",
        Kind.MOVES,
        _move,
        {
            "distance_m": Number("meters, back when negative", -FARTHEST, FARTHEST),
            "speed_m_s": Number("at most so fast", SLOWEST, CRUISE, CRUISE),
        },
        longest=60.0,
    ),
    "turn": Tool(
        "turn on the spot",
        Kind.MOVES,
        _turn,
        {"angle_deg": Number("degrees, left when positive", -360, 360)},
        longest=40.0,
    ),
    "say_to_it": Tool(
        "type a sentence to it as a person would: a command of its grammar, which may run a skill",
        Kind.MOVES,
        _say_to_it,
        {"text": Text("the sentence", longest=200)},
    ),
    "run_task": Tool(
        f"run a task to its end, {LONGEST_TASK:g} s at most: {', '.join(TASKS)}, or one of the app",
        Kind.MOVES,
        _run_task,
        {"name": Text("of the task", longest=100)},
        longest=LONGEST_TASK,
    ),
}
"""By name; docs/assistants.md has them as a table."""
