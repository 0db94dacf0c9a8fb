"""`hri object check`: what will be hard to recognize."""

from __future__ import annotations

import argparse

from hri.cli.object.options import add_set, loaded
from hri.cli.terminal.progress_line import progress
from hri.core.quoting import report
from hri.vision.objects.object_model import ModelSet, ObjectModel
from hri.vision.objects.plain_objects import is_colorful
from hri.vision.objects.recognizer import ObjectRecognizer


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when there is something to do."""
    models = loaded(options)
    recognizer = ObjectRecognizer(models)
    problems = []
    for model in progress(models.objects, len(models.objects), "checking"):
        features = max(len(view.features) for view in model.views)
        if not any(is_colorful(view) or not view.is_plain for view in model.views):
            problems.append(f"{model.name}: too plain, {features} features - show it nearer")
        for other in sorted(_lookalikes(model, models, recognizer)):
            problems.append(
                f'{model.name}: looks like "{other}" - show what differs, or remove one'
            )
    for line in problems or [f"{len(models.objects)} objects, all told apart"]:
        report(line)
    return 1 if problems else 0


def _lookalikes(model: ObjectModel, models: ModelSet, recognizer: ObjectRecognizer) -> set[str]:
    """The others that it is taken for."""
    names = _names(model, recognizer)
    if model.name not in names:  # two that are the same are both not recognized
        names |= _names(model, ObjectRecognizer(models.without(model.name)))
    return names - {model.name}


def _names(model: ObjectModel, recognizer: ObjectRecognizer) -> set[str]:
    return {found.name for view in model.views for found in recognizer.recognize(view.picture)}
