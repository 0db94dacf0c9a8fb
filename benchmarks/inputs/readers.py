"""Everything that reads what someone else wrote, and good inputs to begin with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from random import Random

from benchmarks.inputs import calls, good
from benchmarks.inputs.mutation import mutated


@dataclass(frozen=True, slots=True)
class Reader:
    """One way into the program."""

    read: calls.Read
    seeds: Callable[[], list[bytes]]
    """Good inputs."""
    file: str
    """Where an input lies, below a folder of HRI_PATH."""
    is_text: bool = True


def _shipped(*patterns: str) -> Callable[[], list[bytes]]:
    return partial(good.shipped, patterns)


def _named(name: str, seeds: Callable[[], list[bytes]], file: str, is_text: bool = True) -> Reader:
    """A function `module:name` that takes the path of an input."""
    return Reader(calls.by_name(name), seeds, file, is_text)


READERS: dict[str, Reader] = {
    "app": Reader(calls.app, good.apps, "app/app.toml"),
    "archive": Reader(calls.archive, good.archives, "a.zip", is_text=False),
    "breakpoint": Reader(calls.condition, good.conditions, "condition.txt"),
    "choice of devices": Reader(calls.choices, good.choices, "home/hri/devices.toml"),
    "choice of skills": Reader(
        calls.choice_of_skills, good.choices_of_skills, "home/hri/skills.toml"
    ),
    "color": Reader(calls.color, _shipped("config/colors/*.color"), "a.color"),
    "draft of a network": Reader(calls.draft, good.drafts, ".n.xml.draft"),
    "emotion display": _named(
        "hri.emotion.display:load_display", _shipped("emotions/display.toml"), "display.toml"
    ),
    "emotion timeline": Reader(calls.timeline, good.timelines, "timeline.txt"),
    "entry to the studio": Reader(calls.entry, good.entries, "entry.txt"),
    "event form": Reader(calls.event_form, good.event_forms, "event.txt"),
    "event query": Reader(calls.event_query, good.event_queries, "event.txt"),
    "expectations": _named(
        "hri.speech.grammar.lint.expectations:read_expectations", good.expectations, "a.txt"
    ),
    "expression": Reader(calls.expression, good.expressions, "expression.txt"),
    "face drawing": _named(
        "hri.face.drawing.svg:load_drawing", _shipped("faces/*/targets/*.svg"), "a.svg"
    ),
    "face gestures": _named(
        "hri.face.motion.gesture_tracks:read_gestures", _shipped("faces/gestures.toml"), "g.toml"
    ),
    "face settings": Reader(calls.face_settings, _shipped("faces/robot/face.toml"), "face.toml"),
    "face weights": Reader(calls.face_weights, good.weights, "weights.csv"),
    "formula": Reader(calls.formula, good.formulas, "formula.txt"),
    "facial expressions": _named(
        "hri.vision.expressions.expression_patterns:load_expression_patterns",
        _shipped("config/expressions.toml"),
        "e.toml",
    ),
    "forms": Reader(calls.forms, good.forms, "forms.toml"),
    "grammar": _named(
        "hri.speech.grammar:load_grammar",
        _shipped("grammars/*.jsgf", "benchmarks/research/phone_network/calibration/*.jsgf"),
        "grammars/a.jsgf",
    ),
    "grammar, checked": Reader(
        calls.grammar_check,
        _shipped("grammars/*.jsgf", "docs/tutorials/*/*.jsgf"),
        "grammars/a.jsgf",
    ),
    "grammar, heard": Reader(
        calls.grammar_hearing,
        _shipped("grammars/companion.jsgf", "docs/*/*/*.jsgf"),
        "grammars/a.jsgf",
    ),
    "hand gestures": _named(
        "hri.vision.hands.hand_patterns:load_hand_patterns",
        _shipped("config/hands.toml"),
        "h.toml",
    ),
    "head gestures": _named(
        "hri.vision.gestures.gesture_patterns:load_patterns",
        _shipped("config/gestures.toml"),
        "g.toml",
    ),
    "head poses": Reader(calls.poses, good.poses, "poses.csv"),
    "idle acts": Reader(calls.idle_acts, _shipped("emotions/idle.toml"), "idle.toml"),
    "kinds of facts": Reader(calls.relations, good.relations, "memory.toml"),
    "lexicon": _named(
        "hri.speech.pronunciation.lexicon:read_lexicon", good.lexicons, "lexicon.txt"
    ),
    "list of names": Reader(calls.names, good.names, "names.txt"),
    "list of a free slot": Reader(calls.known_names, good.known_names, "names.txt"),
    "list of alarms": _named("hri.conversation.alarm_file:recall", good.alarms, "alarms.json"),
    "manifest": Reader(calls.manifest, good.manifests, "manifest.tsv"),
    "memory of feelings": _named("hri.emotion.persistence:recall", good.memories, "feelings.json"),
    "memory of people": _named(
        "hri.conversation.memory_file:recall", good.databases, "people.db", is_text=False
    ),
    "network": _named(
        "hri.behavior.network_file:load_network",
        _shipped("config/networks/*.xml", "apps/*/*.xml"),
        "network.xml",
    ),
    "network, laid out": Reader(calls.laid_out, good.laid_out, "network.xml"),
    "objects": Reader(calls.objects, good.object_sets, "a.mdl", is_text=False),
    "object, its manifest": Reader(
        calls.object_entry("model_set.json"), good.manifests_of_objects, "a.mdl"
    ),
    "object, its picture": Reader(
        calls.object_entry("0000-00.jpg"), good.pictures_of_objects, "a.mdl", is_text=False
    ),
    "objects by name": Reader(calls.objects, good.object_names, "a.mdl"),
    "order to the robot": Reader(calls.order, good.orders, "order.json"),
    "outside sentences": _named(
        "hri.speech.grammar.lint.outside_sentences:read_sentences",
        good.outside_sentences,
        "outside.txt",
    ),
    "people": Reader(calls.people, good.people, "faces.json"),
    "personality": _named(
        "benchmarks.inputs.good:load_personality_file",
        _shipped("emotions/personalities/*.toml"),
        "personality.toml",
    ),
    "picture": _named(
        "hri.hal.drivers.still_image:read_still", good.pictures, "a.png", is_text=False
    ),
    "recorded events": _named("hri.core.event_log:read_events", good.event_logs, "events.jsonl"),
    "recorded run": Reader(calls.run_of_robot, good.runs, "events.jsonl"),
    "recorded values": Reader(calls.values, good.value_logs, "values.jsonl"),
    "recording in the studio": Reader(calls.recording, good.recordings, "out/events.jsonl"),
    "replies": Reader(calls.replies, _shipped("apps/companion/replies.toml"), "replies.toml"),
    "resource configuration": _named(
        "hri.hal.configuration:load_configuration", _shipped("config/*.xml"), "c.xml"
    ),
    "saved emotions": Reader(
        calls.saved_emotions,
        _shipped("emotions/stimuli/*.toml"),
        f"emotions/stimuli/{good.stimulus_file()}",
    ),
    "saved grammar": Reader(calls.saved_grammar, _shipped("grammars/*.jsgf"), "grammars/a.jsgf"),
    "scene": Reader(calls.scene, _shipped("docs/samples/face/*.toml"), "scene.toml"),
    "schema": _named(
        "hri.behavior.schema:load_schema",
        _shipped("config/behavior/*/*.xml", "docs/tutorials/*/behavior/*/*.xml"),
        "behavior/A/a.xml",
    ),
    "skill": Reader(calls.skill, good.skills, "app/skills/a/skill.toml"),
    "sound, MP3 and others": _named(
        "hri.hal.drivers.wav_file:load_sound", good.sounds, "a.ogg", is_text=False
    ),
    "sound, WAV": _named("hri.hal.drivers.wav_file:load_sound", good.wavs, "a.wav", is_text=False),
    "sounds that are not words": _named(
        "hri.speech.vocalizations.vocalization:load_sounds",
        _shipped("emotions/sounds.toml"),
        "sounds.toml",
    ),
    "speech with markup": Reader(calls.speech, good.speeches, "speech.xml"),
    "stimuli": Reader(
        calls.stimuli,
        _shipped("emotions/stimuli/*.toml"),
        f"emotions/stimuli/{good.stimulus_file()}",
    ),
    "token": Reader(calls.token, good.tokens, "home/hri/token"),
    "video": _named("hri.hal.drivers.video_file:check_video", good.videos, "a.avi", is_text=False),
    "visit": _named(
        "hri.simulation.visit_script:load_visit", _shipped("apps/*/demo.toml"), "visit.toml"
    ),
    "table of cards": _named(
        "hri.vision.markers.card_table:load_cards",
        _shipped("apps/*/skills/*/cards.toml"),
        "cards.toml",
    ),
    "weights of the recognizer": _named(
        "hri.speech.recognizers.ctc.weights:read_tensors", good.tensors, "a.npz", is_text=False
    ),
    "wire line": Reader(calls.wire_line, good.wire_lines, "line.txt"),
    "world": _named(
        "hri.simulation.world_file:load_layout", _shipped("config/worlds/*.toml"), "w.toml"
    ),
}
"""By what is read."""


@cache
def seeds(name: str) -> list[bytes]:
    """The good inputs of a reader."""
    return READERS[name].seeds()


def bad_input(name: str, seed: int, number: int) -> bytes:
    """The input of a reader with a number: the same for the same seed, in every run."""
    return mutated(seeds(name), READERS[name].is_text, Random(f"{seed}/{name}/{number}"))
