"""All mistakes that keep a face from loading, so that an author can fix them in one go."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from hri.core.errors import AuthoringErrors, HriError
from hri.face.drawing.baking import bake
from hri.face.drawing.svg import Drawing, load_drawing
from hri.face.model import load_face
from hri.face.settings import mistakes_in
from hri.face.vocabulary import CORRECTIVE, sides_of


def mistakes(folder: Path) -> list[HriError]:
    """What is wrong in face.toml and in each drawing; empty when the face can be loaded."""
    folder = folder.resolve()  # as load_face does: no mistake has two places
    found = _Found()
    found.look(partial(load_face, folder))
    if not found.errors:
        return []
    targets = sorted((folder / "targets").glob("*.svg"))
    stems = [file.stem for file in targets if CORRECTIVE not in file.stem]
    known = {*stems, *(side for stem in stems for side in sides_of(stem))}
    found.errors += mistakes_in(folder / "face.toml", known)
    neutral = found.look(partial(load_drawing, folder / "neutral.svg"))
    for file in targets:
        target = found.look(partial(load_drawing, file))
        if neutral is not None and target is not None:
            found.look(partial(bake, neutral, {"target": target}))
    return list({str(error): error for error in found.errors}.values())


class _Found:
    def __init__(self) -> None:
        self.errors: list[HriError] = []

    def look(self, read: Callable[[], object]) -> Drawing | None:
        """Read something; a drawing is given back."""
        try:
            read_one = read()
        except AuthoringErrors as several:
            self.errors += several.errors
        except HriError as error:
            self.errors.append(error)
        else:
            return read_one if isinstance(read_one, Drawing) else None
        return None
