"""What a visit leaves behind: `events.jsonl`, `face.mp4`, `robot.wav` and `timeline.png`."""

from __future__ import annotations

from pathlib import Path

from hri.core.errors import HriError
from hri.core.events import EventBus
from hri.core.recording import EventLog, read_events
from hri.hal.drivers.wav_file import WavSpeaker
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker
from hri.hal.tee import TeeScreen, TeeSpeaker


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

    def stop(self) -> None:
        """End the log; sound and video end when the resources are closed."""
        self._log.close()

    def plot(self) -> None:
        """Draw `timeline.png` from the log."""
        from hri.robot.timeline import plot_timeline

        plot_timeline(read_events(self.folder / "events.jsonl"), self.folder / "timeline.png")
