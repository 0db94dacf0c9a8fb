"""Reads `resource-config.xml`: dimensions, buses with devices, groups with members.

Defaults of a device type come from its spec, `resource/<Namespace>/<Name>.xml`, found over the
search folders; what the device says itself wins. A spec also says which driver it is: the name of
one that is installed, or, with a `library` that ends in `.py`, a class of that file beside it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from hri.core import paths
from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.core.registry import canonical
from hri.core.xml import Element, load_xml
from hri.hal.resource import POSE, Description
from hri.hal.shape import Shape

SIZES = ("lx", "ly", "lz")
"""Parameters of a shape beside its pose: its size in centimeters."""
MOST_DEVICES = 2000
"""Devices, groups and shapes of one configuration."""
LARGEST_CM = 1000.0


@dataclass(frozen=True)
class Configuration:
    """What a configuration file describes."""

    path: Path
    shapes: tuple[Shape, ...]
    devices: tuple[Description, ...]
    """Buses, devices and groups, in the order of the file."""
    trusted: tuple[str, ...] = ()
    """Ports of the bridge that anyone may write to (`hri.behavior.doors`)."""


def load_configuration(path: Path) -> Configuration:
    """Read a configuration. Raises AuthoringError with the place of the first mistake."""
    root = load_xml(path, "resource configuration")
    if root.tag != "Resources":
        raise root.error(f"the root is <{root.tag}>", "write <Resources> around it all")
    root.check(("Dimensions", "Devices", "Groups"), ("trusted",))
    if sum(len(section.children) for section in root) > MOST_DEVICES:
        raise root.error(f"more than {MOST_DEVICES} devices", "split the configuration")
    shapes: list[Shape] = []
    devices: list[Description] = []
    for section in root:
        if section.tag == "Dimensions":
            section.check(("Shape",))
            shapes.extend(_shape(_description(shape)) for shape in section)
        elif section.tag == "Devices":
            section.check(("DeviceBus", "Device"))
            for element in section:
                devices.extend(_bus_or_device(element))
        else:
            section.check(("Group",))
            devices.extend(_description(group) for group in section)
    _refuse_twins(devices)
    _refuse_strangers(devices)
    trusted = tuple(root.get("trusted", "").split())
    return Configuration(path, tuple(shapes), tuple(devices), trusted)


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


def _shape(description: Description) -> Shape:
    for name in description.parameters:
        if name not in (*SIZES, *POSE):
            what = f'a shape has no parameter "{name}"'
            raise description.error(name, what, did_you_mean(name, (*SIZES, *POSE)))
    if description.type != "rectangular":
        what = f'a shape of type "{description.type}" is unknown'
        raise description.error("type", what, 'write type="rectangular"')
    lx, ly, lz = (description.number_within(name, 0.0, 0.0, LARGEST_CM) / 100 for name in SIZES)
    pose = description.pose
    return Shape(lx, ly, lz, pose.x, pose.y, pose.z, pose.roll, pose.pitch, pose.yaw)


def _with_spec(description: Description) -> Description:
    """Fill in what the device type's spec says, where one is found."""
    path = _spec_path(description.type)
    if path is None:
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
    library = spec.get("library", "")
    return replace(
        description,
        parameters={**defaults, **description.parameters},
        places={**places, **description.places},
        driver=spec.get("driver", ""),
        # The shared libraries of 2003 are of no use here; their drivers are installed by name.
        library=path.parent / library if library.endswith(".py") else None,
    )


def _spec_path(type: str) -> Path | None:
    """The spec file under the type's own name or today's, in the first folder that has one."""
    for name in (type, canonical(type)):
        for candidate in _spec_candidates(name):
            if paths.is_file(candidate):
                return candidate
    return None


def _spec_candidates(type: str) -> list[Path]:
    namespace, _, name = type.partition(".")
    if not (namespace.isidentifier() and name.isidentifier()):
        return []  # no name that could lead out of the folders
    below = Path("resource", namespace, f"{name}.xml")
    return [folder / part / below for folder in paths.search_folders() for part in ("config", ".")]


def spec_folders(type: str) -> str:
    """Where the spec of a device type is looked for, for people."""
    folders = dict.fromkeys(str(path.parent) for path in _spec_candidates(type))
    return ", ".join(folders) or "any folder: a type reads Namespace.Name"


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
