"""docs/faces.md: its face loads, its commands run, its tables name what there is."""

import re
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.core import paths
from hri.face import load_face
from hri.face.vocabulary import LABELS, PAIRED, SINGLE, VISEMES

PAGE = (paths.house() / "docs" / "faces.md").read_text()
FENCED = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCKS = [(match[1], match[2]) for match in FENCED.finditer(PAGE)]
COMMANDS = [line for kind, text in BLOCKS if kind == "sh" for line in text.splitlines()]


@pytest.fixture
def mine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The face of the page, in the folder that its commands are run in."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    for kind, text in BLOCKS:
        if kind in ("xml", "toml"):
            name = text.splitlines()[0].strip("<!-# >")
            file = tmp_path / "mine" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
    return tmp_path / "mine"


def test_the_face_of_the_page_lives(mine: Path) -> None:
    face = load_face(mine)
    assert set(face.targets) == {"jawOpen", "mouthSmile", "mouthFrown", "eyeBlink"}
    assert "headYaw" in face.channels


@pytest.mark.parametrize("command", [line for line in COMMANDS if "face" in line.split()[1]])
def test_the_commands_of_the_page_run(
    command: str, mine: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = command.split()[1:]
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    if words[1] == "new":
        words[2] = "another"
    status = main(words)
    told = capsys.readouterr()
    if words[1] == "show":
        assert "no display" in told.err
    elif words[1] == "check":
        assert status == 1
        assert "cannot be shown - add [expressions.pleading]" in told.out
        assert told.out.splitlines()[-1].endswith("1 warning")
    else:
        assert status == 0, told.err


@pytest.mark.parametrize("text", [text for kind, text in BLOCKS if kind == "python"])
def test_the_programs_of_the_page_run(text: str) -> None:
    exec(compile(text, "docs/faces.md", "exec"), {})


def test_the_page_names_all_labels_visemes_and_targets() -> None:
    words = set(re.findall(r"\w+", PAGE))
    assert words >= {*LABELS, *VISEMES, *PAIRED, *SINGLE}


def test_the_links_of_the_page_lead_somewhere() -> None:
    for link in re.findall(r"\]\(([\w./]+)\)", PAGE):
        assert (paths.house() / "docs" / link).exists(), link
