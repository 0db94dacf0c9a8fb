import logging
import unicodedata
from pathlib import Path

import pytest
from hypothesis import example, given, strategies as st

from hri.behavior.library.printing import labeled
from hri.cli.main import main
from hri.cli.terminal.messages import LineFormatter
from hri.core.errors import AuthoringError, AuthoringErrors, HriError, Place
from hri.core.quoting import LONGEST_MESSAGE, LONGEST_QUOTE, escaped, message_line, quoted
from hri.speech.grammar.lint.finding import warning

HOSTILE = "a\x1b[2J\x07\r\n\u202e\u2066\u200f\u2028\x85\ud800\x00\x9b31mz"
TEXTS = st.one_of(
    st.text(),
    st.text(st.characters(categories=("Cc", "Cf", "Cs", "Zl", "Zp"))),
    st.text(st.sampled_from('"a\x1b\u202e- '), max_size=400),
)


def is_plain(line: str) -> bool:
    """Whether a terminal shows a line as it is: nothing commands it, turns it or ends it."""
    return not any(unicodedata.category(c) in ("Cc", "Cf", "Cs", "Zl", "Zp") for c in line)


@given(TEXTS)
@example(HOSTILE)
@example('"' + "\x1b" * 5000 + '" is not a number - mend it')
def test_every_message_is_a_plain_line_of_bounded_length(text: str) -> None:
    for error in (
        HriError(text),
        HriError(f'"{text}" is not known - mend it'),
        AuthoringError(Place(Path("file.toml")), f'"{text}"', text),
        warning(Place(Path(f"{text}x".replace("\0", ""))), text, text),
    ):
        assert is_plain(str(error))
        assert len(str(error)) <= LONGEST_MESSAGE
    assert len(quoted(text)) <= LONGEST_QUOTE
    assert is_plain(escaped(text))


@given(st.text(st.characters(categories=("L", "N", "P")), max_size=LONGEST_QUOTE))
def test_what_harms_nobody_is_quoted_as_it_is(text: str) -> None:
    assert quoted(text) == escaped(text) == text
    assert message_line(f"{text} - mend it") == f"{text} - mend it"


@given(TEXTS, st.text(st.characters(categories=("L",)), min_size=1, max_size=30))
def test_the_remedy_stays_however_long_the_input_is(text: str, remedy: str) -> None:
    text = text.replace('"', "'")
    assert str(HriError(f'"{text * 100}" is too long - {remedy}')).endswith(f" - {remedy}")
    assert str(HriError(f"{text * 100} is too long - {remedy}")).endswith(f" - {remedy}")


def test_several_mistakes_are_a_line_each() -> None:
    place = Place(Path("a.toml"))
    both = AuthoringErrors([AuthoringError(place, HOSTILE, "b"), AuthoringError(place, "c", "d")])
    assert len(str(both).splitlines()) == 2


def test_a_log_line_cannot_command_the_terminal() -> None:
    shown = LineFormatter("%(levelname)s - %(message)s")
    record = logging.LogRecord("hri", logging.ERROR, "", 1, "peer: %s", (HOSTILE,), None)
    assert is_plain(shown.format(record))
    try:
        raise ValueError(HOSTILE)
    except ValueError as error:
        info = (ValueError, error, error.__traceback__)
        record = logging.LogRecord("hri", logging.ERROR, "", 1, "failed", (), info)
    lines = shown.format(record).split("\n")
    assert len(lines) > 3
    assert all(map(is_plain, lines))


def test_values_are_printed_in_plain_lines() -> None:
    assert is_plain(labeled(HOSTILE))


@pytest.mark.parametrize(
    "words", [[HOSTILE], ["grammar", HOSTILE], ["bench", "net", "--seconds", HOSTILE]]
)
def test_a_wrong_command_line_is_quoted_plainly(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    try:
        status = main(words)
    except SystemExit as ended:
        status = int(str(ended.code))
    assert status == 2
    assert all(map(is_plain, capsys.readouterr().err.splitlines()))


def test_what_a_network_holds_is_shown_plainly(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.xml"
    text = '<Parameter name="text" value="\u202e\u200f"/>'
    file.write_text(
        f'<BehaviorNetwork><Behavior id="a" type="Hri.PrintBehavior">{text}</Behavior>'
        "</BehaviorNetwork>"
    )
    assert main(["network", "show", str(file)]) == 0
    shown = capsys.readouterr().out
    assert "\\u202e" in shown
    assert all(map(is_plain, shown.splitlines()))


@pytest.mark.parametrize(
    "words",
    [
        ["grammar", "parse", "companion", "go \x1b[31m ahead"],
        ["grammar", "pronounce", "a\x1b[31mx"],
        ["grammar", "test", "--grammar", "companion", "sentences"],
        ["emotion", "simulate", "--events", "events"],
    ],
)
def test_what_somebody_wrote_is_printed_plainly(
    words: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("sentences").write_text("+ go \x1b[31m => go\n")
    Path("events").write_text("10 praise 1 An\x1b[31mna\n")
    main(words)
    shown = capsys.readouterr()
    assert "\\x1b" in shown.out
    assert all(map(is_plain, (shown.out + shown.err).splitlines()))
