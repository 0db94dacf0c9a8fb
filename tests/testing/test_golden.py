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


DICE = np.random.default_rng(2)
KINDS = {
    "one bit": DICE.random((64, 128)) < 0.5,
    "zeros and ones": (DICE.random((64, 128)) < 0.5).astype(np.uint8),
    "gray": DICE.integers(0, 256, (48, 64), np.uint8),
    "one channel": DICE.integers(0, 256, (48, 64, 1), np.uint8),
    "rgb": DICE.integers(0, 256, (48, 64, 3), np.uint8),
    "rgba": DICE.integers(0, 256, (48, 64, 4), np.uint8),
    "a single pixel": np.zeros((1, 1), bool),
}


@pytest.mark.parametrize("kind", KINDS)
def test_what_was_approved_passes_and_what_changed_does_not(tmp_path, kind) -> None:
    seen = KINDS[kind]
    Golden(tmp_path, tmp_path, is_updating=True).check(kind, seen)
    golden = Golden(tmp_path, tmp_path / "scratch")
    golden.check(kind, seen)
    changed = seen.copy()
    if kind in ("one bit", "zeros and ones", "a single pixel"):
        changed[0, 0] = not changed[0, 0]  # a single pixel counts
    else:
        changed[8:24, 8:24] = 255 - changed[8:24, 8:24]
    with pytest.raises(AssertionError, match="--update-goldens"):
        golden.check(kind, changed)
    with pytest.raises(AssertionError, match="its shape is"):
        golden.check(kind, np.vstack([seen, seen]))


def test_a_change_of_opacity_alone_is_seen(tmp_path) -> None:
    white = np.full((40, 40, 4), 255, np.uint8)
    Golden(tmp_path, tmp_path, is_updating=True).check("a", white)
    Golden(tmp_path, tmp_path).check("a", white[..., :3])
    clear = white.copy()
    clear[..., 3] = 0
    with pytest.raises(AssertionError, match="changed"):
        Golden(tmp_path, tmp_path / "b").check("a", clear)


@pytest.mark.parametrize(
    "seen", [np.zeros((4, 4)), np.zeros((4, 4, 2), np.uint8), np.zeros((0, 4), bool)]
)
def test_what_is_no_picture_is_refused(tmp_path, seen) -> None:
    with pytest.raises(AssertionError, match=r"an array of .* - give uint8 or bool"):
        Golden(tmp_path, tmp_path, is_updating=True).check("a", seen)


def test_two_names_of_one_file_are_an_error(tmp_path) -> None:
    golden = Golden(tmp_path, tmp_path, is_updating=True)
    golden.check("a b", GRAY)
    golden.check("a b", GRAY)
    with pytest.raises(AssertionError, match=r'"a b" and "a-b" are one file, .* - rename one'):
        golden.check("a-b", GRAY)


def test_a_name_may_be_in_a_folder_and_nowhere_else(tmp_path) -> None:
    Golden(tmp_path / "in", tmp_path, is_updating=True).check("eyes/left", GRAY)
    Golden(tmp_path / "in", tmp_path, is_updating=True).check("mouth/left", with_spot(60))
    assert (tmp_path / "in" / "eyes" / "left.png").is_file()
    golden = Golden(tmp_path / "in", tmp_path / "scratch")
    golden.check("eyes/left", GRAY)
    for name in ("eyes/left", "mouth/left"):
        with pytest.raises(AssertionError, match="--update-goldens"):
            golden.check(name, with_spot(120))
    assert len(list(golden.scratch.rglob("*.png"))) == 2
    for name in ("", "../out", "/tmp/out", "a/../../b", "..", "a\0b", " "):
        with pytest.raises(AssertionError, match="cannot be the name of a picture - take letters"):
            golden.check(name, GRAY)


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


OTHER = """
import pytest

def pytest_addoption(parser):
    parser.addoption("--update-goldens", action="store_true", help="of the other")

@pytest.fixture
def golden():
    return "the other"
"""
TESTS = """
import numpy as np

def test_theirs(golden):
    assert golden == "the other"

def test_ours(hri_golden):
    hri_golden.check("black", np.zeros((8, 8, 3), np.uint8))
"""


def by_option(pytester: pytest.Pytester) -> list[str]:
    """Loaded before ours."""
    pytester.makepyfile(other=OTHER)
    return ["-p", "other"]


def as_installed(pytester: pytest.Pytester, name: str) -> list[str]:
    """Installed beside ours; which of them comes first goes by the name."""
    pytester.makepyfile(**{f"{name}_other": OTHER})
    about = pytester.path / f"{name}_other-1.dist-info"
    about.mkdir()
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}-other\nVersion: 1\n")
    (about / "entry_points.txt").write_text(f"[pytest11]\n{name} = {name}_other\n")
    return []


def by_conftest(pytester: pytest.Pytester) -> list[str]:
    """Named by the project."""
    pytester.makepyfile(other=OTHER)
    pytester.makeconftest('pytest_plugins = ["other"]')
    return []


@pytest.mark.parametrize("way", ["option", "aaa", "zzz", "conftest"])
def test_it_gives_way_to_another_plugin_with_the_same_names(
    pytester: pytest.Pytester, way: str
) -> None:
    pytester.syspathinsert()
    ways = {"option": by_option, "conftest": by_conftest}
    more = ways[way](pytester) if way in ways else as_installed(pytester, way)
    pytester.makepyfile(test_both=TESTS)
    words = ["-q", "-p", "no:cacheprovider", *more]
    first = pytester.runpytest_inprocess(*words)
    first.assert_outcomes(passed=1, failed=1)
    first.stdout.fnmatch_lines(["*no picture *golden/both/black.png*--update-goldens*"])
    pytester.runpytest_inprocess(*words, "--update-goldens").assert_outcomes(passed=2)
    pytester.runpytest_inprocess(*words).assert_outcomes(passed=2)


def test_a_conftest_has_an_option_and_a_fixture_of_its_own_that_builds_on_ours(
    pytester: pytest.Pytester,
) -> None:
    pytester.makeconftest(
        """
        import pytest

        def pytest_addoption(parser):
            parser.addoption("--update-goldens", action="store_true")

        @pytest.fixture
        def golden(golden):
            golden.check("black", __import__("numpy").zeros((8, 8, 3), "uint8"))
            return "mine"
        """
    )
    pytester.makepyfile(test_mine="def test_mine(golden):\n    assert golden == 'mine'")
    pytester.runpytest_inprocess("-q", "--update-goldens").assert_outcomes(passed=1)
    pytester.runpytest_inprocess("-q").assert_outcomes(passed=1)
