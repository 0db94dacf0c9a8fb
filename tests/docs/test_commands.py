"""Each line of shell in the pages can be pasted: its program is there and takes its options."""

import argparse
import importlib
import io
import re
import shlex
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest

from hri.cli import behave
from hri.cli.main import COMMANDS
from hri.core import paths

HOUSE = paths.house()
PAGES = sorted((*HOUSE.glob("*.md"), *(HOUSE / "docs").rglob("*.md"), *HOUSE.glob("apps/*/*.md")))
FENCED = re.compile(r"^```(?:sh|console|bash)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
KEYWORDS = {"while", "for", "do", "done", "if", "then", "else", "fi"}
OTHERS = {
    *("apt", "brew", "cat", "cd", "cp", "curl", "echo", "export", "git", "ls", "make", "mkdir"),
    *("nc", "pip", "pipx", "python", "python3", "sleep", "source", "ssh", "sudo"),
    *("test_camera", "test_drive_system", "test_range_sensor"),
}
"""Programs of the system, and those of ours that take a driver's options."""


def lines_of(page: Path) -> list[str]:
    """The commands of a page; a line that ends with a backslash goes on."""
    blocks = FENCED.findall(page.read_text(encoding="utf-8"))
    return [
        line
        for block in blocks
        for line in block.replace("\\\n", " ").splitlines()
        if line.strip() and not line.lstrip().startswith("#")
    ]


def commands_of(line: str) -> list[list[str]]:
    """The words of each command of a line, without comments and what is redirected."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    lexer.commenters = ""
    found: list[list[str]] = [[]]
    words = iter(lexer)
    for word in words:
        if word.startswith("#"):
            break
        if word in (">", "<", ">>"):
            next(words)
        elif set(word) <= set("();|&"):
            found.append([])
        elif found[-1] or not (word in KEYWORDS or re.fullmatch(r"[A-Z_]+=.*", word)):
            found[-1].append(word)
    return [words for words in found if words]


def mistake(words: list[str]) -> str:
    """What is wrong with a command; nothing when it could be run."""
    program, *rest = words
    program = program.removeprefix(".venv/bin/")
    if program == "behave":
        return refused(behave._parser(), rest)
    if program != "hri":
        return "" if program in OTHERS else f"no program {program}"
    if not rest or rest[0].startswith("-"):
        return ""
    if rest[0] not in COMMANDS:
        return f"no command {rest[0]}"
    parser = argparse.ArgumentParser(prog=f"hri {rest[0]}")
    importlib.import_module(COMMANDS[rest[0]][0]).add_arguments(parser)
    return refused(parser, rest[1:])


def refused(parser: argparse.ArgumentParser, words: list[str]) -> str:
    told = io.StringIO()
    try:
        with redirect_stdout(told), redirect_stderr(told):
            parser.parse_args(words)
    except SystemExit as end:
        return told.getvalue() if end.code else ""
    return ""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(HOUSE)))
def test_the_commands_of_a_page_exist_and_take_their_options(page: Path) -> None:
    wrong = {
        line: why
        for line in lines_of(page)
        for words in commands_of(line)
        if (why := mistake(words))
    }
    assert wrong == {}


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("fire hri emotion simulate --personality pessimist", "no program fire"),
        ("hri emotoin list", "no command emotoin"),
        ("hri emotion list --nosuch", "unrecognized arguments: --nosuch"),
        ("hri say Hello | hri watch --nosuch", "unrecognized arguments: --nosuch"),
        ("HRI_PATH=. hri emotion list  # it's fine", ""),
    ],
)
def test_a_command_that_could_not_be_run_is_noticed(line: str, why: str) -> None:
    assert why in "; ".join(mistake(words) for words in commands_of(line))


def test_what_not_every_system_has_is_named_where_one_begins() -> None:
    assert "`nc`" in (HOUSE / "README.md").read_text(encoding="utf-8")


def test_the_first_lines_say_which_language_it_understands() -> None:
    opening = (HOUSE / "README.md").read_text(encoding="utf-8").split("\n\n")[1]
    assert {"English", "spoken", "typed"} <= set(re.findall(r"\w+", opening))
