"""What a visit leaves behind: `events.jsonl`, `face.mp4`, `robot.wav` and `timeline.png`.

`feelings.svg` is there from the first second on and shows the last ten minutes.
"""

from __future__ import annotations

import contextlib
import logging
from collections import deque
from functools import partial
from pathlib import Path

from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.events import EventBus
from hri.core.recording import EventLog, read_events
from hri.emotion.behaviors import EmotionModel
from hri.hal.drivers.wav_file import WavSpeaker
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker
from hri.hal.tee import TeeScreen, TeeSpeaker
from hri.robot.feeling_plot import SPAN_S, Moment, write_feeling_plot
from hri.task.context import TaskContext

FEELING_EVERY_S = 1.0
"""Seconds between two points of the plot of feelings."""
PLOT_EVERY_S = 10.0
"""Seconds between two pictures of it."""
PLOT_LATENCY = 0.05
"""Seconds that a picture takes on the fake clock."""

log = logging.getLogger("hri.recording")


class Recording:
    """Records a robot while it lives; made before its networks start."""

    def __init__(self, folder: Path, events: EventBus, resources: ResourceManager) -> None:
        """Raises HriError when the folder cannot be written."""
        self.folder = folder
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise HriError(f"{folder}: {error.strerror} - choose another folder") from error
        self._log = EventLog(folder / "events.jsonl", events)
        self._record_screen(resources)
        self._record_speaker(resources)

    def _record_screen(self, resources: ResourceManager) -> None:
        from hri.hal.drivers.video_file import VideoFileScreen

        screen = resources.obtain("screen", Screen)
        size = {"width": str(screen.width), "height": str(screen.height)}
        path = str(self.folder / "face.mp4")
        description = Description("face.mp4", "Hri.VideoFileScreen", {"file": path, **size})
        video = VideoFileScreen(description, resources)
        video.activate()
        tee = TeeScreen(screen, video)
        tee.activate()
        resources.substitute("screen", tee)

    def _record_speaker(self, resources: ResourceManager) -> None:
        speaker = resources.obtain("speaker", Speaker)
        parameters = {"file": str(self.folder / "robot.wav")}
        sound = WavSpeaker(Description("robot.wav", "Hri.WavSpeaker", parameters), resources)
        sound.activate()
        tee = TeeSpeaker(speaker, sound)
        tee.activate()
        resources.substitute("speaker", tee)

    async def watch(self, context: TaskContext) -> None:
        """Keep `feelings.svg` up to date; nothing to do for a robot without feelings."""
        emotion = context.find_behavior(EmotionModel)
        if emotion is None:
            return
        clock, path = context.clock, self.folder / "feelings.svg"
        moments: deque[Moment] = deque(maxlen=int(SPAN_S / FEELING_EVERY_S) + 1)
        worker: Worker[None] = clock.worker(PLOT_LATENCY)
        drawn = -PLOT_EVERY_S
        try:
            while True:
                now = clock.now()
                moments.append((now, emotion.feeling()))
                worker.poll()
                if now - drawn >= PLOT_EVERY_S and not worker.is_busy:
                    worker.submit(partial(write_feeling_plot, tuple(moments), path))
                    drawn = now
                await clock.sleep(FEELING_EVERY_S)
        except HriError as error:
            log.error("the plot of feelings ends here: %s", error)
        finally:
            worker.close()
            with contextlib.suppress(HriError):  # a full disk was told about when it filled up
                write_feeling_plot(moments, path)

    def stop(self) -> None:
        """End the log; sound and video end when the resources are closed."""
        self._log.close()

    def plot(self) -> None:
        """Draw `timeline.png` from the log."""
        from hri.robot.timeline import plot_timeline

        plot_timeline(read_events(self.folder / "events.jsonl"), self.folder / "timeline.png")
