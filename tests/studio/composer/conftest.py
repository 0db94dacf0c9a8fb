"""A robot whose composer is open in a browser."""

import os

import pytest

from tests.studio.browser import opened
from tests.studio.living import living


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    """One robot lives for all tests; new networks go to a folder of the test."""
    start, home = os.getcwd(), tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_DATA_HOME", str(tmp_path_factory.mktemp("data")))
        os.chdir(home)
        try:
            with living() as (made, _):
                made.home = home
                yield made
        finally:
            os.chdir(start)


@pytest.fixture
def page(studio):
    with opened(studio.address()) as made:
        yield made
