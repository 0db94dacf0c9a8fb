"""The place of a failure, and the name of a task aloud."""

import json
from functools import partial

import pytest

from hri.core.errors import AuthoringError, HriError, Place
from hri.robot.failures import spoken
from hri.task.failure import place_of, with_place
from hri.task.task import TaskType


def caught(function):
    try:
        function()
    except Exception as error:
        return error
    raise AssertionError


def fail():
    raise HriError("too dark - make light")


def line_of(function, offset=1):
    return f"{__file__}:{function.__code__.co_firstlineno + offset}"


def test_it_is_the_innermost_line_of_what_someone_wrote():
    assert place_of(caught(fail)) == line_of(fail)
    assert with_place(caught(fail)) == f"{line_of(fail)}: too dark - make light"


def test_it_is_not_in_what_is_installed():
    def read():
        json.loads("{")

    assert place_of(caught(read)) == line_of(read)


def test_of_a_group_it_is_that_of_the_first():
    def group():
        raise ExceptionGroup("both", [caught(fail), ValueError("other")])

    assert place_of(caught(group)) == line_of(fail)


def test_what_was_never_raised_has_none():
    assert place_of(ValueError("x")) == ""
    assert with_place(ValueError("x")) == "x"
    assert with_place(ValueError()) == "ValueError"


def test_what_is_called_wrongly_has_the_place_of_the_task():
    task = TaskType("fail", partial(fail))
    assert place_of(ValueError("x"), task) == line_of(fail, 0)
    assert place_of(ValueError("x"), print) == ""


def test_a_place_that_the_words_have_is_not_said_twice():
    file, line = line_of(fail).rsplit(":", 1)

    def refuse():
        raise AuthoringError(Place(file, int(line)), "wrong", "mend it")

    error = caught(refuse)
    assert with_place(error).startswith(f"{line_of(refuse)}: {file}:{line}:1: wrong")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("count", "count"),
        ("wave_hand", "wave hand"),
        ("Hri.LearnObject", "learn object"),
        ("take_saved_replies", "take saved replies"),
    ],
)
def test_names_are_words(name, words):
    assert spoken(name) == words
