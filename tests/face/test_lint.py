"""`hri face check` tells what is likely a slip, where it is, and what to do."""

import shutil
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.core import paths
from hri.face import load_face
from hri.face.lint import Finding, findings
from tests.face.small_face import write_face, write_target


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return write_face(tmp_path / "mine")


def found(folder: Path) -> list[Finding]:
    return findings(load_face(folder), folder)


def told(folder: Path, words: str) -> Finding:
    """The finding with these words, the only one."""
    fitting = [finding for finding in found(folder) if words in finding.what]
    assert len(fitting) == 1, [str(finding) for finding in found(folder)]
    return fitting[0]


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def test_a_good_face_has_nothing_to_tell(folder: Path) -> None:
    # A light hangs on one side only, and nothing weeps: both may be wanted.
    assert [str(finding) for finding in found(folder) if finding.is_slip] == []


def test_expressions_that_are_missing_are_listed(folder: Path) -> None:
    change(folder / "face.toml", "[expressions.furious]\nmouthSmile = 0.4", "")
    assert told(folder, "furious cannot be shown").is_slip


def test_expressions_that_look_the_same_are_told_with_their_place(folder: Path) -> None:
    change(folder / "face.toml", "mouthSmile = 0.4\n", "mouthSmile = 0.425\n")
    finding = told(folder, "looks the same as furious")
    assert finding.place.line > 40


def test_a_target_that_changes_nothing_is_told(folder: Path) -> None:
    write_target(
        folder, "cheekPuff", '<rect id="neck" x="40" y="80" width="20" height="20" fill="#777"/>'
    )
    assert told(folder, "cheekPuff changes nothing").place.path.name == "cheekPuff.svg"


def test_a_misspelt_target_that_nothing_uses_is_told(folder: Path) -> None:
    write_target(
        folder, "jawOpne", '<path id="brow" d="M 28,31 L 72,31" fill="none" stroke="#321"/>'
    )
    finding = told(folder, "neither face.toml nor a gesture uses jawOpne")
    assert finding.is_slip
    assert "jawOpen" in finding.remedy


def test_lips_that_go_through_each_other_are_told_with_the_expression(folder: Path) -> None:
    write_target(folder, "jawOpen", '<path id="lips" d="M 35,70 Q 50,66 65,70 Q 50,20 35,70 Z"/>')
    finding = told(folder, '"lips" is inside out')
    assert finding.place.path.name == "neutral.svg"
    assert " at error and " in finding.what


def test_what_leaves_the_drawing_is_told(folder: Path) -> None:
    write_target(
        folder, "browInnerUp", '<path id="brow" d="M 28,-9 L 72,31" fill="none" stroke="#321"/>'
    )
    change(folder / "face.toml", "[expressions.amazed]", "[expressions.amazed]\nbrowInnerUp = 1")
    assert told(folder, '"brow" leaves the drawing at amazed').is_slip


def test_weights_that_add_up_to_too_much_are_told(folder: Path) -> None:
    change(folder / "face.toml", "[expressions.amazed]", "[expressions.amazed]\nmouthSmileLeft = 1")
    change(folder / "face.toml", "mouthSmile = 0.575", "mouthSmile = 0.9")
    assert "mouthSmileLeft adds up to 1.90" in told(folder, "adds up to").what


def test_sides_that_do_not_mirror_are_noted(folder: Path) -> None:
    change(folder / "neutral.svg", 'id="eyeLeft" cx="65" cy="45"', 'id="eyeLeft" cx="65" cy="49"')
    assert not told(folder, '"eyeLeft" and "eyeRight" do not mirror by 4.0 units').is_slip


def test_patterns_of_the_head_that_fit_nothing_are_told(folder: Path) -> None:
    change(folder / "face.toml", 'still = ["neck"]', 'still = ["nekc"]')
    finding = told(folder, '"nekc" fits no part')
    assert 'did you mean "neck"' in finding.remedy


def test_everything_that_is_wrong_is_told_at_once(tmp_path, capsys):
    folder = tmp_path / "eyes"
    shutil.copytree(paths.find("faces", "eyes"), folder)
    toml = folder / "face.toml"
    text = toml.read_text().replace("roll_degrees", "rol_degrees")
    toml.write_text(text.replace("rate_per_minute = ", "rate_per_minute = 6", 1).replace(
        "[expressions.sad]\n", "[expressions.sad]\nbrowUp = 1.0\n", 1
    ))  # fmt: skip
    for name in ("rage", "tear"):
        (folder / "targets" / f"{name}.svg").write_text("<svg")
    assert main(["face", "check", str(folder)]) == 2
    told = capsys.readouterr().err.splitlines()
    assert len(told) == 5
    wrong = ("browUp", "rate_per_minute", "rol_degrees", "rage.svg", "tear.svg")
    assert all(any(name in line for line in told) for name in wrong)


def test_a_mistake_is_told_once_in_the_folder_where_one_is(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    toml = folder / "face.toml"
    toml.write_text(toml.read_text() + "\n[expressions.hapy]\n")
    monkeypatch.chdir(folder)
    assert main(["face", "check", "."]) == 2
    assert capsys.readouterr().err.count('no expression "hapy"') == 1
