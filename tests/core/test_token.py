"""The token: one file that only its user may read."""

import os
import stat
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.token import VARIABLE, Grant, is_token, load_token, new_token, own_token, token_file


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.delenv(VARIABLE, raising=False)


def test_there_is_none_before_it_is_made_and_then_nothing_fits_it():
    assert load_token() is None
    assert not is_token("")
    assert not token_file().exists()


def test_it_is_made_once_in_a_file_of_its_user_alone():
    before = os.umask(0)
    try:
        token = own_token()
    finally:
        os.umask(before)
    assert own_token() == load_token() == token
    assert stat.S_IMODE(token_file().stat().st_mode) == 0o600
    assert stat.S_IMODE(token_file().parent.stat().st_mode) == 0o700
    assert len(token) >= 43


def test_a_new_one_makes_the_old_one_worthless():
    old = own_token()
    new = new_token()
    assert not is_token(old)
    assert is_token(new)


def test_what_a_token_gave_ends_with_it_and_with_its_file():
    grant, wrong = Grant(own_token()), Grant("another one, that is wrong")
    assert (grant.holds, wrong.holds) == (True, False)
    token_file().chmod(0o644)
    assert not grant.holds
    token_file().chmod(0o600)
    assert grant.holds
    new_token()
    assert not grant.holds
    newer = Grant(own_token())
    token_file().unlink()
    assert not newer.holds


@pytest.mark.parametrize("make", [Path.mkdir, os.mkfifo])
def test_what_is_not_a_file_is_to_be_moved_away_which_then_helps(make, tmp_path):
    """`hri token --new` could not replace it."""
    token_file().parent.mkdir(parents=True)
    make(token_file())
    for use in (load_token, new_token, own_token):
        with pytest.raises(HriError, match=r"token: .*is not a file - move it away"):
            use()
    token_file().rename(tmp_path / "away")
    assert own_token() == load_token()


@given(st.text())
def test_nothing_else_fits(shown):
    assert not is_token(shown)
    assert is_token(own_token()) or shown


def test_the_environment_goes_before_the_file(monkeypatch):
    kept = own_token()
    monkeypatch.setenv(VARIABLE, "chosen-by-somebody")
    assert is_token("chosen-by-somebody")
    assert not is_token(kept)
    monkeypatch.setenv(VARIABLE, "short")
    with pytest.raises(HriError, match=r"HRI_TOKEN: a token has 16 to 200 .* - hri token --new"):
        load_token()
    monkeypatch.setenv(VARIABLE, "")
    assert load_token() == kept


@pytest.mark.parametrize("mode", [0o644, 0o660, 0o602])
def test_one_that_others_may_read_or_write_is_not_used(mode):
    own_token()
    token_file().chmod(mode)
    with pytest.raises(HriError, match=r"others may read or change it.* hri token --new"):
        load_token()
    assert new_token() == load_token()


@pytest.mark.parametrize("content", [b"", b"\xff\xfe" * 20, b"two words are not our token"])
def test_a_damaged_one_is_told_in_a_line(content):
    own_token()
    token_file().write_bytes(content)
    with pytest.raises(HriError) as told:
        load_token()
    assert "\n" not in str(told.value)
    assert "hri token --new" in str(told.value)


def test_the_command_shows_it_and_makes_another(capsys):
    shown = []
    for words in (["token"], ["token"], ["token", "--new"], ["token"]):
        assert main(words) == 0
        shown.append(capsys.readouterr().out)
    assert shown[0] == shown[1] != shown[2]
    assert shown[2] == shown[3] == f"{load_token()}\n"


@pytest.mark.parametrize("is_there", [True, False])
def test_a_link_in_its_place_is_replaced_and_what_it_leads_to_stays(tmp_path, is_there):
    own_token()
    other = tmp_path / "other"
    if is_there:
        other.write_text("somebody's text")
    token_file().unlink()
    token_file().symlink_to(other)
    assert new_token() == load_token()
    assert not token_file().is_symlink()
    assert other.exists() == is_there
    assert not is_there or other.read_text() == "somebody's text"
    assert stat.S_IMODE(token_file().stat().st_mode) == 0o600


def test_a_new_one_that_the_environment_hides_says_so(monkeypatch, capsys):
    monkeypatch.setenv(VARIABLE, "chosen-by-somebody")
    assert main(["token", "--new"]) == 0
    assert "HRI_TOKEN is set and takes precedence" in capsys.readouterr().err
    assert main(["token"]) == 0
    assert capsys.readouterr() == ("chosen-by-somebody\n", "")
