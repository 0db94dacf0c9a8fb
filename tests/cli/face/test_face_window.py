"""The window of `hri face show`: keys, turns, and drawings that are saved while it is open."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from hri.cli.face.face_window import CYCLE_S, FaceWindow
from hri.cli.main import main
from hri.core.clock import FakeClock
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from tests.face.small_face import write_face


@pytest.fixture
def window(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[FaceWindow]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = write_face(tmp_path / "mine")
    size = {"width": "96", "height": "80"}
    description = Description("screen", "Hri.OffscreenScreen", size)
    with ResourceManager([description], FakeClock()) as resources:
        screen = resources.obtain("screen", OffscreenScreen)
        yield FaceWindow(folder, screen, resources.clock, is_watching=True)


def image(window: FaceWindow) -> np.ndarray:
    assert isinstance(window.screen, OffscreenScreen)
    return window.screen.image


def watch(window: FaceWindow, seconds: float = 1.0) -> None:
    end = window.clock.now() + seconds
    while window.clock.now() < end:
        window.frame()


def test_all_expressions_then_all_visemes_are_shown_in_turn(window: FaceWindow) -> None:
    seen = []
    for _ in range(28 + 15):
        seen.append((window.look.expression, window.look.viseme))
        window._turn_to(window._next_of_all())
    assert len(set(seen)) == 28 + 15
    assert (window.look.expression, window.look.viseme) == seen[0]


def test_it_goes_on_by_itself_until_a_key_is_pressed(window: FaceWindow) -> None:
    watch(window, CYCLE_S + 0.2)
    assert window.look.expression == "angry"
    window.press("right")
    watch(window, CYCLE_S + 0.2)
    assert window.look.expression == "sad"


def test_keys_choose_expressions_visemes_and_turns(window: FaceWindow) -> None:
    for key, label, viseme in [
        ("right", "angry", ""),
        ("left", "neutral", ""),
        ("left", "error", ""),
        ("s", "sad", ""),
        ("s", "surprised", ""),
        ("down", "surprised", "sil"),
        ("2", "surprised", "PP"),
        ("up", "surprised", "sil"),
        ("q", "surprised", "sil"),
        ("f9", "surprised", "sil"),
    ]:
        window.press(key)
        assert (window.look.expression, window.look.viseme) == (label, viseme), key
    window.press("tab")
    assert window.look.turn == 1
    window.press("escape")
    assert not window.is_open


def test_a_new_look_fades_in_and_the_face_lives_on(window: FaceWindow) -> None:
    window.press("f1")
    window.frame()
    before = image(window)
    window.press("amazed"[0])
    window.frame()
    soon = image(window)
    watch(window)
    there = image(window)
    watch(window, 2.0)
    assert not np.array_equal(there, image(window))
    assert np.abs(soon.astype(int) - before).sum() < np.abs(there.astype(int) - before).sum()


def test_a_drawing_that_is_saved_is_shown(
    window: FaceWindow, capsys: pytest.CaptureFixture[str]
) -> None:
    file = window.folder / "neutral.svg"
    window.press("n")
    watch(window)
    before = image(window)
    file.write_text(file.read_text().replace('fill="#777"', 'fill="#fff"'))
    watch(window)
    assert not np.array_equal(before, image(window))
    assert "reloaded" in capsys.readouterr().out


def test_a_drawing_that_is_refused_leaves_the_last_good_one_and_says_why(
    window: FaceWindow, capsys: pytest.CaptureFixture[str]
) -> None:
    file = window.folder / "targets" / "jawOpen.svg"
    good, model = file.read_text(), window.model
    file.write_text(good.replace('id="lips"', 'id="lisp"'))
    watch(window)
    assert window.model is model
    assert 'did you mean "lips"' in window.refusal
    assert capsys.readouterr().err.count("lisp") == 1
    window.press("f1")
    window.frame()
    with_reason = image(window)
    file.write_text(good)
    watch(window)
    assert window.refusal == ""
    window.frame()
    assert not np.array_equal(with_reason[-20:], image(window)[-20:])


def test_a_folder_that_is_gone_for_a_while_does_no_harm(window: FaceWindow) -> None:
    away = window.folder.with_name("away")
    window.folder.rename(away)
    watch(window)
    assert window.refusal
    away.rename(window.folder)
    watch(window)
    assert window.refusal == ""


def test_without_a_display_the_command_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    assert main(["face", "show", "eyes"]) == 2
    assert "no display - connect one" in capsys.readouterr().err
