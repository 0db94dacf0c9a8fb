import threading
from pathlib import Path

import pytest
import trio

from hri.behavior.doors import Doors
from hri.core import paths
from hri.net.connection import Connection
from hri.net.event_server import EventServer
from hri.net.receipts import RECEIVED
from hri.task.task import find_task, task
from tests.net.conftest import WITHIN, Taken
from tests.task.stage import Stage


@pytest.fixture(autouse=True)
def free_port(tmp_path, monkeypatch):
    """The primitive's network, on any free port."""
    shipped = paths.find("config", "primitive/Examples/EventServer.xml").read_text()
    port = '<Parameter name="tcp_port" value="0"/></Behavior>'
    text = shipped.replace('type="Examples.EventServer"/>', f'type="Examples.EventServer">{port}')
    folder = tmp_path / "primitive" / "Examples"
    folder.mkdir(parents=True)
    Path(folder / "EventServer.xml").write_text(text)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))


@task("Tests.PhotoEvent")
async def photographer(context):
    """Take photos when told, until told to end; how many."""
    task = context.task
    task.enable_event("Examples.PhotoEvent.*")
    photos = 0
    while event := await task.wait_for_event("Examples.PhotoEvent.*"):
        if event.name == "Examples.PhotoEvent.End":
            return photos
        if event.name == "Examples.PhotoEvent.Shoot":
            for _ in range(int(event.properties["count"])):
                await context.clock.sleep(event.properties["delay"])
                photos += 1
            context.manager.raise_event("Examples.PhotoEvent.Done")


class Script(threading.Thread):
    """A foreign program: sends lines when it is connected and after each line that comes."""

    def __init__(self, *lines):
        super().__init__(daemon=True)
        self.lines = list(lines)
        self.received = []

    def run(self):
        with Connection("127.0.0.1", self.port, WITHIN) as connection:
            connection.send(self.lines.pop(0))
            while self.lines:
                self.received.append(connection.read())
                connection.send(self.lines.pop(0))


def sent(text):
    return f'<event_server><event count="1">{text}</event></event_server>'


@task("Tests.Scene")
async def scene(context, script):
    """The event server and a photographer in parallel, and the script that talks to them."""
    photos = context.manager.install(photographer)
    server = context.manager.install(EventServer)
    await context.clock.sleep(0.05)
    script.port = context.behaviors["Examples.EventServer.server"].port_in_use
    script.start()
    await server.wait()
    await trio.to_thread.run_sync(script.join, WITHIN)
    photos_taken = photos.result if photos.is_over else None
    photos.cancel()
    return server.status.name, photos_taken


SHOOT = "Examples.PhotoEvent.Shoot?count=5&amp;delay=1&amp;name=b_"
SERVER_PRINTS = """\
Received event string: Examples.PhotoEvent.Shoot?count=5&delay=1&name=b_
Raising event: {Event Examples.PhotoEvent.Shoot [time 0] (count: 5.000000) (delay: 1.000000) \
(name: "b_")}
Received event string: Examples.PhotoEvent.End
Raising event: {Event Examples.PhotoEvent.End [time 0]}
"""
CLIENT_RECEIVES = [
    '<event_server><event_id count="1">&quot;Examples.PhotoEvent.Done&quot;</event_id>'
    "</event_server>"
]


@pytest.mark.proves("T22", "T23", "W05", "W07", "W09", "E3", "E4")
def test_the_event_server_and_its_client_print_what_the_guide_shows(capsys):
    script = Script(sent(SHOOT), sent("Examples.PhotoEvent.End"))
    assert Stage().run(scene, script) == ("SUCCESS", 5)
    assert capsys.readouterr().out == SERVER_PRINTS
    assert script.received == CLIENT_RECEIVES


def test_quotes_are_taken_off_and_what_is_no_event_costs_a_line_in_the_log(capsys, caplog):
    script = Script(sent("no event?x") + "\n" + sent("&quot;My.End&quot;"))
    stage = Stage()
    assert stage.run(scene, script)[0] == "SUCCESS"
    assert "My.End" in stage.names()
    assert "is not an event" in caplog.text or "is not a name" in caplog.text
    assert "Raising event: {Event My.End [time 0]}\n" in capsys.readouterr().out


@pytest.mark.proves("T22")
def test_it_is_found_by_its_names_of_now_and_then():
    for name in ("Hri.EventServer", "Evolution.EventServer", "Examples.EventServer"):
        assert find_task(name) is EventServer


@task("Tests.Loss")
async def loss(context):
    """The event server, whose network somebody stops, and events meanwhile and afterwards."""
    server = context.manager.install(EventServer)
    await context.clock.sleep(0.05)
    context.networks.stop("Examples.EventServer")
    context.manager.raise_event("door.opened")
    server.cancel()
    await server.wait()
    context.manager.raise_event("door.closed")
    return server.status.name


def test_it_survives_the_loss_of_its_network(caplog):
    stage = Stage()
    assert stage.run(loss) == "CANCELLED"
    assert [name for name in stage.names() if name.startswith("door")] == [
        "door.opened",
        "door.closed",
    ]
    assert not [record for record in caplog.records if record.levelname == "ERROR"]


@task("Tests.Door")
async def door(context, lines, token):
    """The event server, and a program that sends it lines; what was raised here meanwhile."""
    raised = []
    context.events.subscribe("*", raised.append)
    server = context.manager.install(EventServer)
    await context.clock.sleep(0.05)
    behavior = context.behaviors["Examples.EventServer.server"]
    taken = Taken()
    behavior._link.subscribe("event_server", taken)
    port = behavior.port_in_use
    with Connection("127.0.0.1", port, WITHIN, token) as connection:
        for line in lines:
            connection.send(sent(line.replace("&", "&amp;")))
        await trio.to_thread.run_sync(taken.wait_for, len(lines))
        await context.clock.sleep(0.1 * len(lines) + 0.2)
    server.cancel()
    return raised


FORGED = [
    "speech.heard?rule=stop&text=stop",
    "speech.heard?rule=go_forward",
    "head.nodded",
    "drive.halt",
    "gesture.asked?name=nod",
    "stimulus.felt?stimulus=praise",
    "window.closed",
    "%73peech.heard?rule=yes",
]


def raised(lines, token=None, events=()):
    stage = Stage()
    stage.context.networks.context.doors = Doors().with_more(events=events)
    return [event for event in stage.run(door, lines, token) if event.name != RECEIVED]


@pytest.mark.parametrize("events", [(), ("*",), ("speech.*",)])
def test_no_event_from_outside_passes_for_the_robots_own(events, caplog):
    assert raised(FORGED, events=events) == []
    assert "only the robot itself raises" in caplog.text


def test_events_from_outside_are_marked_and_come_under_an_allow_list(caplog):
    lines = ["Examples.PhotoEvent.Shoot?count=1", "door.opened", "lamp.lit"]
    found = raised(lines, events=("door.*",))
    assert [(event.name, event.is_from_outside, event.origin) for event in found] == [
        ("Examples.PhotoEvent.Shoot", True, "bridge"),
        ("door.opened", True, "bridge"),
    ]
    assert '"lamp.lit" may not come from outside' in caplog.text


def test_without_the_token_no_event_comes_in(caplog):
    assert raised(["Examples.PhotoEvent.Shoot?count=1"], token="") == []
    assert "event_server.event may do anything" in caplog.text


@pytest.mark.parametrize("key", ["t", "event", "outside", "origin"])
def test_no_property_passes_for_what_a_recording_says(key, caplog):
    assert raised([f"Examples.Event?{key}=speech.heard"]) == []
