"""The tutorials of resources, run on fake time in simulated rooms."""

import math
import re

import pytest

from hri.core.clock import FakeClock
from hri.hal.configuration import load_configuration
from hri.hal.drive import DriveSystem, Odometry
from hri.hal.drivers.image_size import picture_size
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld
from tests.docs.tutorial import Tutorial

NOTHING = "1.79769e+308"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """Where the programs run."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("HRI_PATH", raising=False)
    return tmp_path


@pytest.mark.parametrize(
    ("name", "additions"),
    [
        ("resource-01-config-camera", 1),  # what the reader adds to the configuration
        ("resource-02-config-ir", 0),
        ("resource-03-camera", 0),
        ("resource-04-drive-system", 0),
        ("resource-05-custom-driver", 0),
    ],
)
def test_excerpts_are_those_of_the_files(name, additions):
    tutorial = Tutorial(name)
    assert tutorial.strangers("python") == []
    assert len(tutorial.strangers("xml")) == additions


def edited(tutorial, folder, *edits):
    """The configuration of a tutorial with some texts replaced, in a folder with its world."""
    text = (tutorial.folder / "resource-config.xml").read_text()
    for old, new in edits:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    for world in tutorial.folder.glob("*.toml"):
        (folder / world.name).write_text(world.read_text())
    path = folder / "resource-config.xml"
    path.write_text(text)
    return path


# --- 01-config-camera ---


@pytest.mark.proves("D05", "H16", "H17")
def test_the_photos_are_as_large_as_the_spec_says_then_as_the_configuration_does(folder, capsys):
    tutorial = Tutorial("resource-01-config-camera")
    program = tutorial.load("take_photo.py")
    assert program.main("--fast") == 0
    assert tutorial.prints(capsys.readouterr().out)
    assert sizes(folder) == [(320, 240)] * 5

    device, with_size = tutorial.blocks("xml")[0].strip(), tutorial.strangers("xml")[0].strip()
    program.CONFIGURATION = edited(tutorial, folder, (device, with_size))
    assert program.main("--fast") == 0
    assert sizes(folder) == [(640, 480)] * 5


@pytest.mark.proves("D04")
def test_a_misspelt_parameter_is_told_with_its_place_and_the_right_spelling(folder, capsys):
    tutorial = Tutorial("resource-01-config-camera")
    program = tutorial.load("take_photo.py")
    device, with_size = tutorial.blocks("xml")[0].strip(), tutorial.strangers("xml")[0].strip()
    misspelt = with_size.replace("hres", "hers")
    program.CONFIGURATION = edited(tutorial, folder, (device, misspelt))
    assert program.main("--fast") == 2
    told = capsys.readouterr().err
    assert re.search(r'resource-config\.xml:7:\d+: .*"hers" - did you mean "hres"', told)
    assert sizes(folder) == []


def sizes(folder):
    return [picture_size(path) for path in sorted(folder.glob("camera0_00?.jpg"))]


# --- 02-config-ir ---

TO_THE_LEFT = ('name="yaw" value="0"', 'name="yaw" value="pi/4"')
ASIDE = (
    'value="20"/>\n        <Parameter name="y" value="0"',
    'value="20"/>\n        <Parameter name="y" value="10"',
)
LONGER = ('name="lx" value="48"', 'name="lx" value="68"')
WITH_A_CART = ('name="x" value="0"', 'name="x" value="-10"')


@pytest.fixture
def measure(folder, capsys):
    """Runs test_ir.py after some edits; what each side measures first."""
    tutorial = Tutorial("resource-02-config-ir")
    program = tutorial.load("test_ir.py")

    def run(*edits):
        program.CONFIGURATION = edited(tutorial, folder, *edits)
        assert program.main("--fast", "--invocation-count=1") == 0
        lines = re.findall(r"Input (\w+)  double: (\S+)", capsys.readouterr().out)
        return {side: float(value) for side, value in lines if value != NOTHING}

    return run


@pytest.mark.proves("B22", "D05")
def test_the_ring_prints_what_the_page_shows(capsys):
    tutorial = Tutorial("resource-02-config-ir")
    assert tutorial.load("test_ir.py").main("--fast", "--invocation-count=2") == 0
    assert tutorial.prints(capsys.readouterr().out)


@pytest.mark.proves("B21", "B22", "H05")
@pytest.mark.parametrize(
    ("edits", "measured"),
    [
        ([], {"front": 26.0}),
        ([TO_THE_LEFT], {"front": math.hypot(26, 11)}),
        ([TO_THE_LEFT, ASIDE], {"front": math.hypot(26, 21), "left": math.hypot(26, 21)}),
        ([LONGER], {"front": 16.0}),
        ([LONGER, WITH_A_CART], {"front": 26.0}),
    ],
)
def test_where_the_sensor_sits_and_how_large_the_robot_is_decides(measure, edits, measured):
    # A reading is off by 1 %: 0.3 to 0.4 cm.
    assert measure(*edits) == pytest.approx(measured, abs=1.2)


@pytest.mark.proves("H02")
def test_the_page_tells_these_values():
    page = Tutorial("resource-02-config-ir").page
    rows = re.findall(r"^\| (?:sensor|shape): .*", page, re.MULTILINE)
    told = [[int(cell) for cell in row.split("|") if cell.strip().isdigit()] for row in rows]
    assert told == [[28], [33, 33], [16], [26]]


# --- 03-camera ---


@pytest.mark.proves("H24")
def test_the_program_writes_one_picture(folder, capsys):
    tutorial = Tutorial("resource-03-camera")
    tutorial.load("camera.py").main(FakeClock())
    printed = capsys.readouterr().out
    assert printed == "Wrote image camera_image.jpg.\n"
    assert tutorial.prints(printed)
    assert picture_size(folder / "camera_image.jpg") == (320, 240)


# --- 04-drive-system ---


@pytest.fixture
def drive_about():
    return Tutorial("resource-04-drive-system").load("drive_system.py").drive_about


@pytest.fixture
def resources():
    with ResourceManager.load("resource-config", FakeClock()) as resources:
        yield resources


def test_the_program_prints_what_the_page_shows(capsys):
    tutorial = Tutorial("resource-04-drive-system")
    tutorial.load("drive_system.py").main(FakeClock())
    assert tutorial.prints(capsys.readouterr().out)


@pytest.mark.proves("H25", "H26")
def test_the_base_does_each_command(drive_about, resources, capsys, monkeypatch):
    drive, odometry = resources.obtain("drive", DriveSystem), resources.obtain("odometry", Odometry)
    clock, before, times = resources.clock, {}, {}

    def note(text, **_):
        now = clock.now()
        before[text.strip()], times[text.strip()] = (
            (odometry.pose(now), odometry.velocity(now)),
            now,
        )

    monkeypatch.setitem(drive_about.__globals__, "print", note)
    drive_about(drive, clock)
    end = odometry.velocity(clock.now())

    moved, turned = before["Turn to the left."][0], before["Free turning."][0]
    assert (moved.x, moved.heading) == pytest.approx((0.5, 0.0), abs=0.005)
    assert turned.heading == pytest.approx(math.pi / 2, abs=0.02)
    # Three seconds later it still turns, though nothing was asked since.
    assert before["Stop smooth."][1].angular == pytest.approx(-math.pi / 6, abs=0.01)
    assert before["Free moving backward."][1].angular == pytest.approx(0.0, abs=0.01)
    assert before["Stop abrupt."][1].linear == pytest.approx(-0.15, abs=0.005)
    smoothly = times["Free moving backward."] - times["Stop smooth."]
    abruptly = times["Moving and turning to the right at the same time."] - times["Stop abrupt."]
    assert smoothly > 1.5 * abruptly
    stood = before["Moving and turning to the right at the same time."][1]
    assert stood.linear == pytest.approx(0.0, abs=0.005)
    arc = before["Stop using move and turn."][1]
    assert (arc.linear, arc.angular) == pytest.approx((0.2, -math.pi / 6), abs=0.01)
    assert (end.linear, end.angular) == pytest.approx((0.0, 0.0), abs=0.005)


@pytest.mark.proves("H29")
def test_idle_power_holds_the_robot_until_the_program_ends(drive_about, resources):
    world, drive = resources.obtain("world", SimulatedWorld), resources.obtain("drive", DriveSystem)
    clock = resources.clock
    pushes = []

    def push():
        start = world.base.pose
        world.push(0.1, clock.now())
        pushes.append(math.dist((start.x, start.y), (world.base.pose.x, world.base.pose.y)))

    push()
    world.push(-0.1, clock.now())
    clock.call_at(clock.now() + 2.0, push)  # within the five seconds for trying
    drive_about(drive, clock)
    resources.release(drive)
    push()
    assert pushes == pytest.approx([0.1, 0.0, 0.1], abs=1e-6)


# --- 05-custom-driver ---


@pytest.fixture
def stream_tutorial(monkeypatch):
    tutorial = Tutorial("resource-05-custom-driver")
    monkeypatch.syspath_prepend(tutorial.folder)
    monkeypatch.setenv("HRI_PATH", str(tutorial.folder))
    return tutorial


@pytest.mark.proves("H16", "H21", "H22")
def test_a_driver_of_ones_own_is_found_through_its_spec(stream_tutorial, folder):
    program = stream_tutorial.load("tutorial_test.py")
    for _ in range(2):
        program.main(FakeClock())
    assert (folder / "output.txt").read_text() == "Testing"
    device = load_configuration(stream_tutorial.folder / "resource-config.xml").devices[0]
    assert device.library is not None
    assert device.library.resolve() == stream_tutorial.folder / "file_stream.py"


@pytest.mark.proves("H16", "H22")
def test_what_the_configuration_leaves_out_is_as_the_spec_says(stream_tutorial, folder):
    truncating = '      <Parameter name="truncate" value="true"/>\n'
    path = edited(stream_tutorial, folder, (truncating, ""))
    stream = stream_tutorial.load("tutorial_test.py").Stream
    for _ in range(2):
        with ResourceManager.load(path, FakeClock()) as resources:
            resources.obtain("output", stream).write(b"Testing")
    assert (folder / "output.txt").read_text() == "TestingTesting"


@pytest.mark.proves("H19", "H22")
def test_the_stream_reads_writes_seeks_and_opens_again(stream_tutorial, folder):
    program = stream_tutorial.load("tutorial_test.py")
    seek = __import__("stream").Seek
    path = edited(stream_tutorial, folder)
    with ResourceManager.load(path, FakeClock()) as resources:
        stream = resources.obtain("output", program.Stream)
        stream.write(b"0123456789")
        for origin, offset, rest in (
            (seek.ABSOLUTE, 4, b"456789"),
            (seek.RELATIVE, -2, b"89"),
            (seek.END, -3, b"789"),
        ):
            stream.seek(origin, offset)
            assert (stream.read(100), stream.position) == (rest, 10)
        for _ in range(2):
            stream.deactivate()
            stream.activate()
            assert stream.is_active
    assert not stream.is_active
