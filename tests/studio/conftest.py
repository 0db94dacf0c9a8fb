"""What the tests of the studio's page share."""

import pytest

from tests.studio.browser import chromium


@pytest.fixture(scope="module")
def one_browser():
    """The tests of a module take turns in one browser, each in a fresh profile."""
    with chromium():
        yield
