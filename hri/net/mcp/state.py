"""What the robot sees, feels and does now, and why; nobody's name."""

from __future__ import annotations

import math
from typing import Any

from hri.core.errors import HriError
from hri.core.signals import People, Person
from hri.emotion.behaviors import EmotionModel
from hri.hal.battery import Battery
from hri.hal.camera import Camera
from hri.hal.drive import Odometry
from hri.hal.emergency_stop import EmergencyStop
from hri.hal.range_sensor import RangeSensor
from hri.net.mcp.names import without
from hri.robot.app import App
from hri.speech.behaviors import Listener, Voice
from hri.task.context import TaskContext

MOST_PEOPLE, MOST_CAUSES, MOST_TASKS = 20, 6, 30
"""How many of each are shown."""
FAINT = 0.02
"""An emotion of less than this is not shown."""

Shown = dict[str, Any]


def state(context: TaskContext, names: frozenset[str]) -> Shown:
    """All of it, as JSON, without the names of people."""
    return {
        "app": App.of(context).name,
        "speech": _speech(context),
        "feeling": _feeling(context, names),
        "eyes": _eyes(context),
        "base": _base(context, names),
        "battery": _battery(context),
        "doing": [task.name for task in context.manager.running[:MOST_TASKS]],
    }


def _speech(context: TaskContext) -> Shown:
    listener, voice = context.find_behavior(Listener), context.find_behavior(Voice)
    return {
        "is_hearing": bool(context.board.slot("hearing").value),
        "is_muted": listener is not None and listener.is_muted,
        "is_speaking": voice is not None and not voice.is_idle,
    }


def _feeling(context: TaskContext, names: frozenset[str]) -> Shown | None:
    emotion = context.find_behavior(EmotionModel)
    if emotion is None:
        return None
    state = emotion.feeling()
    return {
        "label": state.label,
        "words": emotion.feeling_words(),
        "why": without(names, emotion.why_words()),
        "valence": _short(state.valence),
        "arousal": _short(state.arousal),
        "dominance": _short(state.dominance),
        "emotions": {n: _short(v) for n, v in state.emotions.items() if v >= FAINT},
        "drives": {name: _short(value) for name, value in state.drives.items()},
        "causes": {cause.name: _short(cause.share) for cause in emotion.why()[:MOST_CAUSES]},
    }


def _eyes(context: TaskContext) -> Shown:
    camera = next(iter(context.resources.opened(Camera)), None)
    seen = context.board.slot("people").value
    people = seen if isinstance(seen, People) else People(0.0)
    visible = [one for one in people.persons if one.is_visible][:MOST_PEOPLE]
    return {
        "camera_is_on": camera is not None and camera.is_on,
        "is_watching": camera is not None and camera.is_watching,
        "people": [_person(one, people.attended) for one in visible],
    }


def _person(person: Person, attended: str) -> Shown:
    return {
        "id": person.id,
        "distance_m": _short(person.distance),
        "bearing_deg": _short(math.degrees(person.bearing)),
        "engagement": person.engagement,
        "is_looking": person.is_looking,
        "is_attended": person.id == attended,
    }


def _base(context: TaskContext, names: frozenset[str]) -> Shown | None:
    resources, now = context.resources, context.clock.now()
    base = next(iter(resources.opened(EmergencyStop)), None)
    if base is None:
        return None
    odometry = next(iter(resources.opened(Odometry)), None)
    velocity = None if odometry is None else odometry.velocity(now)
    return {
        "is_stopped": base.is_latched,
        "why_it_stopped": without(names, base.explain()),
        "speed_m_s": None if velocity is None else _short(velocity.linear),
        "turning_deg_s": None if velocity is None else _short(math.degrees(velocity.angular)),
        "free_m": {one.id: _distance(one, now) for one in resources.opened(RangeSensor)},
    }


def _distance(sensor: RangeSensor, now: float) -> float | None:
    """Meters; None where nothing is in reach, or it does not measure."""
    try:
        return _short(sensor.read(now).distance)
    except HriError:
        return None


def _battery(context: TaskContext) -> float | None:
    """0 to 1; None without one, and while that is not known."""
    battery = next(iter(context.resources.opened(Battery)), None)
    level = None if battery is None else battery.level(context.clock.now())
    return None if level is None else _short(level)


def _short(value: float) -> float | None:
    return round(float(value), 3) if math.isfinite(value) else None
