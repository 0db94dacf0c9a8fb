"""`hri devices`: lists the devices of a configuration, whether they are present, and why not. With
`--probe` it looks for bases on the serial ports instead.
"""

from __future__ import annotations

import argparse
import json
import threading
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass

from hri.cli.diagnostics import without_stand_ins
from hri.cli.probe import Answer, ask_ports
from hri.core import paths
from hri.core.clock import RealClock
from hri.core.errors import AuthoringError, HriError
from hri.core.quoting import report
from hri.hal.camera import Camera
from hri.hal.configuration import Configuration, load_configuration
from hri.hal.resource import Description, Resource
from hri.hal.resource_manager import ResourceManager

PATIENCE = 8.0
"""Seconds after which a device that does not open counts as missing."""


@dataclass(frozen=True)
class Found:
    """The state of a device."""

    id: str
    type: str
    bus: str
    driver: str
    """Class of the driver; empty for an unknown type."""
    state: str
    """"present", "missing" or "unknown"."""
    says: str
    """Its description, or why it is missing and the remedy."""
    stand_in: str
    """Id of the device that is used instead, if any."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--config", default="resource-config", metavar="FILE", help="the devices (%(default)s)")
    add("--json", action="store_true", help="print JSON")
    add(
        "--probe",
        nargs="*",
        metavar="PORT",
        help="look for bases at these serial ports, or at all; wheels do not move",
    )


def run(options: argparse.Namespace) -> int:
    """Exit status 0, even if devices are missing."""
    if options.probe is not None:
        return _probe(options.probe, options.json)
    found = examine(load_configuration(paths.find("config", options.config)))
    if options.json:
        print(json.dumps([asdict(device) for device in found], indent=2))
    else:
        for line in _table(found).split("\n"):
            report(line)
    return 0


def _probe(ports: Sequence[str], as_json: bool) -> int:
    answers = ask_ports(ports)
    if as_json:
        print(json.dumps([asdict(answer) for answer in answers], indent=2))
    elif answers:
        rows = [("port", "base", ""), *((a.port, a.type or "-", _heard(a)) for a in answers)]
        for line in _aligned(rows).split("\n"):
            report(line)
    else:
        print("no serial port found - plug the base in")
    return 0


def _heard(answer: Answer) -> str:
    says = f"{answer.says} ({answer.about})" if answer.about else answer.says
    says += ", was asleep" if answer.was_asleep else ""
    return f"{says} - name it {answer.by_id}" if answer.type and answer.by_id else says


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
    """One device, opened in its own thread."""

    def __init__(self, resources: ResourceManager, description: Description) -> None:
        self._resources, self._description = resources, description
        self._driver, self._state, self._says = "", "missing", "it does not open - is it in use?"
        self._opened: Resource | None = None

    def found(self, patience: float) -> Found:
        """Its state after some seconds; a device that still hangs then is abandoned."""
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
            if isinstance(resource, Camera):
                resource.try_out()
        except AuthoringError as error:
            state = "missing" if self._driver else "unknown"
            self._state, self._says = state, f"{error.what} - {error.remedy}"
        except HriError as error:
            self._says = str(error).removeprefix(f"{device.id}: ")
        except Exception as error:
            self._says = f"its driver failed: {error!r} - fix the driver"
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
    return _aligned(rows)


def _aligned(rows: Sequence[tuple[str, ...]]) -> str:
    """A table; the last column is not padded."""
    widths = [max(map(len, column)) for column in list(zip(*rows, strict=True))[:-1]]
    return "\n".join("  ".join(map(str.ljust, row, [*widths, 0])).rstrip() for row in rows)
