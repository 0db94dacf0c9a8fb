"""What is shown of work that takes its time."""

import io
import threading
from contextlib import redirect_stderr, redirect_stdout

import pytest

from hri.cli.main import main
from hri.cli.terminal import progress_line as module
from hri.cli.terminal.progress_line import progress, waiting


class Terminal(io.StringIO):
    """Notes when something is shown."""

    def __init__(self):
        super().__init__()
        self.shown = threading.Event()

    def isatty(self):
        return True

    def write(self, text):
        written = super().write(text)
        self.shown.set()
        return written


def test_items_are_counted_and_the_bar_is_wiped():
    with redirect_stderr(Terminal()) as terminal:
        assert list(progress(range(3), 3, "hearing")) == [0, 1, 2]
    assert terminal.getvalue().startswith("\rhearing [")
    assert "] 2 of 3" in terminal.getvalue()
    assert terminal.getvalue().endswith("\r\x1b[K")


def test_work_without_an_end_in_sight_tells_how_long_it_takes(monkeypatch):
    monkeypatch.setattr(module, "EVERY", 0.001)
    monkeypatch.setattr(module, "SILENCE", 0.0)
    with redirect_stderr(Terminal()) as terminal, waiting("reading"):
        assert terminal.shown.wait(10.0)
    assert terminal.getvalue().startswith("\rreading, 0 s")
    assert terminal.getvalue().endswith("\r\x1b[K")


def test_nothing_is_shown_where_nobody_looks(capsys):
    with waiting("reading"):
        assert list(progress(range(3), 3, "hearing")) == [0, 1, 2]
    assert capsys.readouterr() == ("", "")


def test_an_error_of_the_work_comes_out():
    with redirect_stderr(Terminal()), pytest.raises(ValueError, match="ours"), waiting("reading"):
        raise ValueError("ours")


def test_what_is_printed_wipes_the_line_first(monkeypatch):
    monkeypatch.setattr(module, "EVERY", 0.001)
    monkeypatch.setattr(module, "SILENCE", 0.0)
    with redirect_stderr(Terminal()) as terminal, redirect_stdout(terminal), waiting("reading"):
        assert terminal.shown.wait(10.0)
        monkeypatch.setattr(module, "SILENCE", 60.0)
        print("a nod")
    before, _, after = terminal.getvalue().partition("a nod\n")
    assert before.endswith("\r\x1b[K")
    assert after == ""


@pytest.mark.parametrize(
    ("words", "what"),
    [
        ("emotion check", "load all emotion files"),
        ("face check robot", "load a face"),
        ("network check networks/wander", "reading the network"),
        ("drive replay 3 --out {}/run.png", "reading and drawing the run"),
    ],
)
def test_commands_that_read_or_work_for_long_say_so(words, what, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(module, "EVERY", 0.001)
    monkeypatch.setattr(module, "SILENCE", 0.0)
    with redirect_stderr(Terminal()) as terminal:
        assert main(words.format(tmp_path).split()) == 0
    assert f"\r{what}" in terminal.getvalue()
    assert terminal.getvalue().endswith("\r\x1b[K")
    assert what not in capsys.readouterr().out
