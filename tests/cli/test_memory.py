import argparse

import pytest

from hri.cli.run import add_arguments, memory_of
from hri.emotion.persistence import memory_file


def memory(*words: str) -> str:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    return memory_of(parser.parse_args(["companion", *words]))


def test_what_is_felt_outlasts_a_run_with_people():
    assert memory() == memory("--headless", "--duration", "5") == str(memory_file())


@pytest.mark.parametrize("words", [["--fast"], ["--demo"], ["--seed", "0"], ["--demo", "--fast"]])
def test_runs_that_are_to_repeat_neither_load_nor_keep_it(words):
    assert memory(*words) == ""
