"""The page about colors: what it shows works, and its tables are whole."""

import argparse
import math
import re
from dataclasses import fields
from pathlib import Path

import pytest

from hri.behavior.behavior import Context
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.cli.color import COMMANDS, learn
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.geometry import seen_from
from hri.core.signals import ColorBlob
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld
from hri.testing import live
from hri.vision.color.color_behaviors import ColorSegmentation

PAGE = (Path(__file__).parents[2] / "docs/colors.md").read_text()


def block(language):
    (found,) = re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)
    return found


def rows(head):
    """The names in the first column of a table."""
    lines = PAGE.split(f"| {head} |")[1].split("\n\n")[0].splitlines()[2:]
    return {name for line in lines for name in re.findall(r"`([^`]+)`", line.split("|")[1])}


@pytest.mark.proves("R10")
def test_the_network_of_the_page_finds_the_skin_of_whoever_is_there(tmp_path):
    path = tmp_path / "colors.xml"
    path.write_text(block("xml"))
    network = load_network(path)
    network.check()
    with ResourceManager.load("simulated", FakeClock()) as resources:
        context = Context(resources.clock, EventBus(resources.clock), resources)
        runner = Runner(network, context)
        live(context, [runner], 4.0)
        assert runner.statistics.failures == 0
        world = resources.obtain("world", SimulatedWorld)
        x, y = seen_from(world.base.pose, *world.person.place(resources.clock.now()))
    found = network["colors"].blobs.value.found
    assert {blob.name for blob in found} == {"skin"}
    assert min(abs(blob.bearing - math.atan2(y, x)) for blob in found) < 0.05


def test_the_tables_name_each_parameter_and_output():
    behavior = ColorSegmentation("colors", colors="red_ball")
    assert rows("parameter") == set(behavior.parameters)
    assert rows("output") == set(behavior.outputs)


def test_the_page_names_each_command_and_each_field_of_a_blob():
    assert {row.split()[2] for row in rows("command")} == set(COMMANDS)
    parser = argparse.ArgumentParser()
    learn.add_arguments(parser)
    for row in rows("option of `learn`"):
        assert row.split()[0] in parser.format_help()
    for field in fields(ColorBlob):
        assert f"`{field.name}`" in PAGE


def test_the_program_of_the_page_runs():
    exec(block("python"), {})


def test_the_networks_that_it_names_are_there():
    assert paths.find("config/networks", "follow_color.xml")
    for link in re.findall(r"\]\(([^)]+)\)", PAGE):
        assert (Path(__file__).parents[2] / "docs" / link).exists(), link
