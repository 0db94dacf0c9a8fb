"""Everything that reads what somebody else wrote: how it is called, and good inputs to begin with.

A reader gets the path of an input; it returns, or raises HriError. Texts of peers and of options
are read from a file, too, so that all are tried in one way. What a reader needs is imported when it
is called: a child process loads the modules of one reader only.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from hri.bench.inputs import good
from hri.core.errors import HriError

Read = Callable[[Path], object]


@dataclass(frozen=True, slots=True)
class Reader:
    """One way into the program."""

    read: Read
    seeds: Callable[[], list[bytes]]
    """Good inputs."""
    file: str
    """Where an input lies, below a folder of HRI_PATH."""
    is_text: bool = True


def _named(name: str) -> Any:
    """The function `module:name`."""
    module, _, function = name.partition(":")
    return getattr(importlib.import_module(module), function)


def _function(name: str) -> Read:
    """The function `module:name`, imported when it is called."""
    return lambda path: _named(name)(path)


def _read_text(path: Path) -> str:
    """A text as it comes from a peer: whatever bytes it has."""
    return path.read_bytes().decode("utf-8", errors="surrogateescape")


def _app(path: Path) -> object:
    from hri.robot.app import load_app

    return load_app(str(path.parent)).load_networks()


def _archive(path: Path) -> None:
    from shutil import rmtree

    from hri.core.archive import unpack

    target = path.with_name("unpacked")
    try:
        unpack(path, target)
    except HriError:
        if target.exists():
            raise AssertionError("a part of the archive is left") from None
        raise
    rmtree(target)


def _choices(path: Path) -> object:
    from hri.hal.choices import load_choices

    return load_choices()


def _display(path: Path) -> object:
    from hri.emotion.display import load_display

    return load_display(path)


def _event_form(path: Path) -> None:
    from hri.task.events import parse_event, write_event

    event = parse_event(_read_text(path))
    if parse_event(write_event(event)) != event:
        raise AssertionError(f"{event} is not read as it was written")


def _event_query(path: Path) -> None:
    from hri.task.events import parse_query, write_query

    event = parse_query(_read_text(path))
    if parse_query(write_query(event)) != event:
        raise AssertionError(f"{event} is not read as it was written")


def _expression(path: Path) -> object:
    from hri.core.expression import evaluate

    return _refusing(evaluate, _read_text(path))


def _face_settings(path: Path) -> object:
    from hri.core import paths
    from hri.face.settings import load_settings
    from hri.face.vocabulary import sides_of

    drawings = [file.stem for file in (paths.house() / "faces/robot/targets").glob("*.svg")]
    return load_settings(path, {*drawings, *(side for name in drawings for side in sides_of(name))})


def _face_weights(path: Path) -> object:
    from hri.face.model import load_face
    from hri.face.recording import read_weights

    return read_weights(path, load_face("eyes"))


def _formula(path: Path) -> object:
    from hri.emotion.formula import parse_formula

    return _refusing(parse_formula, _read_text(path))


def _grammar_check(path: Path) -> object:
    """What `hri grammar check` says."""
    from hri.speech.grammar import read_grammar
    from hri.speech.grammar.check import check
    from hri.speech.pronunciation.lexicon import load_lexicon

    grammar, errors = read_grammar(path)
    if errors:
        raise errors[0]
    findings = check(grammar, load_lexicon())
    return list(map(str, findings))


def _grammar_hearing(path: Path) -> object:
    """What a recognizer does with a grammar, and what is understood of a sentence."""
    from hri.speech.grammar import load_grammar
    from hri.speech.grammar.matching import parse
    from hri.speech.pronunciation.lexicon import load_lexicon
    from hri.speech.recognizers.ctc.phone_graph import compile

    grammar = load_grammar(path)
    compile(grammar.graph(), load_lexicon())
    return parse(grammar, "go forward two meters and stop")


def _manifest(path: Path) -> object:
    from hri.core import paths
    from hri.speech.grammar import load_grammar

    grammar = load_grammar(paths.house() / "grammars/companion.jsgf")
    return _named("hri.cli.grammar.clips:read_manifest")(path, grammar)


def _names(path: Path) -> object:
    from hri.speech.grammar.name_lists import read_names

    return read_names(path, "friend")


def _people(path: Path) -> object:
    from hri.vision.recognition import Acquaintances

    return Acquaintances.load(path)


def _picture(path: Path) -> object:
    from hri.hal.drivers.picture_file import picture_size

    return picture_size(path)


def _poses(path: Path) -> object:
    from hri.vision.pose_file import Remarks, read_poses

    remarks = Remarks(path)
    return sum(1 for _ in read_poses(path, remarks)), list(remarks)


def _adaptation(path: Path) -> object:
    from hri.speech.recognizers.ctc.adaptation import adapted
    from hri.speech.recognizers.ctc.weights import find_weights, read_tensors

    return adapted(read_tensors(find_weights()), path)


def _run_of_robot(path: Path) -> object:
    return _named("hri.cli.drive.recorded:read_run")(str(path), "go_to")


def _scene(path: Path) -> object:
    from hri.face.model import load_face
    from hri.face.scene import load_scene

    return load_scene(path, load_face("eyes"), good.silent_voice())


def _stimuli(path: Path) -> object:
    from hri.emotion.stimulus import load_stimuli

    return load_stimuli()


def _timeline(path: Path) -> object:
    return _named("hri.cli.emotion.timeline:read_timeline")(path, ("praise", "scold", "greeting"))


def _values(path: Path) -> None:
    from hri.behavior.library.recording import ValuePlayer

    player = ValuePlayer("player")
    player.file = str(path)
    player.check()


def _wire_line(path: Path) -> list[object]:
    """A line of a peer; what it may not say is a ProtocolError."""
    from hri.net.protocol import Sender, decode

    return [decode(path.read_bytes(), Sender())]


def _refusing(parse: Callable[[str], object], text: str) -> object:
    """Parsers of parts of a file refuse with a sentence in a ValueError."""
    try:
        return parse(text)
    except ValueError as error:
        raise HriError(str(error)) from error


def _shipped(*patterns: str) -> Callable[[], list[bytes]]:
    return partial(good.shipped, patterns)


READERS: dict[str, Reader] = {
    "adaptation": Reader(_adaptation, good.adaptation, "a.npz", is_text=False),
    "app": Reader(_app, good.apps, "app/app.toml"),
    "archive": Reader(_archive, good.archives, "a.zip", is_text=False),
    "choice of devices": Reader(_choices, good.choices, "home/hri/devices.toml"),
    "emotion display": Reader(_display, _shipped("emotions/display.toml"), "display.toml"),
    "emotion timeline": Reader(_timeline, good.timelines, "timeline.txt"),
    "event form": Reader(_event_form, good.event_forms, "event.txt"),
    "event query": Reader(_event_query, good.event_queries, "event.txt"),
    "expectations": Reader(
        _function("hri.speech.grammar.expectations:read_expectations"), good.expectations, "a.txt"
    ),
    "expression": Reader(_expression, good.expressions, "expression.txt"),
    "face drawing": Reader(
        _function("hri.face.drawing:load_drawing"), _shipped("faces/*/targets/*.svg"), "a.svg"
    ),
    "face gestures": Reader(
        _function("hri.face.gestures:read_gestures"), _shipped("faces/gestures.toml"), "g.toml"
    ),
    "face settings": Reader(_face_settings, _shipped("faces/robot/face.toml"), "face.toml"),
    "face weights": Reader(_face_weights, good.weights, "weights.csv"),
    "formula": Reader(_formula, good.formulas, "formula.txt"),
    "grammar": Reader(
        _function("hri.speech.grammar:load_grammar"),
        _shipped("grammars/*.jsgf", "docs/adaptation/calibration/*.jsgf"),
        "grammars/a.jsgf",
    ),
    "grammar, checked": Reader(
        _grammar_check, _shipped("grammars/*.jsgf", "docs/tutorials/*/*.jsgf"), "grammars/a.jsgf"
    ),
    "grammar, heard": Reader(
        _grammar_hearing, _shipped("grammars/companion.jsgf", "docs/*/*/*.jsgf"), "grammars/a.jsgf"
    ),
    "head gestures": Reader(
        _function("hri.vision.patterns:load_patterns"), _shipped("config/gestures.toml"), "g.toml"
    ),
    "head poses": Reader(_poses, good.poses, "poses.csv"),
    "lexicon": Reader(
        _function("hri.speech.pronunciation.lexicon:read_lexicon"), good.lexicons, "lexicon.txt"
    ),
    "list of names": Reader(_names, good.names, "names.txt"),
    "manifest": Reader(_manifest, good.manifests, "manifest.tsv"),
    "memory of feelings": Reader(
        _function("hri.emotion.persistence:recall"), good.memories, "feelings.json"
    ),
    "network": Reader(
        _function("hri.behavior.network:load_network"),
        _shipped("config/networks/*.xml", "apps/*/*.xml"),
        "network.xml",
    ),
    "people": Reader(_people, good.people, "faces.json"),
    "personality": Reader(
        _function("hri.bench.inputs.good:load_personality_file"),
        _shipped("emotions/personalities/*.toml"),
        "personality.toml",
    ),
    "picture": Reader(_picture, good.pictures, "a.png", is_text=False),
    "recorded events": Reader(
        _function("hri.core.recording:read_events"), good.event_logs, "events.jsonl"
    ),
    "recorded run": Reader(_run_of_robot, good.runs, "events.jsonl"),
    "recorded values": Reader(_values, good.value_logs, "values.jsonl"),
    "resource configuration": Reader(
        _function("hri.hal.configuration:load_configuration"), _shipped("config/*.xml"), "c.xml"
    ),
    "scene": Reader(_scene, _shipped("docs/samples/face/*.toml"), "scene.toml"),
    "schema": Reader(
        _function("hri.behavior.schema:load_schema"),
        _shipped("config/behavior/*/*.xml", "docs/tutorials/*/behavior/*/*.xml"),
        "behavior/A/a.xml",
    ),
    "sound, MP3 and others": Reader(
        _function("hri.hal.drivers.wav_file:load_sound"), good.sounds, "a.ogg", is_text=False
    ),
    "sound, WAV": Reader(
        _function("hri.hal.drivers.wav_file:load_sound"), good.wavs, "a.wav", is_text=False
    ),
    "stimuli": Reader(
        _stimuli, _shipped("emotions/stimuli/*.toml"), f"emotions/stimuli/{good.stimulus_file()}"
    ),
    "video": Reader(
        _function("hri.hal.drivers.video_file:check_video"), good.videos, "a.avi", is_text=False
    ),
    "visit": Reader(
        _function("hri.simulation.script:load_visit"), _shipped("apps/*/demo.toml"), "visit.toml"
    ),
    "weights of the recognizer": Reader(
        _function("hri.speech.recognizers.ctc.weights:read_tensors"),
        good.tensors,
        "a.hama",
        is_text=False,
    ),
    "wire line": Reader(_wire_line, good.wire_lines, "line.txt"),
    "world": Reader(
        _function("hri.simulation.layout:load_layout"), _shipped("config/worlds/*.toml"), "w.toml"
    ),
}
"""By what is read."""
