"""The topics of the interface: what each value that the page, or a script, gets consists of.

The interface's document and the page's own types (`page/src/topics.ts`) are made from this table.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any, Literal, TypedDict

Number = float | None
"""None stands for what is infinite or unknown."""


class About(TypedDict):
    """The robot and its app, which may be a network alone; `networks` are the files of the app."""

    api: int
    app: str
    about: str
    is_simulated: bool
    has_base: bool
    is_network: bool
    networks: list[str]


class Speech(TypedDict):
    """Ears and voice."""

    is_hearing: bool
    is_muted: bool
    is_held: bool
    is_speaking: bool


class Saying(TypedDict):
    """What can be said: some sentences of a rule of the grammar, and what it is about."""

    rule: str
    about: str
    examples: list[str]


class FeelingCause(TypedDict):
    """A cause of the feeling, with its share of it from 0 to 1."""

    name: str
    share: float
    person: str


class Feeling(TypedDict):
    """What it feels: the mood's parts from -1 to 1, emotions and drives from 0 to 1."""

    label: str
    words: str
    why: str
    pleasure: float
    arousal: float
    dominance: float
    emotions: dict[str, float]
    drives: dict[str, float]
    causes: list[FeelingCause]


class Reason(TypedDict):
    """What began to be the strongest cause of the feeling, at a time in seconds."""

    t: float
    label: str
    why: str


class Moods(TypedDict):
    """The mood of the last minutes: rows of time (seconds), pleasure, arousal, and dominance."""

    points: list[list[float]]
    reasons: list[Reason]


class SeenPerson(TypedDict):
    """Someone in view: meters, radians to the left, seconds of the robot's clock; the box of the
    face, or of the body where that alone is seen, in pixels: left, top, width, height."""

    id: str
    name: str
    distance: Number
    bearing: Number
    engagement: str
    is_looking: bool
    is_attended: bool
    has_face: bool
    since: Number
    box: list[int] | None


class Eyes(TypedDict):
    """The camera, and who is in view."""

    is_watching: bool
    is_on: bool
    persons: list[SeenPerson]


class Range(TypedDict):
    """A range sensor: x, y, and direction on the robot; meters, None where nothing is in reach."""

    id: str
    at: list[float]
    distance: Number


class Base(TypedDict):
    """The base: x, y (meters), and heading (radians); m/s and rad/s; the battery from 0 to 1, null
    without one and while that is not known."""

    pose: list[float] | None
    velocity: list[float] | None
    battery: Number
    has_battery: bool
    is_stopped: bool
    why: str
    ranges: list[Range]


class Stop(TypedDict):
    """Where and why the base stopped, at a time in seconds."""

    t: float
    x: float
    y: float
    reason: str
    words: str


class Path(TypedDict):
    """Where the base was, where it means to go (points in meters), and where it stopped."""

    been: list[list[float]]
    planned: list[list[float]]
    stops: list[Stop]


class SimulatedPerson(TypedDict):
    """Someone in the simulated room."""

    name: str
    at: list[float]
    is_present: bool


class Thing(TypedDict):
    """Something in the simulated room that can be seen."""

    name: str
    at: list[float]


class PlacedObstacle(TypedDict):
    """Something round in the simulated room that was put there while the robot runs; meters."""

    name: str
    at: list[float]
    radius: float


class World(TypedDict):
    """The simulated room: walls (x1, y1, x2, y2), circles (x, y, radius), who and what is there."""

    walls: list[list[float]]
    circles: list[list[float]]
    people: list[SimulatedPerson]
    things: list[Thing]
    obstacles: list[PlacedObstacle]


class Device(TypedDict):
    """A device that is in use; `problem` is its problem and the remedy, or empty."""

    id: str
    says: str
    stand_in: str
    state: Literal["ok", "missing", "trouble"]
    problem: str


class LogLine(TypedDict):
    """A line of the log: seconds, how grave, the part of `hri` that wrote it, and the words."""

    t: float
    level: str
    part: str
    text: str


class Breakpoint(TypedDict):
    """Where a network pauses: an output, `behavior.output`, and what must hold for its value."""

    port: str
    condition: str


class RunningNetwork(TypedDict):
    """A network that runs: its file, seconds between ticks, and whether the page started it.

    `hit` says at which breakpoint it paused; it is empty otherwise.
    """

    name: str
    path: str
    interval: float
    is_paused: bool
    is_own: bool
    ticks: int
    missed: int
    breakpoint: Breakpoint | None
    hit: str


class PortValues(TypedDict):
    """What the outputs of a network sent last, by `behavior.output` and `board.slot`.

    `cost` has, by behavior, microseconds of its last tick, of a tick on average, and of the
    longest, and how often it was the slowest of a missed tick; `resting` are those that failed.
    """

    t: float
    tick: int
    values: dict[str, Any]
    cost: dict[str, list[float]]
    resting: list[str]


class ReasonStep(TypedDict):
    """An output or a slot on the way back to what decided, its value, and why it has that."""

    port: str
    value: Any
    words: str


class RobotEvent(TypedDict):
    """Something that happened, at a time in seconds; its own properties come beside."""

    t: float
    event: str


class Answer(TypedDict):
    """What became of a stop that was sent over the WebSocket, by its number."""

    answer: int
    error: str | None


TOPICS: Mapping[str, Any] = {
    "about": About,
    "speech": Speech,
    "sayings": list[Saying],
    "feeling": Feeling | None,
    "moods": Moods,
    "people": Eyes,
    "base": Base,
    "path": Path,
    "world": World | None,
    "devices": list[Device],
    "log": list[LogLine],
    "networks": list[RunningNetwork],
    "ports": dict[str, PortValues],
    "thumbnails": dict[str, str],
    "reasons": dict[str, list[ReasonStep]],
}
"""Types by the name of the topic. The last three come only while they are wanted: values on wires
by the name of the network, pictures (JPEG as base64) by `network/behavior.output`, and the way back
to what decided, nearest first, by `network/behavior.port`.
"""


def types() -> dict[str, Any]:
    """The types above by name, in their order."""
    here = vars(sys.modules[__name__])
    return {n: t for n, t in here.items() if isinstance(t, type) and hasattr(t, "__total__")}
