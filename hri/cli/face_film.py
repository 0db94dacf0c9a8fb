"""A scene of a face as a movie, with sound where possible. OpenCV writes only pictures; if `ffmpeg`
is installed, an MP4 gets the sound too.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import closing, nullcontext
from dataclasses import dataclass
from pathlib import Path

from hri.cli.terminal.progress_line import progress
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.signals import Image, Samples
from hri.core.writing import replacing
from hri.face import FaceModel
from hri.face.live_link import WeightWriter
from hri.face.scene import Scene
from hri.hal.drivers.wav_file import write_wav

PATIENCE = 300.0
"""Seconds after which ffmpeg is killed."""


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
        from hri.face.renderers.movie import check_movie, write_movie

        check_movie(path, self.rate)
        count = round(scene.duration * self.rate)
        write_movie(path, progress(self._pictures(scene, model), count, path.name), self.rate)
        sound = scene.sound()
        if sound is not None and not add_sound(path, *sound):
            beside = "add --wav FILE" if wav is None else f"play {wav} beside it"
            report(
                f"{path} is silent - {beside}; an .mp4 holds its sound where ffmpeg is installed"
            )

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


def add_sound(path: Path, samples: Samples, rate: int) -> bool:
    """Put a sound into an MP4, if ffmpeg is installed; True if it is in it now. Raises HriError
    when ffmpeg fails; the movie stays as it was.
    """
    program = shutil.which("ffmpeg")
    if program is None or path.suffix.lower() != ".mp4":
        return False
    with tempfile.TemporaryDirectory() as folder, replacing(path, suffix=".mp4") as whole:
        wav = Path(folder, "sound.wav")
        write_wav(wav, samples, rate)
        inputs = ["-i", str(path.resolve()), "-i", str(wav)]
        kinds = ["-c:v", "copy", "-c:a", "aac", "-movflags", "+faststart"]
        words = [program, "-nostdin", "-y", "-loglevel", "error", *inputs, *kinds, str(whole)]
        try:
            done = subprocess.run(words, capture_output=True, timeout=PATIENCE, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise HriError(f"{program} cannot add the sound: {error} - fix ffmpeg") from error
        if done.returncode:
            reason = done.stderr.decode("utf-8", "replace").strip().splitlines()[-1:]
            raise HriError(f"{program} cannot add the sound: {' '.join(reason)} - fix ffmpeg")
    return True
