"""What all simulated devices have in common: the world they are in.

    <DeviceBus id="world" type="Hri.SimulatedWorld">
      <Device id="simulated_camera" type="Hri.SimulatedCamera"/>
    </DeviceBus>

A device whose bus is not a simulated world uses the first one of the configuration. Without one,
they all share the world "home", created for them.
"""

from __future__ import annotations

from hri.core import registry
from hri.hal.resource import Description, Resource, Resources
from hri.simulation.world import SimulatedWorld

TYPE = "Hri.SimulatedWorld"
OWN_IDS = ("world", "simulated_world")
"""Id of the world that is made where none is configured; the second if the first is taken."""


class InWorld(Resource):
    """A device of the simulated world."""

    is_simulated = True
    world: SimulatedWorld

    def _open(self) -> None:
        super()._open()
        self.world = self.use(world_id(self.manager, self.description.bus), SimulatedWorld)


def world_id(manager: Resources, bus: str = "") -> str:
    """Id of the simulated world for devices on that bus; declared if necessary."""
    kinds = {d.id: registry.canonical(d.type) for d in list(manager.descriptions.values())}
    worlds = [id for id, kind in kinds.items() if kind == TYPE]
    if worlds:
        return bus if bus in worlds else worlds[0]
    id = OWN_IDS[OWN_IDS[0] in kinds]
    manager.declare(Description(id, TYPE))
    return id
