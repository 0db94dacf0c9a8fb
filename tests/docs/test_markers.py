"""The page about markers: what it shows works, and its tables are whole."""

import re
from dataclasses import fields
from pathlib import Path

import pytest

from hri.behavior.behavior import Context
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.cli.marker import COMMANDS
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.signals import Marker
from hri.hal.resource_manager import ResourceManager
from hri.testing import live
from hri.vision.markers.families import NAMES
from hri.vision.markers.marker_behaviors import MarkerFinder

PAGE = (Path(__file__).parents[2] / "docs/markers.md").read_text()


def block(language):
    (found,) = re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)
    return found


def rows(head):
    """The names in the first column of a table."""
    lines = PAGE.split(f"| {head} |")[1].split("\n\n")[0].splitlines()[2:]
    return {name for line in lines for name in re.findall(r"`([^`]+)`", line.split("|")[1])}


def test_the_network_of_the_page_runs(tmp_path):
    path = tmp_path / "markers.xml"
    path.write_text(block("xml"))
    network = load_network(path)
    network.check()
    with ResourceManager.load("simulated", FakeClock()) as resources:
        context = Context(resources.clock, EventBus(resources.clock), resources)
        runner = Runner(network, context)
        live(context, [runner], 2.0)
        assert runner.statistics.failures == 0
    assert network["markers"].is_seen.value is False


def test_the_tables_name_each_parameter_and_output_and_family():
    behavior = MarkerFinder("markers")
    assert rows("parameter") == set(behavior.parameters)
    assert rows("output") == set(behavior.outputs)
    assert all(f"`{name}`" in PAGE for name in NAMES)


@pytest.mark.parametrize("name", [field.name for field in fields(Marker)])
def test_the_page_names_each_field_of_a_marker(name):
    assert f"`{name}`" in PAGE


def test_the_program_of_the_page_runs():
    exec(block("python"), {})


def test_the_page_names_each_command():
    assert {row.split()[2] for row in rows("command")} == set(COMMANDS)
