"""Codes work once, cookies prove that one was shown, and foreign pages and names are refused."""

import pytest
from hypothesis import given, strategies as st

from hri.studio.access import (
    LASTS,
    MOST_CODES,
    Codes,
    Cookies,
    is_loopback,
    is_own_host,
    is_own_origin,
    is_signed_code,
)


def test_a_code_works_once():
    codes = Codes("secret")
    first, second = codes.new(), codes.new()
    assert first != second
    assert codes.redeem(first)
    assert not codes.redeem(first)
    assert codes.redeem(second)


def test_too_many_codes_make_the_oldest_worthless():
    codes = Codes("secret")
    made = [codes.new() for _ in range(MOST_CODES + 1)]
    assert [codes.redeem(code) for code in made] == [False] + [True] * MOST_CODES


@given(st.text())
def test_no_other_text_is_a_code(text):
    codes = Codes("secret")
    good = codes.new()
    assert codes.redeem(text) == (text == good)


@given(st.text())
def test_a_guess_is_known_without_asking_who_made_the_codes(guess):
    code = Codes("secret").new()
    assert is_signed_code("secret", code)
    assert not is_signed_code("another", code)
    assert not is_signed_code("secret", guess)
    assert not is_signed_code("secret", f"{guess}.{code.rpartition('.')[2]}")


def test_a_cookie_is_good_for_its_secret_and_its_time():
    cookie = Cookies("secret").new(1000.0)
    assert Cookies("secret").is_good(cookie, 1000.0)
    assert Cookies("secret").is_good(cookie, 999.0 + LASTS)
    assert not Cookies("secret").is_good(cookie, 1001.0 + LASTS)
    assert not Cookies("another").is_good(cookie, 1000.0)


@given(st.data())
def test_a_cookie_that_was_changed_is_worthless(data):
    cookie = Cookies("secret").new(1000.0)
    place = data.draw(st.integers(0, len(cookie) - 1))
    letter = data.draw(st.characters())
    changed = cookie[:place] + letter + cookie[place + 1 :]
    assert Cookies("secret").is_good(changed, 1000.0) == (changed == cookie)


@given(st.text())
def test_no_other_text_is_a_cookie(text):
    assert not Cookies("secret").is_good(text, 0.0)


@pytest.mark.parametrize(
    ("host", "at_home", "remote"),
    [
        ("127.0.0.1:8311", True, True),
        ("localhost:8311", True, True),
        ("[::1]:8311", True, True),
        ("192.168.1.7:8311", False, True),
        ("pi.local:8311", False, True),
        ("pi:8311", False, True),
        ("evil.example:8311", False, False),
        ("127.0.0.1.evil.example", False, False),
        ("", False, False),
        ("[::1", False, False),
    ],
)
def test_a_foreign_name_that_leads_here_is_refused(host, at_home, remote):
    assert is_own_host(host, allows_remote=False) == at_home
    assert is_own_host(host, allows_remote=True) == remote or host == ""


@pytest.mark.parametrize(
    ("origin", "is_own"),
    [
        (None, True),
        ("http://127.0.0.1:8311", True),
        ("http://127.0.0.1:8312", False),
        ("http://evil.example", False),
        ("null", False),
        ("", False),
        ("http://[::1", False),
    ],
)
def test_another_sites_page_is_refused(origin, is_own):
    assert is_own_origin(origin, "127.0.0.1:8311") == is_own


@pytest.mark.parametrize(
    ("address", "is_own"),
    [
        ("127.0.0.1", True),
        ("::1", True),
        ("::ffff:127.0.0.1", True),
        ("10.0.0.1", False),
        ("", False),
    ],
)
def test_what_is_this_machine(address, is_own):
    assert is_loopback(address) == is_own
