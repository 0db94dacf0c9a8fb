"""The user's choice of devices, made with `hri doctor --choose` and kept between runs.

[microphone]
device = "USB Audio"
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from hri.core import paths
from hri.core.ownership import require_of_user
from hri.core.privacy import folder_for
from hri.core.registry import canonical
from hri.core.toml import load_toml
from hri.core.writing import PRIVATE, write_text
from hri.hal.resource import Description

CHOOSABLE = ("microphone", "speaker", "camera")


def choices_file() -> Path:
    """Where the choice is kept."""
    return paths.settings_folder() / "devices.toml"


def load_choices() -> dict[str, str]:
    """Device by id; empty when nothing was chosen.

    Raises AuthoringError for a mistake in the file, HriError for one that others may have written.
    """
    path = choices_file()
    if not path.is_file():
        return {}
    require_of_user(path, "choice of devices")
    table = load_toml(path, "choice of devices")
    chosen = {}
    for id in CHOOSABLE:
        entry = table.table(id, optional=True)
        if device := entry.string("device", ""):
            chosen[id] = device
        entry.finish()
    table.finish()
    return chosen


def save_choices(chosen: dict[str, str]) -> Path:
    """Write the choice; the file that was written. Raises HriError."""
    path = choices_file()
    # A JSON string is a TOML string as well, whatever the device is called.
    lines = [f"[{id}]\ndevice = {json.dumps(device)}\n" for id, device in chosen.items()]
    folder_for(path)
    write_text(path, "# Written by `hri doctor --choose`.\n" + "\n".join(lines), PRIVATE)
    return path


def apply_choices(
    devices: tuple[Description, ...], chosen: dict[str, str]
) -> tuple[Description, ...]:
    """The devices with the chosen `device` parameter where one was chosen and can be."""
    return tuple(
        replace(device, parameters={**device.parameters, "device": chosen[device.id]})
        if device.id in chosen and _is_choosable(device)
        else device
        for device in devices
    )


def _is_choosable(device: Description) -> bool:
    """Whether its driver knows several devices; stand-ins and files do not."""
    return canonical(device.type) in ("Hri.Microphone", "Hri.Speaker", "Hri.Webcam")
