"""`hri devices`: what a configuration names, what of it is present, and why something is not."""

from __future__ import annotations

import argparse
import json
import threading
from collections.abc import Iterable
from dataclasses import asdict, dataclass

from hri.cli.diagnostic import without_stand_ins
from hri.core import paths
from hri.core.clock import RealClock
from hri.core.errors import AuthoringError, HriError
from hri.hal.configuration import Configuration, load_configuration
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description, Resource

PATIENCE = 5.0
"""Seconds after which a device that does not open counts as missing."""


@dataclass(frozen=True)
class Found:
    """What is known of a device."""

    id: str
    type: str
    bus: str
    driver: str
    """Class of the driver; empty for a type nobody knows."""
    state: str
    """"present", "missing" or "unknown"."""
    says: str
    """What it is, or why it is not there and what to do."""
    stand_in: str
    """Id of the device that is used in its place, if any."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--config", default="resource-config", metavar="FILE", help="the devices (%(default)s)")
    add("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """Exit status 0, whatever is missing."""
    found = examine(load_configuration(paths.find("config", options.config)))
    if options.json:
        print(json.dumps([asdict(device) for device in found], indent=2))
    else:
        print(_table(found))
    return 0


def examine(configuration: Configuration, patience: float = PATIENCE) -> list[Found]:
    """Try one device after the other, and close them all again; real time passes."""
    devices = without_stand_ins(configuration).devices
    resources = ResourceManager(devices, RealClock(), shapes=configuration.shapes)
    probes = [_Probe(resources, device) for device in configuration.devices]
    found = [probe.found(patience) for probe in probes]
    for probe in reversed(probes):
        probe.close()
    return found


class _Probe:
    """One device, opened in a thread of its own."""

    def __init__(self, resources: ResourceManager, description: Description) -> None:
        self._resources, self._description = resources, description
        self._driver, self._state, self._says = "", "missing", "it does not open - is it in use?"
        self._opened: Resource | None = None

    def found(self, patience: float) -> Found:
        """What becomes of it within some seconds; one that hangs is left alone after them."""
        name = f"hri devices {self._description.id}"
        thread = threading.Thread(target=self._open, name=name, daemon=True)
        thread.start()
        thread.join(patience)
        device = self._description
        stand_in = device.text("stand_in") if self._state != "present" else ""
        return Found(
            device.id, device.type, device.bus, self._driver, self._state, self._says, stand_in
        )

    def close(self) -> None:
        if self._opened is not None:
            self._resources.release(self._opened)

    def _open(self) -> None:
        device = self._description
        try:
            driver = self._resources.driver_of(device)
            self._driver = driver.__name__
            resource = self._resources.obtain(device.id, Resource)
        except AuthoringError as error:
            state = "missing" if self._driver else "unknown"
            self._state, self._says = state, f"{error.what} - {error.remedy}"
        except HriError as error:
            self._says = str(error).removeprefix(f"{device.id}: ")
        except Exception as error:
            self._says = f"its driver failed: {error!r} - mend the driver"
        else:
            self._opened, self._state, self._says = resource, "present", resource.describe()


def _table(found: Iterable[Found]) -> str:
    rows = [("id", "type", "bus", "driver", "state", "")]
    for device in found:
        says = device.says if device.says != device.type else ""
        if device.stand_in:
            says += f" (using {device.stand_in} instead)"
        rows.append(
            (device.id, device.type, device.bus or "-", device.driver or "-", device.state, says)
        )
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    return "\n".join("  ".join(map(str.ljust, row, [*widths, 0])).rstrip() for row in rows)
