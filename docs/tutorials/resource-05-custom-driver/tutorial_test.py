"""Writes a word to the stream that `resource-config.xml` beside this file describes."""

import os
from pathlib import Path

from stream import Stream

from hri.core import Clock, RealClock
from hri.hal import ResourceManager

FOLDER = Path(__file__).parent


def main(clock: Clock) -> None:
    """Open the stream, write, and close it again."""
    os.environ.setdefault("HRI_PATH", str(FOLDER))  # where resource/Examples/FileStream.xml is
    with ResourceManager.load(FOLDER / "resource-config.xml", clock) as resources:
        stream = resources.obtain("output", Stream)
        stream.write(b"Testing")
        resources.release(stream)


if __name__ == "__main__":
    main(RealClock())
