import threading
from pathlib import Path

import pytest
import trio

from hri.core import paths
from hri.net.connection import Connection
from hri.net.event_server import EventServer
from hri.task.task import find_task, task
from tests.net.conftest import WITHIN
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
    assert "is no event" in caplog.text or "is no name" in caplog.text
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
