"""Everyday commands send nothing, look nothing up, and write only where they should."""

import pytest

from benchmarks.offline import COMMANDS, has_failed, words
from benchmarks.sandbox import require_sandbox, run
from hri.core.errors import NotAvailable

SECONDS = 12
QUICK = ("hri say", "hri grammar parse", "hri object learn", "hri models")
SLOW = (
    *("hri companion --headless", "hri companion --headless --fleet", "hri mcp", "hri doctor"),
    *("hri face render", "hri drive replay"),
)


@pytest.fixture(autouse=True)
def is_permitted():
    try:
        require_sandbox()
    except NotAvailable as reason:
        pytest.skip(f"no sandbox: {reason}")


@pytest.mark.parametrize(
    "begin", [*QUICK, *(pytest.param(one, marks=pytest.mark.slow) for one in SLOW)]
)
def test_an_everyday_command_keeps_to_this_machine_and_to_its_own_folders(tmp_path, begin):
    command = next(command for command in COMMANDS if command.startswith(begin))
    tried = run(words(command), tmp_path, SECONDS)
    assert not has_failed(tried), tried.output
    assert (tried.sent, tried.written, tried.left) == ((), (), ())
