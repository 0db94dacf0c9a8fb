"""Pictures that were approved, as the tests of a user compare them."""

import numpy as np
import pytest

from hri.core.signals import Image
from hri.testing.golden import Golden, difference

pytest_plugins = ["pytester"]

GRAY = np.full((96, 128, 3), 128, np.uint8)


def with_spot(strength: int, side: int = 8) -> Image:
    picture = GRAY.copy()
    picture[40 : 40 + side, 70 : 70 + side] += np.uint8(strength)
    return picture


def test_rounding_is_no_difference() -> None:
    dice = np.random.default_rng(1)
    noisy = (GRAY + dice.integers(-1, 2, GRAY.shape)).astype(np.uint8)
    assert difference(noisy, GRAY) == ""


def test_a_change_is_said_where_it_is() -> None:
    assert "x 64 to 96, y 32 to 64" in difference(with_spot(60), GRAY)
    assert "1 of 12 tiles changed" in difference(with_spot(60), GRAY)


def test_another_size_is_a_difference() -> None:
    assert "(96, 128, 3)" in difference(GRAY[:50], GRAY)


def test_a_few_glaring_pixels_are_a_difference() -> None:
    assert difference(with_spot(100, side=4), GRAY)


def test_what_was_seen_is_left_beside_what_was_approved(tmp_path) -> None:
    Golden(tmp_path, tmp_path, is_updating=True).check("gray", GRAY)
    golden = Golden(tmp_path, tmp_path / "scratch")
    golden.scratch.mkdir()
    golden.check("gray", GRAY)
    with pytest.raises(AssertionError, match="--update-goldens"):
        golden.check("gray", with_spot(60))
    assert (golden.scratch / "gray.png").is_file()
    with pytest.raises(AssertionError, match="no picture"):
        golden.check("other", GRAY)


def test_the_fixture_comes_with_the_installation(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(
        test_mine="""
        import numpy as np

        def test_black(golden):
            golden.check("black", np.zeros((8, 8, 3), np.uint8))
        """
    )
    first = pytester.runpytest_inprocess("-q", "-p", "no:cacheprovider")
    first.assert_outcomes(failed=1)
    first.stdout.fnmatch_lines(["*no picture *golden/mine/black.png*--update-goldens*"])
    pytester.runpytest_inprocess("-q", "--update-goldens").assert_outcomes(passed=1)
    pytester.runpytest_inprocess("-q").assert_outcomes(passed=1)
