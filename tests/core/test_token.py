"""The token: one file that only its user may read."""

import os
import stat
import threading
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.cli.main import main
from hri.core.errors import HriError
from hri.core.token import (
    VARIABLE,
    Challenge,
    Grant,
    is_nonce,
    is_proof,
    is_token,
    load_token,
    new_nonce,
    new_token,
    own_token,
    proof,
    token_file,
)


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


def test_programs_that_make_it_at_once_get_the_same_one():
    ready = threading.Barrier(8)
    found = []

    def make():
        ready.wait()
        found.append(own_token())

    threads = [threading.Thread(target=make) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {*found} == {load_token()}
    assert len(found) == 8


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


KNOWN = "2cb88ede82146d13cc2e99d6e641815e0f7131a164cfb42868c3234dca097f98"
TOKENS = st.from_regex(r"[A-Za-z0-9_.~+/=-]{16,50}", fullmatch=True)
NONCES = st.from_regex(r"[A-Za-z0-9_-]{16,64}", fullmatch=True)
ADDRESSES = st.ip_addresses().map(str)
PORTS = st.integers(1, 65535)
ENDS = st.tuples(ADDRESSES, PORTS, ADDRESSES, PORTS).map(lambda ends: " ".join(map(str, ends)))
PROVEN = st.tuples(
    TOKENS, st.sampled_from(["client", "server"]), st.builds(Challenge, NONCES, NONCES, ENDS)
)


@st.composite
def two_that_differ_in_one_thing(draw):
    """Who proves what, and the same with another token, role, nonce, address, or port."""
    token, role, challenge = draw(PROVEN)
    other_token, _, other = draw(PROVEN)
    words, others = challenge.ends.split(), other.ends.split()
    swapped = [*words[2:], *words[:2]]
    changed = draw(
        st.sampled_from(
            [
                (other_token, role, challenge),
                (token, "server" if role == "client" else "client", challenge),
                (token, role, replace(challenge, client=other.client)),
                (token, role, replace(challenge, server=other.server)),
                (token, role, replace(challenge, client=challenge.server, server=challenge.client)),
                (token, role, replace(challenge, ends=" ".join(swapped))),
                *(
                    (
                        token,
                        role,
                        replace(challenge, ends=" ".join([*words[:i], others[i], *words[i + 1 :]])),
                    )
                    for i in range(4)
                ),
            ]
        )
    )
    return (token, role, challenge), changed


@given(two_that_differ_in_one_thing())
def test_a_proof_is_for_one_token_role_and_connection(both):
    one, other = both
    assert is_proof(proof(*one), *one)
    assert is_proof(proof(*one), *other) == (one == other)


@given(PROVEN, PROVEN)
def test_a_proof_tells_nothing_of_the_token_and_never_fits_another_challenge(one, other):
    assert one[0] not in proof(*one)
    assert (proof(*one) == proof(*other)) == (one == other)


def test_a_proof_is_hmac_sha256_of_one_line():
    """From an independent implementation: `printf ... | openssl dgst -sha256 -hmac TOKEN`."""
    ends = "127.0.0.1 40112 127.0.0.1 25000"
    challenge = Challenge("client-nonce-1234", "server-nonce-5678", ends)
    assert proof("a-token-of-somebody", "client", challenge) == KNOWN


@given(st.text())
def test_what_is_no_proof_does_not_fit(shown):
    challenge = Challenge(new_nonce(), new_nonce(), "127.0.0.1 1 127.0.0.1 2")
    assert not is_proof(shown, "a-token-of-somebody", "client", challenge)


def test_a_nonce_is_new_each_time():
    found = {new_nonce() for _ in range(1000)}
    assert len(found) == 1000
    assert all(map(is_nonce, found))


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


def test_curl_reads_it_from_its_standard_input(capsys):
    assert main(["token", "--curl"]) == 0
    assert capsys.readouterr().out == f'header = "Authorization: Bearer {load_token()}"\n'


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
