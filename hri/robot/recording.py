"""What a visit leaves behind: `events.jsonl`, `face.mp4`, `robot.wav` and `timeline.png`.

`recording.json` says what was run, and how to repeat it (`hri.robot.provenance`). `feelings.svg` is
there from the first second on and shows the last ten minutes. Only the owner can read it, and
people are informed: in the terminal, by a mark on the face, and aloud where a microphone hears
them. Speech to others, which was rejected, is left out.
"""

from __future__ import annotations

import contextlib
import logging
from collections import deque
from collections.abc import Callable, Collection, Mapping
from dataclasses import asdict
from functools import partial
from pathlib import Path

from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.core.event_log import NOTHING, EventLog, read_events
from hri.core.privacy import close_to_others, private_file
from hri.core.quoting import report
from hri.core.recorded import EVENTS, FACE, SOUND, STARTED, STREAMS, claim, parts
from hri.core.signals import Event
from hri.core.stored_data_index import note
from hri.emotion.behaviors import EmotionModel
from hri.hal.drivers.wav_file import WavSpeaker
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker
from hri.hal.tee import TeeScreen, TeeSpeaker
from hri.robot.feeling_plot import SPAN_S, Moment, write_feeling_plot
from hri.robot.provenance import RunRecord, Setup
from hri.speech.behaviors import Voice
from hri.speech.tasks import hears_people, say
from hri.task.context import TaskContext

FEELING_EVERY_S = 1.0
"""Seconds between two points of the plot of feelings."""
PLOT_EVERY_S = 10.0
"""Seconds between two pictures of it."""
PLOT_LATENCY = 0.05
"""Seconds that a picture takes on the fake clock."""

REJECTED: Mapping[str, Collection[str]] = {
    "speech.rejected": ("text", "detail", "sure", "begun", "choices"),
    "speech.partial": ("text",),
}
"""Properties of events that hold words which were rejected, or may be yet."""
ALOUD = "I am recording."
"""The announcement at the beginning when people can be heard; it does not wait for an answer."""

log = logging.getLogger("hri.recording")


class Recording:
    """Records a robot while it lives; made before its networks start."""

    def __init__(
        self,
        asked: Path,
        setup: Setup,
        record: RunRecord,
        events: EventBus,
        resources: ResourceManager,
        notice: Callable[[str], object] = report,
        *,
        with_rejected: bool = False,
    ) -> None:
        """Where `asked` holds a recording, this one goes into another folder beside it.

        `notice` gets the line that announces it; `with_rejected` writes rejected words, too. Raises
        HriError when the folder cannot be written.
        """
        self.folder = folder = claim(asked, record.text)
        self.asked = asked
        self._record = record
        self._notice = notice
        self._make_private()
        note("recording", folder)
        withheld = NOTHING if with_rejected else REJECTED
        self._log = EventLog(folder / EVENTS, events, withheld)
        # The clock may have run for seconds before, and devices take time to open.
        origins = {
            "face": round(self._record_screen(resources), 4),
            "sound": round(self._record_speaker(resources), 4),
        }
        self._log.write(Event(STARTED, resources.clock.now(), {**origins, **asdict(setup)}))

    def _make_private(self) -> None:
        """Close the folder to others, unless it holds anything but a recording, and the files."""
        if {*self.folder.iterdir()} <= {*parts(self.folder)}:
            close_to_others(self.folder)
        for name in STREAMS:
            private_file(self.folder / name)

    @property
    def where(self) -> str:
        """The folder, in words that say why it is not the one that was asked for."""
        if self.folder == self.asked:
            return f"{self.folder}/"
        return f"{self.folder}/ ({self.asked}/ holds an earlier recording)"

    async def announce(self, context: TaskContext) -> None:
        """Say that it records: in the terminal, and aloud where a real microphone hears people."""
        self._notice(f"recording to {self.where}, which only you can read")
        if hears_people(context) and context.find_behavior(Voice) is not None:
            await say(context, ALOUD)

    def _record_screen(self, resources: ResourceManager) -> float:
        """When the film begins, in seconds of the clock."""
        from hri.face.renderers.lamp import RECORDING, add_lamp
        from hri.hal.drivers.video_file import VideoFileScreen

        screen = resources.obtain("screen", Screen)
        size = {"width": str(screen.width), "height": str(screen.height)}
        path = str(self.folder / FACE)
        description = Description(FACE, "Hri.VideoFileScreen", {"file": path, **size})
        video = VideoFileScreen(description, resources)
        video.activate()
        tee = TeeScreen(screen, video, partial(add_lamp, lamp=RECORDING))
        tee.activate()
        resources.substitute("screen", tee)
        return video.origin

    def _record_speaker(self, resources: ResourceManager) -> float:
        """When the sound begins, in seconds of the clock."""
        speaker = resources.obtain("speaker", Speaker)
        parameters = {"file": str(self.folder / SOUND)}
        sound = WavSpeaker(Description(SOUND, "Hri.WavSpeaker", parameters), resources)
        sound.activate()
        tee = TeeSpeaker(speaker, sound)
        tee.activate()
        resources.substitute("speaker", tee)
        return sound.origin

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
            with contextlib.suppress(HriError):  # a full disk was reported when it filled up
                write_feeling_plot(moments, path)

    def stop(self, why: str = "closed") -> None:
        """End the log; sound and video end when the resources are closed. A second call does
        nothing.
        """
        self._log.close()
        self._record.complete(why)

    def plot(self) -> None:
        """Draw `timeline.png` from the log; where that cannot be done, one line says so."""
        from hri.robot.timeline import plot_timeline

        try:
            plot_timeline(read_events(self.folder / EVENTS), self.folder / "timeline.png")
        except HriError as error:
            log.error("no timeline: %s", error)
