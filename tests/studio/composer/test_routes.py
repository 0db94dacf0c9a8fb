"""Networks over HTTP: who may, how much, and what comes back; a check that hangs harms no one."""

import json
from contextlib import contextmanager

import pytest
from starlette.testclient import TestClient

from hri.studio.composer import workshop
from hri.studio.composer.files import LARGEST
from hri.studio.composer.routes import LONGEST_BODY, ROOT, ROUTES
from hri.studio.guard import LONGEST_BODY as LONGEST_OTHER
from hri.studio.hub import Hub
from hri.studio.server import Settings, Studio
from tests.studio.test_server import GOOD as CODE, Robot

HOST = "http://127.0.0.1:8311"
NETWORK = '<BehaviorNetwork>\n  <Behavior id="a" type="Hri.Constant"/>\n</BehaviorNetwork>\n'
HANGS = """import sys
print("a line that is not an answer")
if "workshop" in sys.orig_argv[-1]:
    while True:
        pass
"""
GOOD = "from hri.behavior import Behavior\nclass Wave(Behavior): ...\n"
SCHEMA = """<BehaviorSchema type="Own.Wave" driver="Own.Wave" library="wave.py"/>"""


@contextmanager
def client(settings):
    robot = Robot()
    robot.hub = Hub(robot)
    app = Studio(robot.hub, settings).app()
    with TestClient(app, HOST, backend="trio", client=("127.0.0.1", 5000)) as made:
        yield made


@pytest.fixture
def start(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return tmp_path


@pytest.fixture
def stranger(start):
    with client(Settings(8311, "secret", False)) as made:
        yield made


@pytest.fixture
def person(start):
    devices = [{"id": "eye", "interface": "camera", "about": "Hri.OpenCvCamera"}]
    with client(Settings(8311, "secret", False, devices=devices)) as made:
        assert made.get(f"/?code={CODE}").status_code == 200
        yield made


@pytest.mark.parametrize("route", ROUTES, ids=lambda route: f"{route.method} {route.path}")
def test_a_stranger_sees_and_changes_nothing(stranger, start, route):
    assert stranger.request(route.method, ROOT + route.path).status_code == 401
    assert list(start.iterdir()) == []


def test_a_network_is_saved_drafted_opened_and_watched(person, start):
    path = str(start / "one.xml")
    body = {"path": path, "text": NETWORK, "mark": None}
    assert person.put(f"{ROOT}/draft", json=body).json() == {}
    mark = person.put(f"{ROOT}/file", json=body).json()["mark"]
    assert person.get(f"{ROOT}/file", params={"path": path}).json()["text"] == NETWORK
    watched = person.get(f"{ROOT}/watch", params={"path": path, "mark": mark})
    assert watched.json() == {"mark": mark}
    again = person.put(f"{ROOT}/file", json=body)
    assert (again.status_code, again.json()["text"]) == (409, NETWORK)
    assert person.request("DELETE", f"{ROOT}/draft", params={"path": path}).json() == {}
    missing = person.get(f"{ROOT}/file", params={"path": str(start / "two.xml")})
    assert (missing.status_code, "no such network" in missing.json()["error"]) == (404, True)
    assert path in {one["path"] for one in person.get(ROOT).json()["networks"]}


def test_the_palette_has_the_robots_devices_and_comes_once(person):
    found = person.get(f"{ROOT}/palette", params={"mark": ""}).json()
    assert found["devices"][0]["id"] == "eye"
    assert any(one["type"] == "Hri.Constant" for one in found["behaviors"])
    again = person.get(f"{ROOT}/palette", params={"mark": found["mark"]}).json()
    assert again == {"mark": found["mark"]}
    schema = person.get(f"{ROOT}/schema", params={"type": "Hri.Constant"}).json()
    assert schema["path"] is None
    assert "<BehaviorSchema" in schema["text"]
    assert person.get(f"{ROOT}/schema", params={"type": "Hri.Nothing"}).status_code == 409


@pytest.mark.parametrize(
    "body",
    [b"", b"[]", b"{", b"null", b'{"path": 3}', b'{"nonsense": ""}', b"[" * 100_000, b"\xff"],
)
@pytest.mark.parametrize("route", [one for one in ROUTES if one.method in ("PUT", "POST")])
def test_nonsense_is_refused(person, route, body):
    answer = person.request(route.method, ROOT + route.path, content=body)
    assert answer.status_code in (400, 409)
    assert answer.json()["error"]


def test_a_large_network_is_taken_and_a_larger_one_not(person, start):
    body = {"path": str(start / "one.xml"), "text": " " * (LARGEST - 1), "mark": None}
    assert len(json.dumps(body)) > LONGEST_OTHER
    assert person.put(f"{ROOT}/draft", json=body).status_code == 200
    body["text"] = " " * (LARGEST + 1)
    assert person.put(f"{ROOT}/draft", json=body).status_code == 409
    body["text"] = " " * LONGEST_BODY
    assert person.put(f"{ROOT}/draft", json=body).status_code == 403


@pytest.mark.slow
def test_a_behavior_that_hangs_when_it_is_imported_ends_only_its_check(person, start, monkeypatch):
    folder = start / "config" / "behavior" / "Own"
    folder.mkdir(parents=True)
    (folder / "Wave.xml").write_text(SCHEMA)
    (folder / "wave.py").write_text(HANGS)
    monkeypatch.setenv("HRI_PATH", str(start))
    monkeypatch.setattr(workshop, "PATIENCE_AT_START", 2.0)
    monkeypatch.setattr(workshop, "LOOK_EVERY", 0.0)
    text = NETWORK.replace("Hri.Constant", "Own.Wave")
    body = {"path": str(start / "one.xml"), "text": text}
    answer = person.post(f"{ROOT}/check", json=body)
    assert (answer.status_code, "keeps its check waiting" in answer.json()["error"]) == (409, True)
    (folder / "wave.py").write_text(GOOD)
    monkeypatch.setattr(workshop, "PATIENCE_AT_START", 30.0)
    answer = person.post(f"{ROOT}/check", json=body)
    assert answer.json()["problems"] == []
