"""Every writer of a file or folder that is replaced as a whole, ready to be run and interrupted.

A writer writes one of two editions of the same file: after an interruption all of the one or all of
the other must be there. What commands write themselves goes through the same functions.
"""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable, Mapping
from datetime import datetime
from pathlib import Path

import numpy as np

from hri.behavior.network_file import load_network
from hri.behavior.network_writer import save_network
from hri.conversation.memory import Memory as People
from hri.conversation.memory_file import Contents, change
from hri.conversation.relations import Relation
from hri.core.fetch.archive import unpack
from hri.core.signals import EmotionState, Image
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import Memory, keep
from hri.face.renderers.movie import write_movie
from hri.hal.choices import save_choices
from hri.hal.drivers.image_size import write_picture
from hri.hal.drivers.wav_file import write_wav
from hri.robot.feeling_plot import write_feeling_plot
from hri.robot.timeline import plot_timeline
from hri.speech.pronunciation.lexicon import add_to_lexicon
from hri.vision.tracking.face_recognition import Acquaintances

Writer = Callable[[Path, int], object]
"""Writes an edition, 0 or 1, to a place."""
NETWORK = '<BehaviorNetwork name="net"><Behavior id="a" type="Hri.Constant"/></BehaviorNetwork>'
RATE = 16000
MORNING = datetime(2026, 5, 4, 9, 30)


def content(path: Path) -> dict[str, bytes]:
    """What a file holds, or all files of a folder by their names; empty where nothing is."""
    files = sorted(path.rglob("*")) if path.is_dir() else [path]
    return {str(file.relative_to(path)): file.read_bytes() for file in files if file.is_file()}


def _network(path: Path, edition: int) -> None:
    source = path.with_name("source.xml")
    if not source.exists():
        source.write_text(NETWORK, encoding="utf-8")
    network = load_network(str(source))
    network.behaviors[0].set_parameter("parsed_value", str(edition))
    save_network(network, path)


def _choices(path: Path, edition: int) -> None:
    os.environ["XDG_CONFIG_HOME"] = str(path.parents[1])
    save_choices({"camera": f"camera {edition}"})


def _faces(path: Path, edition: int) -> None:
    known = Acquaintances()
    for name in ("Ann", "Ben")[: edition + 1]:
        known.learn(name, np.arange(128, dtype=np.float32) + len(name))
    known.save(path)


def _feelings(path: Path, edition: int) -> None:
    imprint = load_emotions("neutral").dynamics().rest(0.0).imprint
    keep(path, Memory(imprint, 1.0, 1e9 + edition))


def _people(path: Path, edition: int) -> None:
    memory = People({"likes": Relation("likes", "You like {value}.", several=True)})
    id = memory.introduce("Ann", MORNING).id
    memory.allow(id, MORNING, "word")
    for value in ("jazz", "tea")[: edition + 1]:
        memory.learn(id, "likes", value, MORNING)
    change(path, lambda _: Contents(memory.remembered, memory.last_id))


def _picture(edition: int) -> Image:
    return np.random.default_rng(edition).integers(0, 255, (64, 64, 3), np.uint8)


def _movie(path: Path, edition: int) -> None:
    write_movie(path, [_picture(edition + number) for number in range(6)], 10.0)


def _sound(path: Path, edition: int) -> None:
    write_wav(path, np.arange(RATE, dtype=np.int16) + edition, RATE)


def _feeling_plot(path: Path, edition: int) -> None:
    state = EmotionState("joy", 0.5, 0.1 * edition, 0.0, 0.0)
    write_feeling_plot([(float(time), state) for time in range(60)], path)


def _timeline(path: Path, edition: int) -> None:
    plot_timeline([{"t": 1.0, "event": "speech.heard", "text": f"edition {edition}"}], path)


def _model(path: Path, edition: int) -> None:
    archive = path.with_name(f"{edition}.zip")
    with zipfile.ZipFile(archive, "w") as packed:
        packed.writestr("weights.bin", bytes([edition]) * 50_000)
        packed.writestr("words.txt", f"edition {edition}")
    unpack(archive, path)


WRITERS: Mapping[str, Writer] = {
    "network.xml": _network,
    "lexicon.txt": lambda path, edition: add_to_lexicon(path, "hri", ("EY", "CH")[: edition + 1]),
    "hri/devices.toml": _choices,
    "feelings.json": _feelings,
    "people.db": _people,
    "faces.json": _faces,
    "picture.png": lambda path, edition: write_picture(path, _picture(edition)),
    "picture.jpg": lambda path, edition: write_picture(path, _picture(edition)),
    "sound.wav": _sound,
    "movie.mp4": _movie,
    "movie.webp": _movie,
    "movie.gif": _movie,
    "feelings.svg": _feeling_plot,
    "timeline.png": _timeline,
}
"""By the name of the file."""
FOLDERS: Mapping[str, Writer] = {"model": _model}
"""Writers of folders, which refuse to write over one that is there."""
