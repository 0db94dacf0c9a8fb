"""What pytest gets from this package: the fixture `golden` and the option --update-goldens.

It comes with the installation, so it gives way to whatever else a project has. Where another plugin
brings a fixture `golden`, as pytest-golden does, ours is `hri_golden`, which is always there; an
option --update-goldens of another plugin, or of a conftest.py, holds for both. Nothing else is
imported before a test asks for the fixture.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from hri.testing.golden import Golden

OPTION = "--update-goldens"


@pytest.hookimpl(hookwrapper=True)
def pytest_load_initial_conftests(parser: pytest.Parser) -> Iterator[None]:
    """Add the option when all others have added theirs, unless one of them has it."""
    yield
    with suppress(ValueError):  # it is there
        parser.getgroup("hri").addoption(
            OPTION, action="store_true", help="approve the pictures as they are drawn now"
        )


@pytest.fixture
def hri_golden(request: pytest.FixtureRequest, tmp_path: Path) -> Golden:
    """The approved pictures in `golden/NAME_OF_THE_TEST_FILE/` beside the test."""
    from hri.testing.golden import Golden

    folder = request.path.parent / "golden" / request.path.stem.removeprefix("test_")
    return Golden(folder, tmp_path, bool(request.config.getoption(OPTION, False)))


@pytest.fixture
def golden(request: pytest.FixtureRequest, hri_golden: Golden) -> object:
    """That of another plugin where there is one, else `hri_golden`."""
    try:
        return request.getfixturevalue("golden")
    except pytest.FixtureLookupError:
        return hri_golden
