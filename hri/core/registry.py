"""Classes by their public name, found through entry points and imported on first use.

A plug-in is a package that declares, say, ``[project.entry-points."hri.behaviors"]`` with
``"My.Wave" = "my_package.wave:Wave"``. Names are `Namespace.Name`; every `Evolution.Name` of 2003
is an alias of `Hri.Name`, or of what `ALIASES` says.
"""

from __future__ import annotations

from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from hri.core.errors import HriError, NotAvailable, did_you_mean

GROUPS = {"hri.resources": "device type", "hri.behaviors": "behavior type", "hri.tasks": "task"}

ALIASES = {
    # 2003 device types that have another name today.
    "Evolution.ASR": "Hri.Bus",
    "Evolution.Audio": "Hri.Bus",
    "Evolution.DirectXCamera": "Hri.Webcam",
    "Evolution.DirectXMP3FileAudioPlay": "Hri.AudioFilePlayer",
    "Evolution.EloquenceTTS": "Hri.EspeakVoice",
    "Evolution.FGD": "Hri.Bus",
    "Evolution.JoystickWin32DirectInput": "Hri.Joystick",
    "Evolution.LinuxCamera": "Hri.Webcam",
    "Evolution.MorphedFace": "Hri.Screen",
    "Evolution.RCMBattery": "Hri.SimulatedBattery",
    "Evolution.RCMBus": "Hri.Bus",
    "Evolution.RCMMotor": "Hri.SimulatedMotor",
    "Evolution.TTS": "Hri.Bus",
    "Evolution.USB": "Hri.Bus",
    "Evolution.USBGripper": "Hri.SimulatedGripper",
    "Evolution.USBIrSensor": "Hri.SimulatedRangeSensor",
    "Evolution.ViaVoiceRecognizer": "Hri.Recognizer",
    "Evolution.WinTTS": "Hri.EspeakVoice",
    "Evolution.WinVoiceAudioLevel": "Hri.AudioLevel",
    "Evolution.WinVoiceRecognizer": "Hri.Recognizer",
    "Evolution.WmmeAudioPlayback": "Hri.Speaker",
    "Evolution.WmmeAudioRecord": "Hri.Microphone",
    "Evolution.WmmeFileAudioPlay": "Hri.AudioFilePlayer",
    "Evolution.WmmeFileAudioRecord": "Hri.AudioFileRecorder",
    # Two names for one thing.
    "Examples.PrintBehavior": "Hri.PrintBehavior",
    "Examples.SkeletonBehavior": "Hri.SkeletonBehavior",
    "Examples.StopCrash": "Hri.StopCrash",
    "Hri.Listener": "Hri.Recognizer",
    "Hri.SpeechLevel": "Hri.MicrophoneLevel",
}


@cache
def _entries(group: str) -> dict[str, EntryPoint]:
    return {entry.name: entry for entry in entry_points(group=group)}


def known(group: str) -> list[str]:
    """All names of a group, sorted."""
    return sorted(_entries(group))


def name_of(group: str, cls: type) -> str:
    """The name that a class is declared under, or an empty text."""
    entries = _entries(group).items()
    alike = [(name, entry) for name, entry in entries if entry.attr == cls.__qualname__]
    return next((name for name, entry in alike if entry.load() is cls), "")


def canonical(name: str) -> str:
    """Today's name: aliases resolved, `Evolution.` read as `Hri.`."""
    name = ALIASES.get(name, name)
    if name.startswith("Evolution."):
        name = "Hri." + name.removeprefix("Evolution.")
    return ALIASES.get(name, name)


def meant(group: str, name: str, otherwise: str = "") -> str:
    """The remedy for an unknown name: the nearest one, spelled as in 2003 where that one was."""
    names = known(group)
    if name.startswith("Evolution."):
        names = [f"Evolution.{one.removeprefix('Hri.')}" for one in names if one[:4] == "Hri."]
        names += [one for one in ALIASES if canonical(one) in known(group)]
    return did_you_mean(name, names, otherwise)


def find(group: str, name: str) -> Any:
    """The class of that name.

    Raises HriError when nobody declares it, NotAvailable when its package is not installed.
    """
    entry = _entries(group).get(canonical(name))
    if entry is None:
        raise HriError(f'unknown {GROUPS[group]} "{name}" - {meant(group, name)}')
    try:
        return entry.load()
    except (ImportError, AttributeError) as error:
        raise NotAvailable(f"{name} cannot be loaded: {error} - install what it needs") from error
