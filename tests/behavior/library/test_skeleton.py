from pathlib import Path

import pytest

from hri.behavior.library import skeleton
from hri.behavior.network_file import load_network
from hri.behavior.runner import Runner
from hri.testing import context

SCHEMA = """\
<BehaviorSchema type="My.Doubler" driver="My.DoublerBehavior" display_name="Doubler"
                library="doubler.py" category="sample_code">
  <Parameter name="gain" type="number" default="2"/>
  <Inputs>
    <Port name="input" datatype="double" description="a number"/>
  </Inputs>
  <Outputs>
    <Port name="output" datatype="double" description="twice the number"/>
  </Outputs>
</BehaviorSchema>
"""
NETWORK = """\
<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="twice" type="My.Doubler"/>
  <Behavior id="show" type="Hri.InputCollector"/>
  <Link from="three.value" to="twice.input"/>
  <Link from="twice.output" to="show.input"/>
</BehaviorNetwork>
"""


@pytest.mark.proves("B14", "B15")
def test_a_renamed_copy_of_the_skeleton_runs_in_a_network(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "behavior" / "My"
    folder.mkdir(parents=True)
    copied = Path(skeleton.__file__).read_text().replace("Skeleton", "Doubler")
    (folder / "doubler.py").write_text(copied)
    (folder / "Doubler.xml").write_text(SCHEMA)
    (tmp_path / "net.xml").write_text(NETWORK)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    runner = Runner(load_network(tmp_path / "net.xml"), context())
    runner.start()
    runner.tick(0.0)
    runner.stop()
    assert capsys.readouterr().out == "Input show  double: 6\n"
