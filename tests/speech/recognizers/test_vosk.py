"""What Vosk brings is imported only where Vosk decodes, and it never fetches a model by itself."""

import subprocess

import pytest

from hri.core import child

BROUGHT = ("vosk", "requests", "urllib3", "certifi", "websockets", "tqdm", "srt")

COMMANDS = """
import sys
from hri.cli.main import main

assert main(["companion", "--config", "simulated", "--headless", "--fast", "--duration", "3"]) == 0
assert main(["say", "Hello.", "--wav", "said.wav"]) == 0
assert main(["grammar", "listen", "companion", "--wav", "said.wav"]) in (0, 1)
assert main(["models"]) == 0
"""

START = """
import sys
from pathlib import Path
from hri.core.clock import FakeClock
from hri.core.errors import NotAvailable
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar.loader import load_grammar
from hri.speech.recognizers.vosk import PARTS, VoskRecognizer

for part in PARTS:
    Path(part).parent.mkdir(parents=True)
    Path(part).touch()
description = Description("ears", "Hri.Vosk", {"model": "."})
ears = VoskRecognizer(description, ResourceManager((), FakeClock()))
ears.activate()
assert "vosk" not in sys.modules
import requests
requests.Session.request = lambda *given, **named: sys.exit(f"asked for {given[1:]}")
try:
    ears.start(load_grammar("companion"))
except NotAvailable as error:
    assert "unpack the model again" in str(error)
assert "vosk" in sys.modules
"""


def ran(program, folder):
    command = child.command("-c", program)
    subprocess.run(command, cwd=folder, env=child.environment(), check=True, timeout=120)


@pytest.mark.slow
def test_everyday_commands_do_not_import_what_only_vosk_needs(tmp_path):
    check = f"assert not {{*{BROUGHT}}} & sys.modules.keys(), sys.modules.keys()"
    ran(COMMANDS + check, tmp_path)


def test_vosk_is_imported_when_it_starts_and_takes_only_the_model_that_it_was_given(tmp_path):
    pytest.importorskip("vosk", reason="it has no wheels for this system")
    ran(START, tmp_path)
