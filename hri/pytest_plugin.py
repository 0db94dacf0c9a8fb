"""What pytest gets from this package: the fixture `golden` and the option --update-goldens.

It comes with the installation. Nothing else is imported before a test asks for the fixture.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from hri.testing.golden import Golden


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add --update-goldens."""
    group = parser.getgroup("hri")
    group.addoption(
        "--update-goldens", action="store_true", help="approve the pictures as they are drawn now"
    )


@pytest.fixture
def golden(request: pytest.FixtureRequest, tmp_path: Path) -> Golden:
    """The approved pictures in `golden/NAME_OF_THE_TEST_FILE/` beside the test."""
    from hri.testing.golden import Golden

    folder = request.path.parent / "golden" / request.path.stem.removeprefix("test_")
    return Golden(folder, tmp_path, request.config.getoption("--update-goldens"))
