import re

import pytest

from hri.cli.behave import main

NETWORK = """\
<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="show" type="Evolution.InputCollector"/>
  <Link from="three.value" to="show.input"/>
</BehaviorNetwork>
"""


@pytest.fixture
def network(tmp_path):
    path = tmp_path / "net.xml"
    path.write_text(NETWORK)
    return str(path)


def test_it_says_what_the_tool_of_2003_said(network, capsys):
    assert main([network, "--without-resources", "--fast", "--invocation-count=3"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Initializing...ok\n")
    assert out.count("Input show  double: 3\n") == 3


def test_options_may_come_first_and_bound_the_run(network, capsys):
    assert main(["--duration=1", "--invocation-interval=0.25", "--fast", network]) == 0
    assert capsys.readouterr().out.count("double: 3") == 4


@pytest.mark.parametrize(
    "option",
    ["--duration=0.001", "--invocation-interval=0", "--invocation-count=0", "--duration=x"],
)
def test_options_out_of_bounds_are_refused(network, option, capsys):
    with pytest.raises(SystemExit) as error:
        main([network, option])
    assert error.value.code == 2
    assert re.search(r"argument --[a-z-]+: .+", capsys.readouterr().err)


def test_a_missing_network_is_one_line(capsys):
    assert main(["nowhere.xml", "--without-resources"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
