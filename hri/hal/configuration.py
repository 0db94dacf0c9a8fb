"""Reads `resource-config.xml`: dimensions, buses with devices, groups with members.

Defaults of a device type come from its spec, `resource/<Namespace>/<Name>.xml`, found over the
search folders; what the device says itself wins.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place
from hri.core.registry import canonical
from hri.core.xml import Element, load_xml
from hri.hal.resource import Description


@dataclass(frozen=True)
class Configuration:
    """What a configuration file describes."""

    path: Path
    shapes: tuple[Description, ...]
    devices: tuple[Description, ...]
    """Buses, devices and groups, in the order of the file."""


def load_configuration(path: Path) -> Configuration:
    """Read a configuration. Raises AuthoringError with the place of the first mistake."""
    root = load_xml(path, "resource configuration")
    if root.tag != "Resources":
        raise root.error(f"the root is <{root.tag}>", "write <Resources> around it all")
    root.check(("Dimensions", "Devices", "Groups"))
    shapes: list[Description] = []
    devices: list[Description] = []
    for section in root:
        if section.tag == "Dimensions":
            section.check(("Shape",))
            shapes.extend(_description(shape) for shape in section)
        elif section.tag == "Devices":
            section.check(("DeviceBus", "Device"))
            for element in section:
                devices.extend(_bus_or_device(element))
        else:
            section.check(("Group",))
            devices.extend(_description(group) for group in section)
    _refuse_twins(devices)
    _refuse_strangers(devices)
    return Configuration(path, tuple(shapes), tuple(devices))


def _bus_or_device(element: Element) -> list[Description]:
    if element.tag == "Device":
        return [_with_spec(_description(element))]
    bus = _with_spec(_description(element))
    below = [child for child in element if child.tag == "Device"]
    return [bus, *(_with_spec(replace(_description(child), bus=bus.id)) for child in below)]


def _description(element: Element) -> Description:
    children = {
        "Shape": ("Parameter",),
        "Device": ("Parameter",),
        "DeviceBus": ("Parameter", "Device"),
        "Group": ("Parameter", "Member"),
    }
    element.check(children[element.tag], ("id", "type"))
    parameters, places = {}, {"type": element.places.get("type", element.place)}
    members = []
    for child in element:
        if child.tag == "Parameter":
            child.check((), ("name", "value"))
            parameters[child.get("name")] = child.get("value")
            places[child.get("name")] = child.place
        elif child.tag == "Member":
            child.check((), ("member_id",))
            members.append(child.get("member_id"))
            places[f"member {members[-1]}"] = child.place
    return Description(
        id=element.get("id"),
        type=element.get("type"),
        parameters=parameters,
        members=tuple(members),
        place=element.place,
        places=places,
    )


def _with_spec(description: Description) -> Description:
    """Fill in the defaults of the device type's spec, where one is found."""
    namespace, _, name = canonical(description.type).partition(".")
    try:
        path = paths.find("config", f"resource/{namespace}/{name}.xml")
    except HriError:
        return description
    spec = load_xml(path, "resource spec")
    if spec.tag != "ResourceSpec":
        raise spec.error(f"the root is <{spec.tag}>", "write <ResourceSpec>")
    spec.check(("Parameter",), ("id", "library", "driver"))
    defaults, places = {}, {}
    for child in spec:
        child.check((), ("name", "value"))
        defaults[child.get("name")] = child.get("value")
        places[child.get("name")] = child.place
    return replace(
        description,
        parameters={**defaults, **description.parameters},
        places={**places, **description.places},
    )


def _refuse_twins(devices: list[Description]) -> None:
    seen: dict[str, Place] = {}
    for device in devices:
        if device.id in seen:
            what = f'the id "{device.id}" is used twice'
            remedy = f"rename it, or the one in line {seen[device.id].line}"
            raise AuthoringError(device.place, what, remedy)
        seen[device.id] = device.place


def _refuse_strangers(devices: list[Description]) -> None:
    ids = {device.id for device in devices}
    for device in devices:
        for member in device.members:
            if member not in ids:
                remedy = "name a device of this file"
                raise device.error(f"member {member}", f'no device "{member}"', remedy)
