"""What holds for every behavior that is declared, whatever it does."""

import pytest

from hri.behavior.network import Network
from hri.behavior.runner import Runner
from hri.behavior.schema import load_schema, schema_of, write_schema
from hri.core import registry
from hri.hal.resource import Description
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import SilentVoice, context

NAMES = registry.known("hri.behaviors")
DEVICES = {
    "camera": "Hri.SimulatedCamera",
    "drive": "Hri.SimulatedDrive",
    "odometry": "Hri.SimulatedOdometry",
    "bumper": "Hri.SimulatedBumper",
    "button": "Hri.SimulatedButton",
    "battery": "Hri.SimulatedBattery",
    "range": "Hri.SimulatedRangeSensor",
    "cliff": "Hri.SimulatedCliffSensor",
    "audio_level": "Hri.AudioLevel",
    "microphone": "Hri.MemoryMicrophone",
    "fed_microphone": "Hri.FedMicrophone",
    "speaker": "Hri.SilentSpeaker",
    "joystick": "Hri.MemoryJoystick",
    "screen": "Hri.OffscreenScreen",
}
PALETTES = {
    "drivers",
    "GUI",
    "vision",
    "util",
    "operators",
    "sample_code",
    "speech",
    "emotion",
    "face",
    "drive",
    "net",
}
PARAMETERS = {
    "Hri.MicrophoneFeed": {"microphone_id": "fed_microphone"},
    "Hri.MalleableBehavior": {"tcp_port": 0},
    "Hri.Share": {"slot": "there"},
    "Hri.Shared": {"slot": "there"},
}


@pytest.fixture
def lent():
    world = Description("world", "Hri.SimulatedWorld", {"voice": "voice"})
    devices = [Description(id, type, bus="world") for id, type in DEVICES.items()]
    made = context(world, *devices)
    for id, cls in (("voice", SilentVoice), ("recognizer", TypedRecognizer)):
        made.resources.substitute(id, cls(Description(id, f"Test.{id}"), made.resources))
    yield made
    made.resources.close()


@pytest.fixture(autouse=True)
def recording(tmp_path, monkeypatch):
    """The player of values has something to play, beside where the recorder writes."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "values.jsonl").write_text('{"t": 0.05, "value": 1}\n')


@pytest.mark.proves("B12", "B19", "P08")
@pytest.mark.parametrize("name", NAMES)
def test_it_survives_ticks_with_empty_inputs_and_a_second_stop(name, lent):
    behavior = registry.find("hri.behaviors", name)("it", **PARAMETERS.get(name, {}))
    network = Network("test", 0.1)
    network.add(behavior)
    network.check()
    runner = Runner(network, lent)
    runner.start()
    try:
        for step in range(12):
            runner.tick(step * 0.1)
        assert runner.statistics.failures == 0
    finally:
        runner.stop()
        runner.stop()


@pytest.mark.proves("B13", "B20")
@pytest.mark.parametrize("name", NAMES)
def test_it_tells_what_it_does_and_what_each_port_and_parameter_is(name):
    cls = registry.find("hri.behaviors", name)
    assert cls.__doc__.split("\n\n")[0].rstrip().endswith(".")
    assert cls.category in PALETTES
    for declared in (*cls.inputs.values(), *cls.outputs.values(), *cls.parameters.values()):
        assert declared.doc, declared.name
    for param in cls.parameters.values():
        assert param.check(param.default) == param.default


@pytest.mark.parametrize("name", NAMES)
def test_its_schema_is_read_back_as_it_was_written(name, tmp_path):
    schema = schema_of(registry.find("hri.behaviors", name))
    path = tmp_path / "schema.xml"
    path.write_text(write_schema(schema))
    assert load_schema(path) == schema


@pytest.mark.proves("B19")
@pytest.mark.parametrize(
    ("name", "inputs", "outputs", "parameters"),
    [
        ("Camera", (), ("raw_image",), ("camera_id",)),
        ("ImageDisplay", ("image",), (), ()),
        ("ObjRecRecognizer", ("image",), ("model_name", "distance"), ("modelset",)),
        ("InputCollector", ("input",), (), ("print_input",)),
        ("PrintBehavior", ("input",), (), ()),
        ("CallbackBehavior", ("input",), (), ()),
        ("Constant", (), ("value",), ("parsed_value",)),
        ("Addition", ("input",), ("sum",), ()),
        ("Subtraction", ("input_positive", "input_negative"), ("difference",), ()),
        ("DriveSystem", ("linear_velocity", "angular_velocity"), (), ("drive_id",)),
        ("RangeSensor", (), ("distance",), ("sensor_id",)),
        ("FuzzyRangeSensorRing", (), ("ranges",), ()),
        ("DoubleArraySplitter", ("array",), ("first", "second", "third", "fourth"), ()),
        ("StopCrash", ("forward_velocity", "range_sensor"), ("velocity",), ("stop_limit",)),
    ],
)
def test_those_of_2003_have_their_names_and_ports(name, inputs, outputs, parameters):
    cls = registry.find("hri.behaviors", f"Evolution.{name}")
    assert set(inputs) <= set(cls.inputs)
    assert set(outputs) <= set(cls.outputs)
    assert set(parameters) <= set(cls.parameters)
