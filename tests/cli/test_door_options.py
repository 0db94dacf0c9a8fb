"""What comes into a program that serves: said on its command line, never by a network file."""

import re
import subprocess
from contextlib import suppress

import pytest

from hri.behavior.doors import NAMES_OF_2003, Doors
from hri.cli import behave
from hri.cli.main import main
from hri.core import child, paths
from hri.core.clock import FakeClock
from hri.core.token import VARIABLE, new_token
from hri.hal.configuration import load_configuration
from hri.net.connection import Connection
from hri.net.malleable import BIND
from hri.robot import Robot

PATIENCE = 60
SCHEMA = """\
<BehaviorSchema type="My.Steering" driver="Hri.MalleableBehavior">
  <Parameter name="tag_name" type="string" default="steering"/>
  <Outputs><Port name="velocity" datatype="double"/></Outputs>
</BehaviorSchema>"""
NETWORK = """\
<BehaviorNetwork name="steered" invocation_interval="0.05">
  <Behavior id="steering" type="My.Steering"><Parameter name="tcp_port" value="0"/>{more}</Behavior>
  <Behavior id="drive" type="Hri.DriveSystem"/>
  <Behavior id="odometry" type="Hri.Odometry"/>
  <Behavior id="pose" type="Hri.PrintBehavior"/>
  <Link from="steering.velocity" to="drive.linear_velocity"/>
  <Link from="odometry.pose" to="pose.input"/>
</BehaviorNetwork>"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A folder with a network that is steered over the bridge, and a state of its own."""
    (tmp_path / "behavior" / "My").mkdir(parents=True)
    (tmp_path / "behavior" / "My" / "Steering.xml").write_text(SCHEMA)
    (tmp_path / "steered.xml").write_text(NETWORK.format(more=""))
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    for name in (VARIABLE, BIND):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


def driven(folder, token, *options):
    """How far a base gets, in m, while a program that shows this token tells it to drive."""
    words = ("-u", "-m", "hri.cli.behave", folder / "steered.xml", "--config", "simulated")
    command = child.command(*words, *options)
    environment = child.environment(HRI_PATH=str(folder))
    with (
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process,
        suppress(StopIteration),
    ):
        lines = iter(process.stdout)
        port = next(
            found for found in map(re.compile(r"listening on \S+:(\d+)").search, lines) if found
        )
        poses = filter(None, map(re.compile(r"^x (\S+), y").match, lines))
        try:
            with Connection(port=int(port[1]), timeout=PATIENCE, token=token) as peer:
                for _ in range(30):
                    peer.send("<steering><velocity>20</velocity></steering>")
                    way = float(next(poses)[1])
        finally:
            process.kill()  # else a test that failed would wait for it without end
        return way


@pytest.mark.slow
def test_no_local_program_drives_the_base_without_the_token(folder):
    assert driven(folder, "") == 0


@pytest.mark.slow
@pytest.mark.parametrize("options", [(), ("--trusted", "steering")], ids=["token", "trusted"])
def test_who_shows_it_or_is_trusted_does(folder, options):
    assert driven(folder, "" if options else new_token(), *options) > 0.01


@pytest.mark.parametrize(
    ("trusted", "meant"),
    [("steerin", "steering"), ("steering.velocty", "steering.velocity"), ("arm.*", None)],
)
def test_a_trusted_name_that_fits_no_port_is_told_with_what_was_meant(
    trusted, meant, folder, capsys
):
    words = [str(folder / "steered.xml"), "--config", "simulated", "--fast", "--duration=0.2"]
    assert behave.main([*words, "--trusted", trusted, "--trusted=steering", "--trusted=*"]) == 0
    (line,) = (o for o in capsys.readouterr().out.splitlines() if "trusted" in o)
    assert f'trusted "{trusted}": these networks have no such port on the bridge' in line
    assert f'did you mean "{meant}"?' in line or meant is None


def test_a_robot_tells_of_it_too(folder):
    app = folder / "apps" / "mine"
    app.mkdir(parents=True)
    (app / "app.toml").write_text('networks = ["steered.xml"]\ntrusted = ["steerin"]\n')
    (app / "steered.xml").write_text(NETWORK.format(more=""))
    told = []
    doors = Doors(trusted=("stearing",))
    Robot(str(app), "simulated", clock=FakeClock(), doors=doors, notice=told.append).close()
    assert [line.split(":")[0] for line in told] == ['trusted "stearing"', 'trusted "steerin"']


@pytest.mark.parametrize("by", ["file", "environment"])
def test_a_network_alone_opens_nothing_to_other_machines(by, folder, monkeypatch, capsys):
    if by == "file":
        more = '<Parameter name="bind" value="0.0.0.0"/>'
        (folder / "steered.xml").write_text(NETWORK.format(more=more))
    else:
        monkeypatch.setenv(BIND, "0.0.0.0")
    words = [str(folder / "steered.xml"), "--config", "simulated", "--fast", "--duration=0.2"]
    assert behave.main(words) != 0
    (line,) = capsys.readouterr().err.splitlines()
    assert "lets other machines in - start it with --allow-remote" in line
    assert behave.main([*words, "--allow-remote"]) == 0


@pytest.mark.parametrize("command", ["run", "companion"])
def test_every_command_that_serves_has_the_options(command, capsys):
    with pytest.raises(SystemExit):
        main([command, "--help"])
    said = capsys.readouterr().out
    assert "--allow-remote" in said
    assert "--trusted" in said


def test_the_resource_configuration_and_the_app_may_trust(folder):
    simulated = paths.find("config", "simulated").read_text()
    config = folder / "trusting.xml"
    config.write_text(simulated.replace("<Resources>", '<Resources trusted="steering other.port">'))
    assert load_configuration(config).trusted == ("steering", "other.port")
    app = folder / "apps" / "mine"
    app.mkdir(parents=True)
    (app / "app.toml").write_text(
        'networks = []\ntrusted = ["arm.*"]\nevents = ["door.*"]\n', encoding="utf-8"
    )
    robot = Robot(str(app), str(config), clock=FakeClock(), doors=Doors(trusted=("cli",)))
    try:
        doors = robot.tasks.context.networks.context.doors
        assert doors == Doors(False, ("cli", "arm.*"), (*NAMES_OF_2003, "door.*"))
        assert robot.resources.trusted == ("steering", "other.port")
    finally:
        robot.close()


def test_the_options_reach_the_robot(monkeypatch, folder):
    got = []
    monkeypatch.setattr("hri.cli.run.Robot", lambda *_, doors, **__: got.append(doors) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main(["run", "companion", "--headless", "--allow-remote", "--trusted=a", "--trusted=b.c"])
    assert got == [Doors(True, ("a", "b.c"))]
