"""How programs end: their readers gone, files that cannot be written, Ctrl-C at any moment."""

import errno
import subprocess
import sys
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.cli.terminal.exit_status import status_of
from hri.core.errors import HriError

NETWORK = """\
<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant"/>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="show.input"/>
</BehaviorNetwork>
"""


@pytest.fixture
def network(tmp_path):
    path = tmp_path / "net.xml"
    path.write_text(NETWORK)
    return str(path)


@pytest.mark.parametrize(
    "words",
    [
        ["network", "draw", "--out", "{folder}/gone/x.svg"],
        ["network", "draw", "--out", "{folder}/gone/x.png"],
        ["schema", "export", "Hri.Addition", "--to", "{folder}/net.xml"],
    ],
)
def test_a_file_that_cannot_be_written_is_one_line(words, network, tmp_path, capsys):
    filled = [word.format(folder=tmp_path) for word in words]
    if filled[0] == "network":
        filled.insert(2, network)
    assert main(filled) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(str(tmp_path))
    assert line.endswith("- check the path")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no full device")
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--help"], "cannot be written: No space left on device - make room\n"),
        (["voices"], "cannot be written: No space left on device - make room\n"),
        (["say", "hello", "--wav", "/dev/full"], "/dev/full: cannot be written: No space left"),
    ],
)
def test_a_full_disk_is_one_line(words, told):
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "hri.cli.main", *words]
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True)
    assert ended.returncode == 2
    assert ended.stderr.startswith(told)
    assert ended.stderr.count("\n") == 1


PROGRAMS = {
    "behave": ["{network}", "--without-resources", "--fast", "--invocation-count=1000000"],
    "diagnostics.range_sensor": ["--fast", "--read-count=1000000"],
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_program_whose_reader_has_gone_ends_quietly(name, network):
    options = [option.format(network=network) for option in PROGRAMS[name]]
    command = [sys.executable, "-m", f"hri.cli.{name}", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.readline()
        process.stdout.close()
        assert process.wait(timeout=60) == 0
        assert process.stderr.read() == b""


INTERRUPTED = """\
import signal, sys

class Interrupter:
    def find_spec(self, name, *_):
        if name == {module!r}:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Interrupter())
from hri.cli.{programs} import {program}
sys.exit({program}({arguments}))
"""


@pytest.mark.proves("B08")
@pytest.mark.parametrize("module", ["hri.cli.behave", "trio", "hri.behavior.library.constant"])
def test_ctrl_c_while_behave_is_still_being_loaded_ends_it_quietly(module, network):
    arguments = [network, "--without-resources"]
    code = INTERRUPTED.format(
        module=module, programs="programs", program="behave", arguments=arguments
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=60)
    assert (done.returncode, done.stderr) == (130, b"")


def test_ctrl_c_while_a_command_is_still_being_loaded_ends_it_quietly():
    code = INTERRUPTED.format(
        module="hri.cli.soak", programs="main", program="main", arguments=["soak"]
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=60)
    assert (done.returncode, done.stderr) == (130, b"")


def failing(error):
    def program():
        raise error

    return program


def test_an_error_of_the_user_is_one_line_also_out_of_the_robot_loop(capsys):
    refused = HriError("it is wrong - mend it")
    for error in (refused, ExceptionGroup("loop", [ExceptionGroup("inner", [refused])])):
        assert status_of(failing(error)) == 2
        assert capsys.readouterr().err == "it is wrong - mend it\n"
    assert status_of(failing(BaseExceptionGroup("loop", [KeyboardInterrupt()]))) == 130


@pytest.mark.parametrize(
    "error",
    [
        ValueError("ours"),
        OSError(errno.EIO, "no file has to do with it"),
        ExceptionGroup("two", [HriError("one"), HriError("two")]),
    ],
)
def test_a_mistake_of_ours_keeps_its_traceback(error):
    with pytest.raises(type(error)):
        status_of(failing(error))
