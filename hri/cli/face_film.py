"""A scene of a face as a movie, with its sound where the file can hold it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, nullcontext
from dataclasses import dataclass
from pathlib import Path

from hri.cli.terminal.progress_line import progress
from hri.core.quoting import report
from hri.core.signals import Image
from hri.face import FaceModel
from hri.face.live_link import WeightWriter
from hri.face.scene import Scene


@dataclass(frozen=True, slots=True)
class FaceFilm:
    """Settings of a film."""

    rate: float = 30.0
    """Frames per second."""
    size: tuple[int, int] = (640, 480)
    """Width and height in pixels."""
    seed: int = 0
    """Seed of the idle motion."""
    captions: bool = False
    weights: Path | None = None
    """CSV file for the weights of all frames."""

    def shoot(self, scene: Scene, model: FaceModel, path: Path, wav: Path | None = None) -> None:
        """Write the movie; if it cannot contain sound, print a note, with the name of `wav`. Raises
        HriError.
        """
        from hri.face.renderers.movie import WITH_SOUND, check_movie, write_movie

        check_movie(path, self.rate)
        count = round(scene.duration * self.rate)
        sound = scene.sound()
        pictures = progress(self._pictures(scene, model), count, path.name)
        write_movie(path, pictures, self.rate, sound=sound)
        if sound is not None and path.suffix.lower() not in WITH_SOUND:
            beside = "add --wav FILE" if wav is None else f"play {wav} beside it"
            report(f"{path} is silent - {beside}; an .mp4 holds its sound")

    def _pictures(self, scene: Scene, model: FaceModel) -> Iterator[Image]:
        from hri.face.renderers.captions import add_caption
        from hri.face.renderers.renderer import Renderer

        renderer = Renderer(model, self.size)
        with closing(WeightWriter(self.weights, model)) if self.weights else nullcontext() as file:
            for moment in scene.moments(model, self.rate, self.seed):
                if file is not None:
                    file.write(moment.time, moment.vector)
                picture = renderer.render(moment.vector)
                yield add_caption(picture, moment.caption if self.captions else "")
