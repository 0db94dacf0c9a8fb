import gc
import logging
import os
import signal
from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, settings

from tests.checklist import Checklist

# The same examples in every run, and no limit of time for one: a busy machine is not a mistake.
PATIENT = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow]}
settings.register_profile("steady", derandomize=True, max_examples=50, **PATIENT)
settings.register_profile("random", print_blob=True, **PATIENT)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--checklist", action="store_true", help="write docs/checklist.md")


def pytest_configure(config: pytest.Config) -> None:
    # A shell leaves Ctrl-C ignored in what it runs in the background, and `nohup` the end of the
    # terminal; some tests press the one and play the other.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    config.pluginmanager.register(Checklist(config.getoption("--checklist")), "checklist")


def pytest_collection_finish() -> None:
    # Thousands of tests and all modules stay to the end: searching them for garbage took a tenth
    # of the whole time.
    gc.collect()
    gc.freeze()
    # A life makes many small things that end by themselves; looking after each 700 of them is slow.
    gc.set_threshold(20_000, 20, 20)


@pytest.fixture(autouse=True)
def quiet_loggers() -> Iterator[None]:
    """What a command does to the loggers of its process ends with the test that ran it."""
    loggers = [logging.getLogger(name) for name in ("hri", "hri.behavior", "hri.net")]
    before = [(logger.level, logger.handlers[:]) for logger in loggers]
    yield
    for logger, (level, handlers) in zip(loggers, before, strict=True):
        logger.setLevel(level)
        logger.handlers = handlers


@pytest.fixture(autouse=True, scope="session")
def own_state(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """What a robot of a test remembers is not taken for the user's own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield
