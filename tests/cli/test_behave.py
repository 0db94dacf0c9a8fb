import logging
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import cv2
import pytest

from hri.cli.behave import CATEGORIES, main
from hri.core import paths

NETWORK = """\
<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="show" type="Evolution.InputCollector">
    <Parameter name="print_input" value="true"/>
  </Behavior>
  <Link from="three.value" to="show.input"/>
</BehaviorNetwork>
"""


@pytest.fixture
def network(tmp_path):
    path = tmp_path / "net.xml"
    path.write_text(NETWORK)
    return str(path)


@pytest.mark.proves("B08", "B09", "P13")
def test_it_says_what_the_tool_of_2003_said(network, capsys):
    assert main([network, "--without-resources", "--fast", "--invocation-count=3"]) == 0
    out = capsys.readouterr().out
    lines = out.splitlines()
    assert lines[0] == "Initializing...ok"
    assert re.fullmatch(r"INFO - Loading network file\. \[behave\.py:\d+\]", lines[1])
    running = r"INFO - Running network with an interval of 0\.10 sec\. \[behave\.py:\d+\]"
    assert re.fullmatch(running, lines[2])
    assert out.count("Input show  double: 3\n") == 3


@pytest.mark.proves("B08")
def test_options_may_come_first_and_bound_the_run(network, capsys):
    assert main(["--duration=1", "--invocation-interval=0.25", "--fast", network]) == 0
    assert capsys.readouterr().out.count("double: 3") == 4


@pytest.mark.proves("B08")
@pytest.mark.parametrize(
    "option",
    ["--duration=0.001", "--invocation-interval=0", "--invocation-count=0", "--duration=x"],
)
def test_options_out_of_bounds_are_refused(network, option, capsys):
    with pytest.raises(SystemExit) as error:
        main([network, option])
    assert error.value.code == 2
    assert re.search(r"argument --[a-z-]+: .+", capsys.readouterr().err)


def test_fake_time_needs_an_end(network, capsys):
    assert main([str(network), "--fast"]) == 2
    assert "add --duration S" in capsys.readouterr().err


def test_a_missing_network_is_one_line(capsys):
    assert main(["nowhere.xml", "--without-resources"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


@pytest.fixture(autouse=True)
def usual_logging():
    """`behave` is a program of its own, and sets up the logging of the process."""
    yield
    logging.getLogger("hri").handlers.clear()
    for name in ("hri", "hri.network", "hri.behavior"):
        logging.getLogger(name).setLevel(logging.NOTSET)


@pytest.mark.proves("B08", "P13")
def test_debug_tells_links_ticks_and_timings(network, capsys):
    options = ["--without-resources", "--fast", "--invocation-count=2"]
    assert main([network, "--debug", *options]) == 0
    out = capsys.readouterr().out
    assert re.search(r"DEBUG - link three\.value -> show\.input \(\w+\) \[network\.py:\d+\]", out)
    assert len(re.findall(r"DEBUG - net tick at \d\.\d+ s took", out)) == 2
    assert re.search(r"DEBUG - show: 2 times, ", out)


@pytest.mark.proves("B08", "P13")
def test_debug_of_one_category_tells_of_nothing_else(network, capsys):
    main([network, "--debug=network", "--without-resources", "--fast", "--invocation-count=2"])
    out = capsys.readouterr().out
    assert "DEBUG - link" in out
    assert "DEBUG - net tick" not in out


@pytest.mark.proves("H23")
def test_resources_open_only_when_needed_or_all_when_asked(network, tmp_path, capsys):
    config = tmp_path / "config.xml"
    missing = '<Device id="ear" type="Hri.WavMicrophone"><Parameter name="file" value="no.wav"/>'
    config.write_text(f"<Resources><Devices>{missing}</Device></Devices></Resources>")
    options = ["--fast", "--invocation-count=1", f"--config={config}"]
    assert main([network, *options]) == 0
    assert main([network, "--load-all-resources", *options]) == 2
    assert "no.wav" in capsys.readouterr().err
    assert main([network, "--load-all-resources", "--without-resources", *options]) == 0


def test_an_endless_file_is_refused(capsys):
    assert main(["/dev/zero", "--without-resources"]) == 2
    assert "not a regular file" in capsys.readouterr().err


def test_it_imports_nothing_heavy(network):
    code = (
        "import sys; from hri.cli.behave import main;"
        f"main([{network!r}, '--without-resources', '--fast', '--invocation-count=1']);"
        "heavy = {'cv2', 'pygame', 'vosk', 'matplotlib', 'PIL', 'sounddevice', 'pocketsphinx'};"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


STOPPED = '''
from hri.behavior.behavior import Behavior

class Stopped(Behavior):
    """Tells when it is stopped."""

    def compute(self, now, dt):
        pass

    def stop(self):
        print("stopped")
'''


@pytest.mark.proves("B08")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_stops_its_behaviors_and_ends_it_cleanly(number, network, tmp_path):
    folder = tmp_path / "behavior" / "Mine"
    folder.mkdir(parents=True)
    (folder / "stopped.py").write_text(STOPPED)
    schema = '<BehaviorSchema type="Mine.Stopped" driver="Mine.Stopped" library="stopped.py"/>'
    (folder / "Stopped.xml").write_text(schema)
    more = '<Behavior id="stopped" type="Mine.Stopped"/></BehaviorNetwork>'
    Path(network).write_text(NETWORK.replace("</BehaviorNetwork>", more))
    command = [sys.executable, "-u", "-m", "hri.cli.behave", network, "--without-resources"]
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "HRI_PATH": str(tmp_path)},
    ) as process:
        for line in process.stdout:
            if line.startswith("Input"):
                break
        process.send_signal(number)
        out, err = process.communicate(timeout=20)
        assert process.returncode == 0
        assert re.fullmatch(r"behave: \d+ ticks? in .* s, .*\n", err)
        assert out.splitlines()[-1] == "stopped"


def test_realtime_runs_and_says_in_a_line_when_it_may_not(tmp_path):
    path = tmp_path / "net.xml"
    path.write_text(NETWORK)
    code = (
        "import os; os.sched_setscheduler = refuse = lambda *a: (_ for _ in ()).throw("
        "PermissionError(1, 'Operation not permitted'));"
        f"from hri.cli.behave import main; main([{str(path)!r}, '--without-resources',"
        "'--realtime', '--invocation-count=2', '--invocation-interval=0.01'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    refusals = [line for line in done.stdout.splitlines() if "real-time" in line]
    assert len(refusals) == 1
    assert "rtprio" in refusals[0]
    assert done.stdout.count("double: 3") == 2


def test_it_ends_with_a_line_of_what_happened_and_draws_an_output(
    network, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    words = [network, "--without-resources", "--fast", "--invocation-count=3"]
    assert main([*words, "--plot", "three.value"]) == 0
    out = capsys.readouterr()
    assert out.err == "behave: 3 ticks in 0.2 s, none missed, no failures\n"
    assert out.out.endswith("net-three.value.png\n")
    assert cv2.imread("net-three.value.png").shape == (400, 1000, 3)


@pytest.mark.parametrize(
    ("port", "told"),
    [
        ("three", "write a behavior and its output"),
        ("three.valu", 'did you mean "value"?'),
        ("four.value", 'no behavior "four" - known are: show, text, three'),
        ("text.value", "it sent str, which is not a number"),
    ],
)
def test_what_cannot_be_drawn_is_one_line(port, told, network, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "net.xml"
    word = '<Parameter name="parsed_value" value="&quot;a&quot;"/>'
    text = f'<Behavior id="text" type="Hri.Constant">{word}</Behavior>'
    path.write_text(path.read_text().replace("<Link", text + "<Link"))
    words = [network, "--without-resources", "--fast", "--invocation-count=3"]
    assert main([*words, "--plot", port]) == 2
    assert told in capsys.readouterr().err


def test_a_category_that_is_not_there_is_refused_with_those_that_are(network, capsys):
    assert main([network, "--debug=netwrok", "--without-resources", "--fast", "--duration=1"]) == 2
    assert 'no category "netwrok" - did you mean "network"?' in capsys.readouterr().err


def test_every_part_that_writes_a_log_is_a_category():
    source = "".join(path.read_text() for path in (paths.house() / "hri").rglob("*.py"))
    assert set(re.findall(r'getLogger\("hri\.(\w+)"\)', source)) == set(CATEGORIES)
