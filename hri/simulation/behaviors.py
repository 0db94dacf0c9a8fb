"""Object recognition as the simulated world serves it: no picture is looked at.

A model set names the objects that can be recognized, one a line in `config/models/<name>`; which
of them are in view, and how far away, the world knows. Of pictures of other cameras it says that it
cannot recognize anything in them.
"""

from __future__ import annotations

import logging

from hri.behavior.behavior import Context
from hri.behavior.device import DeviceBehavior
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.reading import read_text
from hri.core.signals import Frame
from hri.simulation.simulated_devices import DrawnFrame
from hri.simulation.world import SimulatedWorld

log = logging.getLogger(__name__)

UNABLE = "cannot recognize objects in pictures of a real camera yet"
MODELS = "config/models"


class ObjRecRecognizer(DeviceBehavior):
    """Recognizes one object in each picture of the simulated camera: several take turns.

    It cannot recognize anything in pictures of other cameras yet. It says so once, in the log and
    with the event `vision.failed` (`reason`), and sends nothing.
    """

    category = "vision"
    modelset = Param("default.mdl", "file with the names of the objects that it knows")
    field_of_view = Param(0.6, "radians, that of the camera", minimum=0.1, maximum=3.0)
    only = Param("", "name of the one object to look for; empty takes all that it knows in turn")
    image = Input[Frame]("image", "what the camera sees")
    model_name = Output[str]("string", "name of the object; nothing when none is in view")
    distance = Output[float]("double", "centimeters from the camera to the object")
    bearing = Output[float]("double", "radians from where the camera looks to the left")

    def check(self) -> None:
        lines = read_text(paths.find(MODELS, self.modelset), "model set").splitlines()
        names = (line.partition("#")[0].strip() for line in lines)
        self._known = {name for name in names if name}
        if self.only:
            if self.only not in self._known:
                remedy = did_you_mean(self.only, self._known)
                raise HriError(f'{self.id}: {self.modelset} has no "{self.only}" - {remedy}')
            self._known = {self.only}

    def start(self, context: Context) -> None:
        super().start(context)
        worlds = context.resources.ids(SimulatedWorld)
        if not worlds:
            what = f"{self.id} {UNABLE}"
            raise HriError(f"{what} - add a bus of type Hri.SimulatedWorld to the configuration")
        self._events, self._has_told = context.events, False
        self._world = self.obtain(worlds[0], SimulatedWorld)
        self._turn = 0

    def compute(self, now: float, dt: float) -> None:
        if self.image.value is None:
            return
        if not isinstance(self.image.value, DrawnFrame):
            self._tell_unable()
            return
        sightings = self._world.seen_items(self.field_of_view, now)
        recognized = [sighting for sighting in sightings if sighting.name in self._known]
        if recognized:
            chosen = recognized[self._turn % len(recognized)]
            self._turn += 1
            self.model_name.send(chosen.name)
            self.distance.send(chosen.distance * 100)
            self.bearing.send(chosen.bearing)

    def _tell_unable(self) -> None:
        if not self._has_told:
            self._has_told = True
            reason = f"{self.id} {UNABLE} - link its image to a Hri.SimulatedCamera"
            log.warning(reason)
            self._events.raise_event("vision.failed", reason=reason)
