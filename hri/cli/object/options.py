"""The option that names a model set, and the objects in it."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.core.errors import HriError, did_you_mean
from hri.vision.objects.model_file import find_models, load_models, own_models
from hri.vision.objects.object_model import ModelSet, ObjectModel


def add_set(parser: argparse.ArgumentParser) -> None:
    about = "the model set; its path, or its name (your own objects)"
    parser.add_argument("--set", dest="models", metavar="SET.mdl", help=about)


def set_path(options: argparse.Namespace) -> Path:
    """The set that was named, else the user's own. Raises HriError for a name nobody knows."""
    return own_models() if options.models is None else find_models(options.models)


def loaded(options: argparse.Namespace) -> ModelSet:
    """The set. Raises HriError when it is missing or damaged."""
    path = set_path(options)
    if options.models is None and not path.exists():
        raise HriError(f"{path}: you have no objects yet - hri object learn NAME --camera")
    return load_models(path)


def object_of(models: ModelSet, name: str) -> ObjectModel:
    """An object of a set. Raises HriError when it is not there."""
    model = models.find(name)
    if model is None:
        remedy = did_you_mean(name, [one.name for one in models.objects])
        raise HriError(f'no object "{name}" in this set - {remedy}')
    return model
