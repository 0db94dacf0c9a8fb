"""The tutorials of networks that talk over TCP, on loopback and fake time."""

import socket
import threading

import pytest

from hri.behavior.network_file import load_network
from hri.behavior.network_writer import save_network
from hri.behavior.runner import Runner
from hri.cli import behave
from hri.core import paths
from hri.core.clock import FakeClock
from hri.task import get_task_manager, use
from hri.testing import context
from tests.docs.tutorial import Tutorial
from tests.net.conftest import WITHIN, Taken

TELEOP, PRIMITIVE = "behavior-03-teleop", "behavior-04-primitive"


def free_port():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        return listening.getsockname()[1]


def at_port(path, id, port, folder):
    """A copy of a network in which a behavior uses another port."""
    network = load_network(path)
    network[id].set_parameter("tcp_port", port)
    save_network(network, folder / path.name)
    return folder / path.name


@pytest.fixture
def teleop(tmp_path):
    """The paths of both networks, on a port that is free."""
    folder, port = Tutorial(TELEOP).folder, free_port()
    return tuple(at_port(folder / f"{id}.xml", id, port, tmp_path) for id in ("server", "client"))


@pytest.fixture
def started():
    """Starts a network; ends it after the test."""
    runners = []

    def start(path):
        runners.append(Runner(load_network(path), context()))
        runners[-1].start()
        return runners[-1]

    yield start
    for runner in runners:
        runner.stop()


def heard(runner, id):
    """What a behavior of a network is sent."""
    taken = Taken()
    runner.network[id]._link.subscribe("tutorial", taken)
    return taken


@pytest.mark.proves("E9")
@pytest.mark.parametrize("name", ["server.xml", "client.xml"])
def test_the_networks_in_the_folder_are_those_of_the_house(name):
    ours = Tutorial(TELEOP).folder / name
    assert ours.read_text() == paths.find("config", f"networks/{name}").read_text()


@pytest.mark.proves("W12", "E9")
def test_both_networks_print_what_the_page_shows(teleop, started, capsys):
    heads = []
    for path in teleop:
        assert behave.main([str(path), "--without-resources", "--fast", "--duration=0.01"]) == 0
        heads.append(capsys.readouterr().out)
    server, client = map(started, teleop)
    to_server, to_client = heard(server, "server"), heard(client, "client")
    for runner, id in ((server, "server"), (client, "client")):
        assert runner.network[id]._link.wait_for_peers(1, WITHIN)
    printed = {server: "", client: ""}
    for tick in range(1, 4):
        for runner, waits in ((client, to_server), (server, to_client)):
            runner.tick(tick * 0.1)
            printed[runner] += capsys.readouterr().out
            waits.wait_for(tick)
    page = Tutorial(TELEOP)
    assert page.prints(heads[0] + printed[server], 0)
    assert page.prints(heads[1] + printed[client], 1)
    assert printed[server].count('Input text_received  string: "text from client"') == 3


@pytest.mark.proves("W11", "W12", "E4")
def test_a_program_takes_the_place_of_the_client(teleop, started, capsys):
    page = Tutorial(TELEOP)
    server = started(teleop[0])
    to_server = heard(server, "server")
    port = server.network["server"].port_in_use
    program = threading.Thread(
        target=page.load("test_client.py").main, args=("127.0.0.1", port), daemon=True
    )
    program.start()
    assert server.network["server"]._link.wait_for_peers(1, WITHIN)
    server.tick(0.0)
    program.join(WITHIN)
    to_server.wait_for(1)
    server.tick(0.1)
    received, answered = page.blocks("text")[2:4]
    assert capsys.readouterr().out == received + answered


async def meet(context, client):
    """Start the other program as soon as the event server listens."""
    while "Examples.EventServer.server" not in context.behaviors:
        await context.clock.sleep(0.1)
    port = context.behaviors["Examples.EventServer.server"].port_in_use
    threading.Thread(target=client, args=("127.0.0.1", port), daemon=True).start()


@pytest.mark.proves("T17", "T20", "T21", "T22", "T23", "W05", "W09")
def test_another_program_orders_photos(tmp_path, monkeypatch, capsys):
    shipped = paths.find("config", "primitive/Examples/EventServer.xml")
    folder = tmp_path / "primitive" / "Examples"
    folder.mkdir(parents=True)
    at_port(shipped, "server", 0, folder)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    page = Tutorial(PRIMITIVE)
    use("simulated", FakeClock())
    try:
        get_task_manager().install(meet, page.load("test_client.py").main)
        page.load("test_event.py").main()
    finally:
        get_task_manager().shutdown()
        use()
    lines = capsys.readouterr().out.splitlines(keepends=True)
    of_client = [line for line in lines if line.startswith("Received: ")]
    assert page.prints("".join(line for line in lines if line not in of_client), 0)
    assert page.prints("".join(of_client), 1)
    assert sorted(path.name for path in tmp_path.glob("*.jpg")) == [
        f"b_{number:03d}.jpg" for number in range(1, 6)
    ]
