"""How a program joins a fleet: by itself, or as a file of Zenoh says."""

import json

import pytest

pytest.importorskip("zenoh", reason="the extra zenoh is not installed")

from hri.core.errors import HriError
from hri.net.zenoh import session
from hri.net.zenoh.session import FleetSettings, check, opened

ROUTER, OTHER = "tls/10.0.0.1:7447", "tcp/10.0.0.2:7447"


def configured(settings, key):
    return json.loads(session._configuration(settings, port=5000, met=[5001]).get_json(key))


@pytest.fixture
def file(tmp_path):
    found = tmp_path / "zenoh.json5"
    found.write_text(f'{{mode: "peer", connect: {{endpoints: ["{ROUTER}"]}}}}')
    return found


def test_without_a_word_it_stays_on_this_machine_whatever_a_file_says(file):
    settings = FleetSettings("anna", file=file)
    assert configured(settings, "listen/endpoints") == ["tcp/127.0.0.1:5000"]
    assert configured(settings, "connect/endpoints") == ["tcp/127.0.0.1:5001"]
    assert configured(settings, "scouting/multicast/enabled") is False


def test_a_file_decides_for_other_machines_and_more_may_be_named(file):
    settings = FleetSettings("anna", allows_remote=True, connect=(OTHER,), file=file)
    assert configured(settings, "connect/endpoints") == [ROUTER, "tcp/127.0.0.1:5001", OTHER]
    assert "5000" not in str(configured(settings, "listen/endpoints"))


@pytest.mark.parametrize("text", ["", "{mode: 5}", "no", "{connect: {endpoints: {peer: []}}}"])
def test_what_is_no_configuration_is_refused(tmp_path, text):
    file = tmp_path / "zenoh.json5"
    file.write_text(text)
    with pytest.raises(HriError, match=r"zenoh\.json5"):
        check(FleetSettings("anna", allows_remote=True, file=file))


def test_the_note_of_a_program_that_has_ended_is_taken_away(tmp_path):
    folder = tmp_path / "state" / "hri" / "fleet"
    folder.mkdir(parents=True)
    for name in ("999999999-5000", "nonsense", "-1-2"):
        (folder / name).touch()
    with opened(FleetSettings()):
        assert len([*folder.glob("*-*")]) == 2
    assert {one.name for one in folder.iterdir()} == {"nonsense", "-1-2"}
