import gc

import pytest

from hri.core.collection import without_collection


@pytest.fixture
def collection():
    """Whether collection is on, and back to it at the end."""
    was_on = gc.isenabled()
    gc.enable()
    yield gc.isenabled
    (gc.enable if was_on else gc.disable)()


def test_collection_comes_back_after_the_last_of_all_that_build(collection):
    with without_collection():
        assert not collection()
        with without_collection():
            assert not collection()
        assert not collection()
    assert collection()


def test_collection_comes_back_after_an_error(collection):
    with pytest.raises(ValueError, match="wrong"), without_collection():
        raise ValueError("wrong")
    assert collection()


def test_collection_that_was_off_stays_off(collection):
    gc.disable()
    with without_collection():
        pass
    assert not collection()
