"""What the page about assistants says is so."""

import argparse
import json
import re

from hri.cli import mcp
from hri.core import paths
from hri.drive.tasks import CRUISE
from hri.net.mcp.bearer import BEARER
from hri.net.mcp.calls import A_SECOND, MOST_CALLS
from hri.net.mcp.proposals import MOST
from hri.net.mcp.tools import FARTHEST, TOOLS

TEXT = (paths.house() / "docs" / "assistants.md").read_text()
LIMITS = (paths.house() / "docs" / "limits.md").read_text()


def test_its_table_of_tools_is_that_of_the_code():
    rows = re.findall(r"^\| `(\w+)` \| (\w+) \| (.+) \|$", TEXT, re.MULTILINE)
    assert rows == [(name, one.kind.value, one.about) for name, one in TOOLS.items()]


def test_its_options_are_there():
    parser = argparse.ArgumentParser()
    mcp.add_arguments(parser)
    for option in re.findall(r"`(--[a-z-]+)", TEXT):
        assert option in parser.format_help()
    for block in re.findall(r"^```json\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL):
        (server,) = json.loads(block)["mcpServers"].values()
        if "args" in server:
            assert server["args"][0] == "mcp"
            parser.parse_args(server["args"][1:])
        else:
            assert server["url"] == f"http://127.0.0.1:{mcp.PORT}/mcp"


def test_its_numbers_are_those_of_the_code():
    plain = " ".join(TEXT.split())
    assert f"{FARTHEST:g} m at most, at {CRUISE:g} m/s at most" in plain
    assert f"{A_SECOND:g} calls a second, {MOST_CALLS} at once" in plain
    assert f"{MOST} drafts are kept" in plain
    assert f"~/.local/state/hri/{BEARER.name}`" in plain
    assert "## What comes from an assistant" in LIMITS
