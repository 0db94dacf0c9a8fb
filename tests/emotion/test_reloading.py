import os
from pathlib import Path

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.emotion.files import EmotionFiles

MINE = '[stimulus.tickled]\nwords = "you tickled me"\nemotions = { joy = 0.5 }\n'


@pytest.fixture
def mine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A stimulus file of the user."""
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    path = tmp_path / "emotions" / "stimuli" / "mine.toml"
    path.parent.mkdir(parents=True)
    path.write_text(MINE, encoding="utf-8")
    return path


def test_a_saved_file_is_read_anew_and_only_then(mine: Path) -> None:
    files = EmotionFiles("neutral")
    first = files.model
    assert first.stimuli["tickled"].emotions == {"joy": 0.5}
    assert not files.reload()
    assert files.model is first
    mine.write_text(MINE.replace("0.5", "0.75"), encoding="utf-8")
    assert files.reload()
    assert files.model.stimuli["tickled"].emotions == {"joy": 0.75}
    assert not files.reload()


def test_a_wrong_file_is_told_once_and_changes_nothing(mine: Path) -> None:
    files = EmotionFiles("neutral")
    before = files.model
    # The personality is fine, the stimuli are not: neither is taken.
    folder = mine.parents[1] / "personalities"
    folder.mkdir()
    (folder / "neutral.toml").write_text("[baseline]\npleasure = 0.5\n", encoding="utf-8")
    mine.write_text(MINE + "wrong =", encoding="utf-8")
    with pytest.raises(AuthoringError, match=r"mine\.toml:4:"):
        files.reload()
    assert files.model is before
    assert not files.reload()
    assert files.model is before
    mine.write_text(MINE, encoding="utf-8")
    assert files.reload()
    assert files.model.personality.baseline == (0.5, 0.0, 0.0)


def test_files_that_come_and_go_are_seen(mine: Path) -> None:
    files = EmotionFiles("neutral")
    other = mine.with_name("other.toml")
    other.write_text(MINE.replace("tickled", "hugged"), encoding="utf-8")
    assert files.reload()
    assert "hugged" in files.model.stimuli
    other.unlink()
    mine.unlink()
    assert files.reload()
    assert not {"hugged", "tickled"} & set(files.model.stimuli)


def test_a_personality_that_is_gone_is_told_and_the_robot_stays_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "grumpy.toml"
    path.write_text("[baseline]\npleasure = -0.5\n", encoding="utf-8")
    files = EmotionFiles(str(path))
    path.unlink()
    with pytest.raises(HriError, match="grumpy"):
        files.reload()
    assert files.model.personality.baseline == (-0.5, 0.0, 0.0)


@settings(deadline=None, max_examples=40)
@given(st.binary(max_size=80) | st.text(max_size=80).map(str.encode), st.integers(0, 120))
def test_no_file_does_more_than_be_refused(
    tmp_path_factory: pytest.TempPathFactory, noise: bytes, cut: int
) -> None:
    folder = tmp_path_factory.mktemp("mine")
    path = folder / "emotions" / "stimuli" / "mine.toml"
    path.parent.mkdir(parents=True)
    path.write_text(MINE, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HRI_PATH", str(folder))
        files = EmotionFiles("neutral")
        before = files.model
        text = MINE.encode()
        path.write_bytes(text[:cut] + noise + text[cut:])
        os.utime(path, ns=(0, 1))
        try:
            is_new = files.reload()
        except HriError:
            is_new = False
            assert files.model is before
        assert is_new == (files.model is not before)
