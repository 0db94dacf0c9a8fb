"""What the page about the studio says is so."""

import argparse
import re

from hri.cli import studio
from hri.core import paths
from hri.studio.commands import COMMANDS

TEXT = (paths.house() / "docs" / "studio.md").read_text()


def test_its_options_and_commands_are_there():
    parser = argparse.ArgumentParser()
    studio.add_arguments(parser)
    for option in re.findall(r"`(--[a-z-]+)(?: P)?`", TEXT):
        assert option in parser.format_help()
    shown = set(re.findall(r"/api/v1/([a-z_]+)\s", TEXT))
    assert shown & COMMANDS.keys() == {"stop", "hear"}
