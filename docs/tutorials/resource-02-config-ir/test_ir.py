"""Prints what the sensor in `resource-config.xml` beside this file measures, side by side."""

import sys
from pathlib import Path

from hri.cli import behave

CONFIGURATION = Path(__file__).with_name("resource-config.xml")


def main(*options: str) -> int:
    """The command behave, with the devices of this folder."""
    return behave.main(["networks/config-ir", "--config", str(CONFIGURATION), *options])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
