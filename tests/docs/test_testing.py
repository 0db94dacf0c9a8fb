"""The page about tests: its tests pass when they are copied."""

import re

import pytest

import hri.testing  # noqa: F401 - what numpy is in cannot be imported twice in one process
from hri.core import paths

pytest_plugins = ["pytester"]

PAGE = (paths.house() / "docs" / "testing.md").read_text()
BLOCKS = re.findall(r"^```python\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)


@pytest.mark.slow
def test_the_tests_of_the_page_pass(pytester: pytest.Pytester) -> None:
    pytester.makepyfile(test_page="\n\n".join(BLOCKS))
    count = sum(block.count("def test_") for block in BLOCKS)
    pytester.runpytest_inprocess("-q", "--update-goldens").assert_outcomes(passed=count)
    again = pytester.runpytest_inprocess("-q", "-k", "golden or approved or smiles or oh_looks")
    again.assert_outcomes(passed=2, deselected=count - 2)
