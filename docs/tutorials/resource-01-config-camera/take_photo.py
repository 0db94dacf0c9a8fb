"""Writes five pictures of the camera that `resource-config.xml` beside this file describes."""

import sys
from pathlib import Path

from hri.cli.diagnostics import camera

CONFIGURATION = Path(__file__).with_name("resource-config.xml")


def main(*options: str) -> int:
    """The command test_camera, with the devices of this folder."""
    return camera.main(["--config", str(CONFIGURATION), *options])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
