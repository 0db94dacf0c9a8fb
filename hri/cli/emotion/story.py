"""`hri emotion story`: plays stories and says where the feelings are not as they expect."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

from hri.cli.emotion.output import mood_words
from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import escaped, report
from hri.emotion.model_spec import EmotionModelSpec, load_emotions
from hri.emotion.story import Expected, Moment, Story, load_story, played

FOLDER = "emotions/stories"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    files_help = "stories, or folders of them; without any, those in emotions/stories"
    add("files", nargs="*", type=Path, metavar="FILE", help=files_help)
    add("--personality", metavar="NAME", help="whose story it is, whatever the file says")
    add("--quiet", action="store_true", help="only print what is not as expected")
    add("--json", action="store_true", help="print one JSON object per line of a story")
    add("--plot", type=Path, metavar="PNG", help="draw mood, emotions and drives (of one story)")
    film_help = "film the face at each event, with its answer (of one story): .mp4, .webp or .gif"
    add("--film", type=Path, metavar="FILE", help=film_help)
    add("--wav", type=Path, metavar="FILE", help="write the sound of the film as well")
    parser.epilog = "The exit status is 1 if anything is not as a story expects."


def run(options: argparse.Namespace) -> int:
    files = list(_files(options.files))
    if options.wav is not None and options.film is None:
        raise HriError("--wav is the sound of a film - add --film FILE")
    for option in ("plot", "film"):
        if getattr(options, option) is not None and len(files) != 1:
            raise HriError(f"--{option} is of one story, not {len(files)} - name one file")
    expected = unmet = 0
    for path in files:
        story = load_story(path, _model)
        model = _model(options.personality or story.personality)
        moments = list(played(story, model))
        expected += sum(isinstance(moment.line.what, Expected) for moment in moments)
        unmet += sum(bool(moment.failure) for moment in moments)
        _print(story, moments, options)
        if options.plot is not None:
            from hri.cli.emotion.plot import plot_affects

            happened = [
                (moment.line.time, moment.line.text)
                for moment in moments
                if not isinstance(moment.line.what, Expected)
            ]
            affects = [moment.affect for moment in moments]
            plot_affects(model.dynamics(), affects, happened, options.plot)
        if options.film is not None:
            _shoot(model, moments, options.film, options.wav)
    if not options.json:
        count = f"{len(files)} stories" if len(files) != 1 else "1 story"
        report(f"{count}: {expected - unmet} of {expected} expectations met")
    return 1 if unmet else 0


def _shoot(
    model: EmotionModelSpec, moments: Sequence[Moment], path: Path, wav: Path | None
) -> None:
    from hri.cli.emotion.story_film import scene_of_story
    from hri.cli.face_film import FaceFilm
    from hri.cli.voice.voice_options import PLAIN_VOICE, open_voice
    from hri.core.clock import RealClock
    from hri.face import load_face
    from hri.hal.drivers.wav_file import write_wav
    from hri.hal.resource_manager import ResourceManager

    with ResourceManager((), RealClock(), notice=report) as resources:
        voice = open_voice(resources, PLAIN_VOICE)
        scene = scene_of_story(model, moments, voice.synthesize)
    sound = scene.sound()
    if wav is not None and sound is not None:
        write_wav(wav, *sound)
    FaceFilm(captions=True).shoot(scene, load_face("robot"), path, wav)


@cache
def _model(personality: str) -> EmotionModelSpec:
    return load_emotions(personality)


def _files(given: Sequence[Path]) -> Iterator[Path]:
    folders = given or [folder / FOLDER for folder in paths.search_folders()]
    found = False
    for path in folders:
        if path.is_dir():
            for file in sorted(path.glob("*.txt")):
                found = True
                yield file
        elif given:
            found = True
            yield path
    if not found:
        raise HriError("no story there - write a file such as emotions/stories/visit.txt")


def _print(story: Story, moments: Sequence[Moment], options: argparse.Namespace) -> None:
    if options.json:
        for moment in moments:
            print(json.dumps(_as_json(story, moment)))
        return
    if not options.quiet:
        report(f"{escaped(story.title)}  ({story.path.name}, {story.personality})")
    for moment in moments:
        if moment.failure:
            report(f"{moment.line.place}: {escaped(f'{moment.line.text}: {moment.failure}')}")
        elif not options.quiet:
            for told in _told(moment):
                report(f"  {escaped(told)}")
    if not options.quiet:
        print()


def _told(moment: Moment) -> Iterator[str]:
    line, state = moment.line, moment.state
    minutes, seconds = divmod(line.time, 60)
    time = f"{minutes:4.0f}:{seconds:02.0f}"
    if isinstance(line.what, Expected):
        yield f"{time}  {line.text}: as expected"
    else:
        yield f"{time}  {line.text}"
        yield f"{'':9}{state.label} {state.intensity:.2f}  {mood_words(state)}"
        yield f"{'':9}{moment.because}"


def _as_json(story: Story, moment: Moment) -> dict[str, object]:
    state = moment.state
    return {
        "story": story.path.name,
        "t": moment.line.time,
        "line": moment.line.text,
        "label": state.label,
        "intensity": state.intensity,
        "pleasure": state.valence,
        "arousal": state.arousal,
        "dominance": state.dominance,
        "says": moment.because,
        "is_expectation": isinstance(moment.line.what, Expected),
        "failure": moment.failure,
    }
