"""How each reader is called with the path of an input.

A reader returns, or raises HriError; one that keeps something checks that a refused input changed
nothing. What it needs is imported when it is called: a child process loads the modules of one
reader only. Texts of peers and of options are read from a file, too.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from benchmarks.inputs import good
from hri.core.errors import HriError

Read = Callable[[Path], object]


def named(name: str) -> Any:
    """The function `module:name`."""
    module, _, function = name.partition(":")
    return getattr(importlib.import_module(module), function)


def by_name(name: str) -> Read:
    """The function `module:name`, imported when it is called."""
    return lambda path: named(name)(path)


def _read_text(path: Path) -> str:
    """A text as it comes from a peer: whatever bytes it has."""
    return path.read_bytes().decode("utf-8", errors="surrogateescape")


def app(path: Path) -> object:
    """An app, and the networks that it names."""
    from hri.robot.app import load_app

    return load_app(str(path.parent)).load_networks()


def archive(path: Path) -> None:
    """An archive, which is unpacked whole or not at all."""
    from shutil import rmtree

    from hri.core.fetch.archive import unpack

    target = path.with_name("unpacked")
    try:
        unpack(path, target)
    except HriError:
        if target.exists():
            raise AssertionError("a part of the archive is left") from None
        raise
    rmtree(target)


def choices(path: Path) -> object:
    """The choice of devices, in the folder of settings."""
    from hri.hal.choices import load_choices

    return load_choices()


def forms(path: Path) -> object:
    """The forms of a file, whose grammar is a shipped one."""
    from hri.conversation.forms import load_forms

    return load_forms([path])


def skill(path: Path) -> object:
    """A skill of an app, and the networks that it names; a broken one is off."""
    from hri.core.errors import HriError
    from hri.robot.app import load_app

    folder = path.parents[2]
    (folder / "app.toml").write_text('networks = ["networks/wander"]\n')
    app = load_app(str(folder))
    for one in app.off:
        raise HriError(one.why)
    return app.load_networks()


def choice_of_skills(path: Path) -> object:
    """The skills that are off, in the folder of settings."""
    from hri.robot.skills import turned_off

    return turned_off()


def event_form(path: Path) -> None:
    """An event as people read it."""
    _survives("event", _read_text(path))


def event_query(path: Path) -> None:
    """An event over the wire."""
    _survives("query", _read_text(path))


def _survives(kind: str, text: str) -> None:
    """What is read must survive being written."""
    parse, write = (named(f"hri.task.events:{verb}_{kind}") for verb in ("parse", "write"))
    event = parse(text)
    if parse(write(event)) != event:
        raise AssertionError(f"{event} is not read as it was written")


def expression(path: Path) -> object:
    """The value of a parameter."""
    from hri.core.expression import evaluate

    return _refusing(evaluate, _read_text(path))


def face_settings(path: Path) -> object:
    """The settings of a face with the drawings of `robot`."""
    from hri.core import paths
    from hri.face.settings import load_settings
    from hri.face.vocabulary import sides_of

    drawings = [file.stem for file in (paths.house() / "faces/robot/targets").glob("*.svg")]
    return load_settings(path, {*drawings, *(side for name in drawings for side in sides_of(name))})


def idle_acts(path: Path) -> object:
    """The acts of a file beside those that come with `hri`, for the gestures of `robot`."""
    from hri.conversation import load_idle_acts
    from hri.face.model import load_face
    from hri.face.motion.gesture_tracks import load_gestures

    return load_idle_acts([path], load_gestures(load_face()))


def face_weights(path: Path) -> object:
    """The recording of a face."""
    from hri.face.live_link import read_weights
    from hri.face.model import load_face

    return read_weights(path, load_face("eyes"))


def formula(path: Path) -> object:
    """How strong a stimulus is."""
    from hri.emotion.formula import parse_formula

    return _refusing(parse_formula, _read_text(path))


def grammar_check(path: Path) -> object:
    """What `hri grammar check` says."""
    from hri.speech.grammar import read_grammar
    from hri.speech.grammar.lint.linter import check
    from hri.speech.pronunciation.lexicon import load_lexicon

    grammar, errors = read_grammar(path)
    if errors:
        raise errors[0]
    findings = check(grammar, load_lexicon())
    return list(map(str, findings))


def grammar_hearing(path: Path) -> object:
    """What a recognizer does with a grammar, and what is understood of a sentence."""
    from hri.speech.grammar import load_grammar
    from hri.speech.grammar.matching import parse
    from hri.speech.pronunciation.lexicon import load_lexicon
    from hri.speech.recognizers.ctc.phone_graph import compile

    grammar = load_grammar(path)
    compile(grammar.graph(), load_lexicon())
    return parse(grammar, "go forward two meters and stop")


@cache
def _grammar_of_companion() -> Any:
    from hri.core import paths
    from hri.speech.grammar import load_grammar

    return load_grammar(paths.house() / "grammars/companion.jsgf")


def manifest(path: Path) -> object:
    """A list of recordings."""
    return named("hri.cli.grammar.manifest:read_manifest")(path, _grammar_of_companion())


def names(path: Path) -> object:
    """A list of names."""
    from hri.speech.grammar.name_lists import read_names

    return read_names(path, "friend")


def known_names(path: Path) -> object:
    """What a free slot usually is."""
    from hri.speech.grammar.name_lists import read_known

    return read_known(path)


def color(path: Path) -> object:
    """A color, and what is done with it."""
    import numpy as np

    from hri.vision.color.segmentation import ColorSegmenter, tables_of

    noise = np.random.default_rng(1).integers(0, 256, (12, 16, 3), np.uint8)
    return ColorSegmenter(tables_of([path])).segment(noise)


def people(path: Path) -> object:
    """Faces by name."""
    from hri.vision.tracking.face_recognition import Acquaintances

    return Acquaintances.load(path)


def relations(path: Path) -> object:
    """What an app remembers of people, and how it is said."""
    from hri.conversation import load_relations

    found = load_relations([path]).values()
    texts = [text for one in found for text in (one.tell, *one.ask, *one.ask_for, *one.follow_up)]
    return [text.format(name="Anna", value="jazz") for text in texts]


def poses(path: Path) -> object:
    """The turns of a head."""
    from hri.vision.pose_file import Remarks, read_poses

    remarks = Remarks(path)
    return sum(1 for _ in read_poses(path, remarks)), list(remarks)


def run_of_robot(path: Path) -> object:
    """A recorded run."""
    return named("hri.cli.drive.recorded:read_run")(str(path), "go_to")


@cache
def _replies_of_companion() -> tuple[Any, Any]:
    """The companion's module of replies, and the names that they may use."""
    from hri.emotion.stimulus import load_stimuli
    from hri.face.model import load_face
    from hri.face.motion.gesture_tracks import load_gestures
    from hri.robot.app import load_app
    from hri.speech.grammar import load_grammar

    app = load_app("companion")
    app.load_tasks()
    module = importlib.import_module("hri_app_companion.replies")
    grammar, face = load_grammar("companion"), load_face("robot")
    return module, module.Vocabulary(
        grammar, load_stimuli(), face.expressions, load_gestures(face), app
    )


def replies(path: Path) -> object:
    """The companion's replies, as those of an app that extends it."""
    module, vocabulary = _replies_of_companion()
    for name in ("smalltalk", "people.toml"):
        beside = path.parent / name
        if not beside.exists():
            beside.symlink_to(vocabulary.app.folder / name)
    app = replace(vocabulary.app, folder=path.parent, base=vocabulary.app)
    found = module.load_replies([path], replace(vocabulary, app=app))
    return [text.format_map(_Anything()) for reply in found.replies.values() for text in reply.say]


class _Anything(dict[str, str]):
    """What fills in the braces of a reply."""

    def __missing__(self, name: str) -> str:
        return name


@cache
def _emotions_of_robot() -> Any:
    return named("hri.emotion.files:EmotionFiles")("neutral")


def saved_emotions(path: Path) -> None:
    """A file that is saved while a robot runs: it feels by the new one, or goes on by the old."""
    files = _emotions_of_robot()
    before = files.model
    try:
        files.reload()
    except HriError:
        if files.model is not before:
            raise AssertionError("half of a file was taken") from None
        raise


@cache
def _grammars_of_robot(path: Path) -> tuple[Any, Any]:
    """A stack with a grammar in force, and its clock."""
    from hri.core.clock import FakeClock
    from hri.speech.grammar import load_grammar
    from hri.speech.grammar_stack import GrammarStack

    def take(layer: Any) -> None:
        layer.grammar = load_grammar(layer.path)

    clock = FakeClock()
    stack = GrammarStack(clock.worker(0.0), take)
    stack.push(path)
    while stack.in_force is None:
        stack.update()
        clock.advance(0.1)
    return stack, clock


def saved_grammar(path: Path) -> None:
    """A grammar that is saved while a robot listens: it hears by the new one, or on by the old."""
    stack, clock = _grammars_of_robot(path)
    before = stack.in_force.grammar
    stack.reload()
    while (layer := stack.update()) is None:
        clock.advance(0.1)
    if layer.error is not None:
        if stack.in_force.grammar is not before:
            raise AssertionError("half of a grammar was taken")
        raise layer.error


def scene(path: Path) -> object:
    """A scene of a face, spoken by a silent voice."""
    from hri.face.model import load_face
    from hri.face.scene import load_scene

    return load_scene(path, load_face("eyes"), good.silent_voice())


def objects(path: Path) -> object:
    """A set of objects, and what is done with it."""
    import numpy as np

    from hri.vision.objects.model_file import load_models
    from hri.vision.objects.recognizer import ObjectRecognizer

    noise = np.random.default_rng(1).integers(0, 256, (48, 64, 3), np.uint8)
    return ObjectRecognizer(load_models(path)).recognize(noise)


@cache
def _entries_of_objects() -> dict[str, bytes]:
    return good.entries_of(good.object_sets()[0])


def object_entry(name: str) -> Read:
    """A set of which one entry is the input."""

    def read(path: Path) -> object:
        path.write_bytes(good.packed(_entries_of_objects() | {name: path.read_bytes()}))
        return objects(path)

    return read


def speech(path: Path) -> object:
    """A text with markup, said by a silent voice."""
    from hri.core.signals import Prosody
    from hri.speech.ssml import Ssml, spoken

    document = Ssml.parse(_read_text(path))
    voice = good.silent_voice().__self__  # type: ignore[attr-defined]  # a bound method
    return spoken(document, voice, Prosody(), lambda speech: None, lambda: True)


def order(path: Path) -> object:
    """What the page asks of the robot, as the server checks it."""
    from hri.core.reading import parse_json
    from hri.studio.commands import checked

    def read(text: str) -> object:
        asked = parse_json(text)
        if not isinstance(asked, dict) or not isinstance(asked.get("arguments"), dict):
            raise ValueError("no order")
        return checked(str(asked.get("name")), asked["arguments"])

    return _refusing(read, _read_text(path))


def condition(path: Path) -> object:
    """A condition of a breakpoint, and whether it holds for values."""
    from hri.behavior.breakpoint import parse_condition

    found = parse_condition(_read_text(path))
    return [found.holds(value, 1.0) for value in (0.5, "text", True, None, [1, 2], float("nan"))]


def entry(path: Path) -> None:
    """What someone shows to enter the studio: nothing that was changed lets them in."""
    from hri.studio.access import (
        Codes,
        Cookies,
        is_loopback,
        is_own_host,
        is_own_origin,
        is_signed_code,
    )

    raw = path.read_bytes()
    text = raw.decode("latin-1")  # as in the head of a request
    code, cookie, host, origin = [*text.split("\n"), "", "", "", ""][:4]
    if is_signed_code(good.SECRET, code) or Codes(good.SECRET).redeem(code):
        raise AssertionError(f"{code!r} is taken for a code")
    if Cookies(good.SECRET).is_good(cookie, 1e9) and cookie not in good.cookies():
        raise AssertionError(f"{cookie!r} is taken for a cookie")
    is_own_host(host, False), is_own_host(host, True), is_own_origin(origin, host)
    is_loopback(host)


def token(path: Path) -> object:
    """The file of the token."""
    from hri.core.token import is_token, load_token

    path.chmod(0o600)
    shown = load_token()
    return shown is not None and is_token(shown)


def draft(path: Path) -> object:
    """A draft of a network beside its file, as the page opens it."""
    from hri.studio.composer.files import Library

    network = path.with_name("n.xml")
    network.write_text("<BehaviorNetwork/>")
    library = Library(lambda: 0.0, start=path.parent)
    library.listed()
    return library.open(str(network))


def laid_out(path: Path) -> object:
    """A network, which is the same when its canonical text is read again."""
    from hri.behavior.network_file import load_network
    from hri.behavior.network_writer import write_network

    text = write_network(load_network(path))
    path.write_text(text)
    if write_network(load_network(path)) != text:
        raise AssertionError("the canonical text is not read as it was written")
    return text


def recording(path: Path) -> object:
    """A recording in the studio: its line in the list, and all of its events."""
    from hri.studio.recordings import events_of, folder_of, summary

    folder = folder_of(str(path.parent))
    return summary(folder), events_of(folder)


def stimuli(path: Path) -> object:
    """The stimuli of the folder that the input lies in."""
    from hri.emotion.stimulus import load_stimuli

    return load_stimuli()


def timeline(path: Path) -> object:
    """What happens to a robot that feels."""
    return named("hri.cli.emotion.stimulus_timeline:read_timeline")(
        path, ("praise", "scold", "greeting")
    )


def values(path: Path) -> None:
    """What a ValueRecorder wrote."""
    from hri.behavior.library.value_recording import ValuePlayer

    player = ValuePlayer("player")
    player.file = str(path)
    player.check()


def wire_line(path: Path) -> list[object]:
    """A line of a peer; what it may not say is a ProtocolError."""
    from hri.net.malleable_protocol import Sender, decode

    return [decode(path.read_bytes(), Sender())]


def _refusing(parse: Callable[[str], object], text: str) -> object:
    """Parsers of parts of a file refuse with a sentence in a ValueError."""
    try:
        return parse(text)
    except ValueError as error:
        raise HriError(str(error)) from error
