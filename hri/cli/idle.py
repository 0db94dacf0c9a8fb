"""`hri idle`: lists what the robot does while nothing happens, checks the file, and tries it."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from hri.cli.face_film import FaceFilm
from hri.cli.terminal.messages import Within
from hri.conversation.idle_acts import COMPANY, IdleAct, Idler, Stillness, load_idle_acts
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report
from hri.core.signals import Expression
from hri.emotion.display import LABELS
from hri.face.model import load_face
from hri.face.motion.gesture_tracks import load_gestures
from hri.face.scene import LONGEST, Cue, Scene

STEP_S = 0.25
FPS = 12


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = (
        "The list has the name, the weight, the quiet seconds before it comes, and what it is.\n"
        "The head of emotions/idle.toml explains its keys.\n\n"
        "  hri idle --try 10 --feeling joy --company seen\n"
        "  hri idle --file mine.toml --try 10 --film evening.mp4"
    )
    add = parser.add_argument
    add("--file", type=Path, metavar="FILE", help="check this file too, and use its acts")
    add("--face", default="robot", metavar="NAME", help="whose gestures (%(default)s)")
    add("--try", dest="minutes", type=Within(float, 0.1, 1440), metavar="MIN",
        help="print what it does in MIN quiet minutes")  # fmt: skip
    add("--feeling", default="calm", metavar="LABEL", help="with this feeling (%(default)s)")
    add("--company", choices=COMPANY, default="alone", help="with company (%(default)s)")
    add(
        "--hour",
        type=Within(int, 0, 23),
        default=15,
        metavar="H",
        help="at this hour (%(default)s)",
    )
    add(
        "--energy", type=Within(float, 0, 1), default=1.0, metavar="E", help="charge of the battery"
    )
    add("--seed", type=int, default=0, metavar="N", help="another seed, other acts")
    add("--film", type=Path, metavar="FILE", help="also film the face: .mp4, .webp or .gif")
    add("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 for a file with a mistake, and for an unknown feeling."""
    if options.feeling not in LABELS:
        raise HriError(f'no feeling "{options.feeling}" - {did_you_mean(options.feeling, LABELS)}')
    if options.film is not None and options.minutes is None:
        raise HriError("--film has nothing to film - add --try 10")
    model = load_face(options.face)
    files = [options.file] if options.file else []
    table = load_idle_acts(files, load_gestures(model))
    if options.minutes is None:
        _list(list(table.acts.values()), options.json)
        return 0
    done = list(_tried(Idler(table, options.seed), options))
    _show(done, options.json)
    if options.film is not None:
        _film(done, options)
    return 0


def _tried(idler: Idler, options: argparse.Namespace) -> Iterator[tuple[float, IdleAct]]:
    """Times in seconds, and acts."""
    for step in range(round(60 * options.minutes / STEP_S)):
        now = step * STEP_S
        still = Stillness(
            now, options.feeling, options.energy, options.hour, options.company == "seen"
        )
        act = idler.choose(now, still)
        if act is not None:
            yield now, act
            if act.naps:
                return


def _list(acts: list[IdleAct], as_json: bool) -> None:
    if as_json:
        print(json.dumps([_described(act) for act in acts], indent=1))
        return
    width = max(len(act.name) for act in acts)
    for act in acts:
        when = f"on {act.on}" if act.on else f"{act.weight:4g}  after {act.after_s:g} s"
        report(f"{act.name:<{width}}  {when:<18}  {act.about}")


def _described(act: IdleAct) -> dict[str, object]:
    return asdict(act) | {"feelings": sorted(act.feelings)}


def _show(done: list[tuple[float, IdleAct]], as_json: bool) -> None:
    if as_json:
        print(json.dumps([{"t": now, "act": act.name} for now, act in done], indent=1))
        return
    for now, act in done:
        report(f"{now // 60:3.0f}:{now % 60:04.1f}  {act.about}")


def _film(done: list[tuple[float, IdleAct]], options: argparse.Namespace) -> None:
    scene = Scene(tuple(_cue(*one) for one in done), min(60 * options.minutes, LONGEST))
    model = load_face(options.face)
    FaceFilm(rate=FPS, seed=options.seed).shoot(scene, model, options.film)


def _cue(now: float, act: IdleAct) -> Cue:
    lasts = None if act.naps else act.seconds
    return Cue(
        now,
        expression=Expression(act.show, duration=lasts) if act.show else None,
        gesture=(act.gesture, 1.0, 0.0) if act.gesture else None,
    )
