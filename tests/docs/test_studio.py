"""What the page about the studio says is so."""

import argparse
import re

from hri.cli import studio
from hri.core import paths
from hri.studio.commands import COMMANDS
from tests.studio.living import known, live_with_studio, told

TEXT = (paths.house() / "docs" / "studio.md").read_text()


def test_its_options_and_commands_are_there():
    parser = argparse.ArgumentParser()
    studio.add_arguments(parser)
    for option in re.findall(r"`(--[a-z-]+)(?: P)?`", TEXT):
        assert option in parser.format_help()
    shown = set(re.findall(r"/api/v1/([a-z_]+)\s", TEXT))
    assert shown & COMMANDS.keys() == {"stop", "hear"}


def test_the_topics_it_names_are_those_of_a_robot():
    named = re.search(r"newest value of each topic: (.*?)\.", TEXT, re.DOTALL)

    def script(session, robot):
        with known(session.address()) as client:
            told(client, "world", lambda world: True)
            return client.get("/api/v1/state").json()

    assert set(re.findall(r"`(\w+)`", named[1])) == live_with_studio(script).keys()
