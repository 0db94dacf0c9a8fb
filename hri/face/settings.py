"""What `face.toml` says: which targets make an expression or a viseme, and how the face lives."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from hri.core.errors import AuthoringError, Mistakes, did_you_mean
from hri.core.toml import REQUIRED as NO_DEFAULT, Table, load_toml
from hri.face.drawing.paint import Color, parse_color
from hri.face.layers import Layers, read_layers
from hri.face.vocabulary import AFFECT, LABELS, MOTIONS, REQUIRED, TURNS, VISEMES

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
    half: float
    """Share of blinks that do not shut the eyes wholly, 0 to 1."""
    uneven: float
    """Share of blinks in which one eye is seen to be later and to shut less, 0 to 1."""
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
    degrees: tuple[float, float]
    """How far the eyes have turned then: to either side, and up or down."""
    head_share: float
    """Of a look to the side or up, what the head turns, 0 to 1; the eyes do the rest."""


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
    neck: tuple[float, float] | None
    """Above the first y all moves with the head, below the second nothing does, and between them
    ever less; None where all of the drawing moves."""


@dataclass(frozen=True, slots=True)
class HeadSettings:
    """The head as a dome that turns: the face lies on it."""

    center: tuple[float, float]
    """Units of the drawing."""
    radius: tuple[float, float]
    """Half its width and half its height, units of the drawing."""
    depth: float
    """How far its nearest point lies in front of the center, units of the drawing."""
    yaw: float
    pitch: float
    """Degrees that headYaw and headPitch turn it when they are 1."""
    still: tuple[str, ...]
    """Patterns of the ids that do not turn with it, such as "neck*"."""
    depths: Mapping[str, float]
    """Patterns of ids, and how far these parts lie in front of its surface; behind is negative."""


@dataclass(frozen=True, slots=True)
class Timing:
    """How an expression that does not stay comes and goes, in seconds."""

    onset_s: float = 0.35
    """Until it is there."""
    apex_s: float = 2.5
    """While it holds."""
    offset_s: float = 0.8
    """Until it is gone."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The whole file."""

    about: str
    background: tuple[Color, Color]
    """In the middle and in the corners."""
    layers: Layers
    expressions: Mapping[str, Weights]
    """By label, aliases too."""
    timing: Mapping[str, Timing]
    """Of each of them."""
    affect: Mapping[str, tuple[float, float]]
    """Valence and arousal, -1 to 1, of the expressions that feelings blend between."""
    signs: tuple[str, ...]
    """Targets that are marks, such as a tear or "zzz", and no muscles: no mood shows them."""
    visemes: Mapping[str, Weights]
    head: HeadSettings | None
    """None when the head does not turn."""
    pupils: Weights
    """What high arousal adds."""
    blink: BlinkSettings
    gaze: GazeSettings
    idle: IdleSettings
    motion: MotionSettings


def load_settings(path: Path, targets: Collection[str]) -> Settings:
    """Read the file; `targets` are the names of targets and their sides. Raises AuthoringError."""
    table = load_toml(path, "face")
    head = _head(table.table("head")) if "head" in table else None
    channels = {*targets, *MOTIONS, *(() if head is None else TURNS)}
    expressions = _expressions(table, channels)
    settings = Settings(
        about=table.string("about", ""),
        background=_background(table.table("background")),
        layers=read_layers(table.table("layers", optional=True)),
        expressions=expressions,
        timing=_timing(table.table("timing", optional=True), expressions),
        affect=_affect(table.table("affect", optional=True), expressions),
        signs=_signs(table, channels),
        visemes=_visemes(table.table("visemes"), channels),
        head=head,
        pupils=_weights(table.table("pupils", optional=True), channels),
        blink=_blink(table.table("blink"), channels),
        gaze=_gaze(table.table("gaze"), channels),
        idle=_idle(table.table("idle", optional=True)),
        motion=_motion(table.table("motion")),
    )
    table.finish()
    return settings


def mistakes_in(path: Path, targets: Collection[str]) -> list[AuthoringError]:
    """All mistakes of the file, the first of each of its tables; `load_settings` raises only
    one.
    """
    mistakes = Mistakes()
    table = mistakes.keep(partial(load_toml, path, "face"))
    if table is None:
        return mistakes.errors
    channels = {*targets, *MOTIONS, *(TURNS if "head" in table else ())}
    for name, read in _TABLES.items():
        if (part := mistakes.keep(partial(table.table, name, optional=True))) is None:
            continue
        if name in table or name not in _MAY_BE_LEFT_OUT:
            mistakes.keep(partial(read, part, channels))
    for name in ("expressions", "visemes"):
        for _, below in mistakes.keep(partial(list[tuple[str, Table]], table.tables(name))) or ():
            mistakes.keep(partial(_weights, below, channels))
    mistakes.keep(partial(load_settings, path, targets))
    return sorted(
        {str(error): error for error in mistakes.errors}.values(),
        key=lambda error: (error.place.line, error.place.column),
    )


def _weights(table: Table, channels: Collection[str]) -> Weights:
    for name in table.data:
        if name not in channels:
            raise table.error(name, *_unknown(name, channels))
    return {name: table.number(name, minimum=-1.5, maximum=1.5) for name in table.data}


def _unknown(name: str, channels: Collection[str]) -> tuple[str, str]:
    what = f'the face has no target "{name}"'
    if name in TURNS:
        return what, "add a [head] table, which makes the head turn"
    return what, did_you_mean(name, channels, f"draw targets/{name}.svg")


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
    found: dict[str, Weights] = {}
    for label in table.data:
        if label not in LABELS:
            raise table.error(label, f'no expression "{label}"', did_you_mean(label, LABELS))
        found[label] = _weights(table.table(label), channels)
    for label in REQUIRED:
        if label not in found:
            what = f'the expression "{label}" is missing'
            raise table.error(None, what, f"add [expressions.{label}]")
    for alias in aliases.data:
        if alias in LABELS:
            what = f'"{alias}" is the name of an expression itself'
            raise aliases.error(alias, what, f"draw it as [expressions.{alias}]")
        found[alias] = found[aliases.string(alias, among=sorted(found))]
    return found


def _timing(table: Table, labels: Collection[str]) -> Mapping[str, Timing]:
    usual = _times(table, Timing())
    found = dict.fromkeys(labels, usual)
    for label, value in table.data.items():
        if isinstance(value, dict):
            if label not in labels:
                raise table.error(label, f'no expression "{label}"', did_you_mean(label, labels))
            own = table.table(label)
            found[label] = _times(own, usual)
            own.finish()
    table.finish()
    return found


def _times(table: Table, usual: Timing) -> Timing:
    return Timing(
        onset_s=table.number("onset_s", usual.onset_s, minimum=0.02, maximum=10),
        apex_s=table.number("apex_s", usual.apex_s, minimum=0, maximum=60),
        offset_s=table.number("offset_s", usual.offset_s, minimum=0.02, maximum=10),
    )


def _affect(table: Table, labels: Collection[str]) -> Mapping[str, tuple[float, float]]:
    found = {label: place for label, place in AFFECT.items() if label in labels}
    for label in table.data:
        if label not in labels:
            raise table.error(label, f'no expression "{label}"', did_you_mean(label, labels))
        found[label] = _pair(table, label, -1, 1)
    return found


def _signs(table: Table, channels: Collection[str]) -> tuple[str, ...]:
    signs = tuple(table.strings("signs", ()))
    for sign in signs:
        if sign not in channels:
            raise table.error("signs", *_unknown(sign, channels))
    return signs


def _pair(
    table: Table, name: str, least: float, most: float, default: Sequence[float] = NO_DEFAULT
) -> tuple[float, float]:
    """Two numbers within a range."""
    first, second = table.numbers(name, default, count=2)
    if not (least <= first <= most and least <= second <= most):
        what = f"{name} is {first:g}, {second:g}"
        raise table.error(name, what, f"write two numbers from {least:g} to {most:g}")
    return first, second


def _head(table: Table) -> HeadSettings:
    radius = _pair(table, "radius", 1, 10_000)
    depths = table.table("depths", optional=True)
    head = HeadSettings(
        center=_pair(table, "center", -10_000, 10_000),
        radius=radius,
        depth=table.number("depth", sum(radius) / 2, minimum=0, maximum=10_000),
        yaw=table.number("yaw_degrees", 25.0, minimum=0, maximum=40),
        pitch=table.number("pitch_degrees", 15.0, minimum=0, maximum=40),
        still=tuple(table.strings("still", ())),
        depths=depths.weights(-1000, 1000),
    )
    table.finish()
    return head


def _visemes(table: Table, channels: Collection[str]) -> Mapping[str, Weights]:
    found = {name: _weights(table.table(name), channels) for name in VISEMES}
    table.finish()
    return found


def _blink(table: Table, channels: Collection[str]) -> BlinkSettings:
    blink = BlinkSettings(
        weights=_weights(table.table("weights"), channels),
        rate=table.number("rate_per_minute", 17.0, minimum=0, maximum=60),
        double=table.number("double_share", 0.12, minimum=0, maximum=1),
        half=table.number("half_share", 0.08, minimum=0, maximum=1),
        uneven=table.number("uneven_share", 0.12, minimum=0, maximum=1),
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
    degrees = _pair(table, "degrees", 1, 60, (25.0, 18.0))
    share = table.number("head_share", 0.3, minimum=0, maximum=1)
    table.finish()
    return GazeSettings(right, left, up, down, degrees, share)


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
    pivot = _pair(table, "pivot", -10_000, 10_000)
    motion = MotionSettings(
        shift=table.number("shift", 12.0, minimum=0, maximum=100),
        roll=table.number("roll_degrees", 10.0, minimum=0, maximum=45),
        size=table.number("size", 0.05, minimum=0, maximum=0.5),
        pivot=pivot,
        neck=_neck(table) if "neck" in table else None,
    )
    table.finish()
    return motion


def _neck(table: Table) -> tuple[float, float]:
    top, bottom = _pair(table, "neck", -10_000, 10_000)
    if not top < bottom:
        what = f"neck is {top:g}, {bottom:g}"
        raise table.error("neck", what, "write the y of its top, then that of its bottom")
    return top, bottom


_MAY_BE_LEFT_OUT = ("layers", "head", "pupils", "idle")
_TABLES: dict[str, Callable[[Table, Collection[str]], object]] = {
    "background": lambda table, channels: _background(table),
    "layers": lambda table, channels: read_layers(table),
    "head": lambda table, channels: _head(table),
    "pupils": _weights,
    "blink": _blink,
    "gaze": _gaze,
    "idle": lambda table, channels: _idle(table),
    "motion": lambda table, channels: _motion(table),
}
"""What reads each table that depends on no other, for `mistakes_in`."""
