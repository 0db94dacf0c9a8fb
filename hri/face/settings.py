"""What `face.toml` says: which targets make an expression or a viseme, and how the face lives."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

from hri.core.errors import did_you_mean
from hri.core.toml import Table, load_toml
from hri.face.paint import Color, parse_color
from hri.face.vocabulary import EXPRESSIONS, REQUIRED, VISEMES

Weights = Mapping[str, float]
"""Weights by the name of a target, of one of its sides, or of a motion of the head."""


@dataclass(frozen=True, slots=True)
class BlinkSettings:
    """When and how the eyes blink."""

    weights: Weights
    """What is added while the eyes are shut."""
    rate: float
    """Blinks a minute at rest."""
    double: float
    """Share of blinks that come twice, 0 to 1."""
    close_s: float
    hold_s: float
    open_s: float


@dataclass(frozen=True, slots=True)
class GazeSettings:
    """What it takes to look to the edge of the range."""

    right: Weights
    left: Weights
    up: Weights
    down: Weights
    """Right and left are the viewer's."""


@dataclass(frozen=True, slots=True)
class IdleSettings:
    """How a face moves that does nothing."""

    saccade: float
    """Size of small eye movements, in units of gaze."""
    aversion: float
    """How far the eyes look away now and then, in units of gaze."""
    sway: float
    """Of the head, 1 is its full motion."""
    breaths: float
    """A minute."""


@dataclass(frozen=True, slots=True)
class MotionSettings:
    """How far the head moves when a motion channel is 1."""

    shift: float
    """Units of the drawing, for headX and headY."""
    roll: float
    """Degrees."""
    size: float
    """Share of the size, 0.05 is five percent."""
    pivot: tuple[float, float]
    """What it turns around and grows from, in units of the drawing."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The whole file."""

    about: str
    background: tuple[Color, Color]
    """In the middle and in the corners."""
    expressions: Mapping[str, Weights]
    visemes: Mapping[str, Weights]
    pupils: Weights
    """What high arousal adds."""
    blink: BlinkSettings
    gaze: GazeSettings
    idle: IdleSettings
    motion: MotionSettings


def load_settings(path: Path, channels: Collection[str]) -> Settings:
    """Read the file; `channels` are the names that may be weighted. Raises AuthoringError."""
    table = load_toml(path, "face")
    settings = Settings(
        about=table.string("about", ""),
        background=_background(table.table("background")),
        expressions=_expressions(table, channels),
        visemes=_visemes(table.table("visemes"), channels),
        pupils=_weights(table.table("pupils", optional=True), channels),
        blink=_blink(table.table("blink"), channels),
        gaze=_gaze(table.table("gaze"), channels),
        idle=_idle(table.table("idle")),
        motion=_motion(table.table("motion")),
    )
    table.finish()
    return settings


def _weights(table: Table, channels: Collection[str]) -> Weights:
    for name in table.data:
        if name not in channels:
            what = f'the face has no target "{name}"'
            raise table.error(name, what, did_you_mean(name, channels))
    return {name: table.number(name, minimum=-1.5, maximum=1.5) for name in table.data}


def _background(table: Table) -> tuple[Color, Color]:
    colors = _color(table, "middle"), _color(table, "corners")
    table.finish()
    return colors


def _color(table: Table, name: str) -> Color:
    try:
        return parse_color(table.string(name)).color
    except ValueError as error:
        raise table.error(name, f"{name}: {error}", 'write it as "#rrggbb"') from error


def _expressions(root: Table, channels: Collection[str]) -> Mapping[str, Weights]:
    """Expressions by label, aliases too."""
    table = root.table("expressions")
    aliases = root.table("aliases", optional=True)
    known = (*EXPRESSIONS, "listening", "thinking", *aliases.data)
    found: dict[str, Weights] = {}
    for label in table.data:
        if label not in known:
            raise table.error(label, f'no expression "{label}"', did_you_mean(label, known))
        found[label] = _weights(table.table(label), channels)
    for label in REQUIRED:
        if label not in found:
            what = f'the expression "{label}" is missing'
            raise table.error(None, what, f"add [expressions.{label}]")
    for alias in aliases.data:
        found[alias] = found[aliases.string(alias, among=sorted(found))]
    return found


def _visemes(table: Table, channels: Collection[str]) -> Mapping[str, Weights]:
    found = {name: _weights(table.table(name), channels) for name in VISEMES}
    table.finish()
    return found


def _blink(table: Table, channels: Collection[str]) -> BlinkSettings:
    blink = BlinkSettings(
        weights=_weights(table.table("weights"), channels),
        rate=table.number("rate_per_minute", 17.0, minimum=0, maximum=60),
        double=table.number("double_share", 0.12, minimum=0, maximum=1),
        close_s=table.number("close_s", 0.08, minimum=0.03, maximum=1),
        hold_s=table.number("hold_s", 0.03, minimum=0, maximum=1),
        open_s=table.number("open_s", 0.18, minimum=0.03, maximum=1),
    )
    table.finish()
    return blink


def _gaze(table: Table, channels: Collection[str]) -> GazeSettings:
    right, left, up, down = (
        _weights(table.table(way), channels) for way in ("right", "left", "up", "down")
    )
    table.finish()
    return GazeSettings(right, left, up, down)


def _idle(table: Table) -> IdleSettings:
    idle = IdleSettings(
        saccade=table.number("saccade", 0.05, minimum=0, maximum=0.5),
        aversion=table.number("aversion", 0.35, minimum=0, maximum=1),
        sway=table.number("sway", 0.2, minimum=0, maximum=1),
        breaths=table.number("breaths_per_minute", 14.0, minimum=0, maximum=60),
    )
    table.finish()
    return idle


def _motion(table: Table) -> MotionSettings:
    x, y = table.numbers("pivot", count=2)
    motion = MotionSettings(
        shift=table.number("shift", 12.0, minimum=0, maximum=100),
        roll=table.number("roll_degrees", 10.0, minimum=0, maximum=45),
        size=table.number("size", 0.05, minimum=0, maximum=0.5),
        pivot=(x, y),
    )
    table.finish()
    return motion
