import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior, type_of
from hri.behavior.network_file import load_network
from hri.behavior.schema import schema_of
from hri.core import registry
from hri.core.errors import AuthoringError, HriError

WAVE = '''
from hri.behavior.behavior import Behavior
from hri.behavior.ports import Output, Param


class Wave(Behavior):
    """Goes up and down."""

    height = Param(1.0, "how far", minimum=0)
    output = Output[float]("double", "a number")

    def compute(self, now, dt):
        self.output.send(self.height)
'''


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("EVOLUTION_CONFIG_PATH", f"{tmp_path}/first:{tmp_path}/second")
    monkeypatch.delenv("HRI_PATH", raising=False)
    return tmp_path


def write(folder, name, driver="Hri.Constant", library="", body="", type_name=None):
    path = folder / "behavior" / f"{name.replace('.', '/')}.xml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        f'<BehaviorSchema type="{type_name or name}" driver="{driver}" library="{library}">'
        f"{body}</BehaviorSchema>"
    )
    return path


@pytest.mark.proves("P09", "B14")
def test_the_first_folder_with_a_schema_wins(folder):
    for place, value in (("first", "1"), ("second", "2")):
        parameter = f'<Parameter name="parsed_value" default="{value}"/>'
        write(folder / place, "Mine.Number", body=parameter)
    assert find_behavior("Mine.Number")("n").parsed_value == "1"
    (folder / "first/behavior/Mine/Number.xml").unlink()
    assert find_behavior("Mine.Number")("n").parsed_value == "2"


@pytest.mark.proves("P09")
def test_a_missing_schema_names_the_folders_that_were_searched(folder):
    with pytest.raises(HriError) as error:
        find_behavior("Examples.Nowhere")
    message = str(error.value)
    assert 'unknown behavior type "Examples.Nowhere"' in message
    assert "behavior/Examples/Nowhere.xml" in message
    assert f"{folder}/first, {folder}/second" in message


def test_no_name_leads_out_of_the_folders(folder):
    for name in ("../secret", "A./etc/passwd", "Constant", "A..B", "A.B\n"):
        with pytest.raises(HriError, match="is not a behavior type"):
            find_behavior(name)


@pytest.mark.proves("B14")
def test_a_python_file_beside_the_schema_brings_its_own_class(folder):
    write(folder / "first", "Mine.Wave", "Mine.Wave", "../../wave.py")
    (folder / "first/wave.py").write_text(WAVE)
    network = folder / "net.xml"
    network.write_text(
        '<BehaviorNetwork><Behavior id="w" type="Mine.Wave">'
        '<Parameter name="height" value="pi"/></Behavior></BehaviorNetwork>'
    )
    wave = load_network(network)["w"]
    assert type_of(wave) == "Mine.Wave"
    assert wave.height == pytest.approx(3.14159, abs=1e-5)
    assert schema_of(type(wave)).library == "../../wave.py"
    assert [port.name for port in schema_of(type(wave)).outputs] == ["output"]


@pytest.mark.parametrize(
    ("options", "code", "message"),
    [
        ({"driver": "Hri.Constnt"}, WAVE, 'unknown driver "Hri.Constnt" - did you mean'),
        ({"driver": "Mine.Wav", "library": "wave.py"}, WAVE, 'did you mean "Wave"'),
        ({"driver": "Mine.Wave", "library": "gone.py"}, WAVE, "no Python file is there"),
        ({"driver": "Mine.Wave", "library": "wave.py"}, "class Wave: pass", "is not a Behavior"),
        ({"driver": "Mine.Wave", "library": "wave.py"}, "1 / 0", "division by zero"),
        ({"driver": "Mine.Wave", "library": "wave.py"}, "class Wave(:", "wave.py:1:"),
        ({"driver": "Mine.Quux", "library": "./libQuux.so"}, WAVE, "write its class in Python"),
        ({"type_name": "Mine.Other"}, WAVE, 'the schema of "Mine.Other"'),
        (
            {
                "driver": "Mine.Wave",
                "library": "wave.py",
                "body": '<Inputs><Port name="x" datatype="double"/></Inputs>',
            },
            WAVE,
            'Wave has no input "x"',
        ),
    ],
)
def test_what_is_wrong_with_a_schema_is_told_with_its_file(folder, options, code, message):
    path = write(folder / "first", "Mine.Wave", **options)
    (path.parent / "wave.py").write_text(code)
    with pytest.raises(HriError) as error:
        find_behavior("Mine.Wave")
    assert message in str(error.value)


def test_a_network_names_the_schema_file_that_is_wrong(folder):
    write(folder / "first", "Mine.Wave", "Hri.Nothing")
    network = folder / "net.xml"
    network.write_text('<BehaviorNetwork><Behavior id="w" type="Mine.Wave"/></BehaviorNetwork>')
    with pytest.raises(AuthoringError, match=r"Mine/Wave\.xml:1:1: unknown driver"):
        load_network(network)


def refusal(folder, driver, body):
    write(folder / "first", "Mine.Thing", driver, body=body)
    with pytest.raises(AuthoringError) as error:
        find_behavior("Mine.Thing")
    return str(error.value).partition("Thing.xml:")[2]


@pytest.mark.parametrize("name", ["id", "tag_name", "port_in_use", "_inbox", "compute"])
def test_a_port_may_not_have_a_name_that_its_driver_uses(folder, name):
    body = f'\n<Inputs>\n<Port name="{name}" datatype="double"/></Inputs>'
    assert refusal(folder, "Hri.MalleableBehavior", body).startswith("3:")


def test_a_parameter_may_not_have_the_name_of_something_else(folder):
    assert 'has no parameter "input"' in refusal(
        folder, "Hri.Addition", '<Parameter name="input" type="number" default="1"/>'
    )


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (
            '<Inputs>\n<Port name="inputt" datatype="double"/></Inputs>',
            '2:1: Addition has no input "inputt" - did you mean "input"?',
        ),
        (
            '<Inputs>\n<Port name="input" datatype="string"/></Inputs>',
            '2:1: the input "input" of Addition is double - write datatype="double"',
        ),
        (
            '<Outputs>\n<Port name="sum" datatype="any"/></Outputs>',
            '2:1: the output "sum" of Addition is double - write datatype="double"',
        ),
        (
            '\n<Parameter name="gain" type="number" default="1"/>',
            '2:1: Addition has no parameter "gain"',
        ),
    ],
)
def test_a_schema_may_promise_only_what_its_driver_has(folder, body, message):
    assert refusal(folder, "Hri.Addition", body).startswith(message)


def test_a_schema_may_narrow_a_port_that_takes_anything(folder):
    port = '<Inputs><Port name="input" datatype="string"/></Inputs>'
    write(folder / "first", "Mine.Show", "Hri.InputCollector", body=port)
    assert find_behavior("Mine.Show").inputs["input"].datatype == "string"


@pytest.mark.parametrize(
    ("default", "remedy"),
    [('type="string" default="abc"', "write a number"), ('default="70000"', "from 0 to 65535")],
)
def test_a_default_that_does_not_fit_its_driver_is_told_where_it_stands(folder, default, remedy):
    body = f'\n<Parameter name="tcp_port" {default}/>'
    message = refusal(folder, "Hri.MalleableBehavior", body)
    assert message.startswith("2:1: tcp_port: ")
    assert remedy in message


def test_a_library_that_ends_the_program_is_told_each_time(folder):
    path = write(folder / "first", "Mine.Wave", "Mine.Wave", "wave.py")
    (path.parent / "wave.py").write_text("import sys\nsys.exit(3)")
    for _ in range(2):
        with pytest.raises(AuthoringError, match=r"wave\.py: it ends the program"):
            find_behavior("Mine.Wave")


def test_of_a_library_whose_import_was_interrupted_no_half_is_left(folder):
    path = write(folder / "first", "Mine.Wave", "Mine.Wave", "wave.py")
    (path.parent / "wave.py").write_text("raise KeyboardInterrupt")
    with pytest.raises(KeyboardInterrupt):
        find_behavior("Mine.Wave")
    (path.parent / "wave.py").write_text(WAVE)
    assert find_behavior("Mine.Wave")("w").height == 1.0


@pytest.mark.parametrize(
    ("theirs", "ours"),
    [
        ("Evolution.SpeechLevel", "Hri.MicrophoneLevel"),
        ("Evolution.Listener", "Hri.Recognizer"),
        ("Examples.PrintBehavior", "Hri.PrintBehavior"),
        ("Examples.SkeletonBehavior", "Hri.SkeletonBehavior"),
        ("Examples.StopCrash", "Hri.StopCrash"),
    ],
)
def test_second_names_are_understood_with_either_prefix(theirs, ours):
    assert find_behavior(theirs) is find_behavior(ours)


def test_every_second_name_is_understood_as_evolution_too():
    for name in registry.ALIASES:
        evolution = name.replace("Hri.", "Evolution.")
        assert registry.canonical(evolution) == registry.canonical(name)


def test_a_parameter_may_be_set_to_a_text_as_files_write_it():
    behavior = find_behavior("Hri.StopCrash")("stop")
    behavior.set_parameter("stop_limit", "2*30")
    assert behavior.stop_limit == 60.0
    with pytest.raises(HriError, match=r"stop.stop_limit: .*write a number"):
        behavior.set_parameter("stop_limit", "far")


def test_a_behavior_needs_no_docstring():
    class Bare(Behavior):
        def compute(self, now, dt):
            pass

    assert schema_of(Bare).type == "Bare"


def test_constant_is_in_the_palette_where_it_was():
    assert find_behavior("Evolution.Constant").category == "util"
