"""`test_camera` prints what the tool of 2003 printed, and tells what failed."""

import cv2
import pytest

from hri.cli.diagnostics.camera import main

CONFIGURATION = """\
<Resources><Devices>
  <Device id="camera0" type="Hri.VideoFileCamera"><Parameter name="file" value="{}"/></Device>
  {}
</Devices></Resources>
"""


@pytest.fixture
def configure(tmp_path, monkeypatch):
    """Write a configuration, and stand in the folder where the pictures go."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    writer = cv2.VideoWriter(str(tmp_path / "v.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 10, (64, 48))
    for i in range(30):
        writer.write(cv2.UMat(48, 64, cv2.CV_8UC3, (8 * i, 8 * i, 8 * i)).get())
    writer.release()

    def configure(more=""):
        (tmp_path / "c.xml").write_text(CONFIGURATION.format(tmp_path / "v.avi", more))
        return f"--config={tmp_path / 'c.xml'}"

    return configure


@pytest.mark.proves("D02")
def test_it_says_what_the_tool_of_2003_said(configure, tmp_path, capsys):
    assert main([configure(), "--fast", "--pause-time", "0.5"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "*** test_camera ***",
        "Obtained cameras: camera0",
        "Frame count: 5. Pause time: 0.5 sec.",
        "Writing file camera0_001.jpg",
        "Writing file camera0_002.jpg",
        "Writing file camera0_003.jpg",
        "Writing file camera0_004.jpg",
        "Writing file camera0_005.jpg",
    ]
    means = [cv2.imread(str(path)).mean() for path in sorted(tmp_path.glob("camera0_*.jpg"))]
    assert means == pytest.approx([0, 40, 80, 120, 160], abs=6)  # half a second apart


@pytest.mark.proves("D02", "E6")
def test_without_options_it_takes_five_a_tenth_of_a_second_apart(configure, capsys):
    assert main([configure(), "--fast"]) == 0
    out = capsys.readouterr().out
    assert "Frame count: 5. Pause time: 0.1 sec.\n" in out
    assert out.count("Writing file") == 5


@pytest.mark.proves("D02")
def test_a_picture_of_less_quality_is_smaller(configure, tmp_path):
    sizes = []
    for quality in ("0", "0.8", "1"):
        main([configure(), "--fast", "--frames=2", f"--quality={quality}", "--out=new/folder"])
        sizes.append((tmp_path / "new" / "folder" / "camera0_002.jpg").stat().st_size)
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[2]


@pytest.mark.proves("D02", "D04")
def test_a_camera_that_is_missing_is_told_of_and_counts(configure, capsys):
    stand_in = '<Parameter name="stand_in" value="camera0"/>'
    device = '<Parameter name="device" value="63"/>'
    more = f'<Device id="camera1" type="Evolution.LinuxCamera">{device}{stand_in}</Device>'
    config = configure(more)
    assert main([config, "--frames=1", "--pause-time=0"]) == 1
    out, err = capsys.readouterr()
    assert "Obtained cameras: camera0\n" in out
    assert "Writing file camera0_001.jpg\n" in out
    assert err.startswith("Initializing...camera1: no camera /dev/video63 - plug one in")
    assert len(err.splitlines()) == 1
    assert main([config, "--frames=1", "camera0", "--pause-time=0"]) == 0


def test_a_camera_that_falls_silent_is_told_of_and_counts(configure, capsys):
    config = configure('<Device id="blank" type="Hri.BlankCamera"/>')
    assert main([config, "--fast", "--frames=1"]) == 1
    out, err = capsys.readouterr()
    assert out.count("Writing file camera0") == 1
    assert err == "blank: no picture within 5 s - unplug it and plug it in again\n"


@pytest.mark.parametrize(
    "option",
    ["--frames=0", "--frames=1.5", "--quality=1.1", "--quality=x", "--pause-time=-1", "--speed=1"],
)
def test_options_out_of_bounds_are_refused(option, capsys):
    with pytest.raises(SystemExit) as end:
        main([option])
    assert end.value.code == 2
    assert "usage: test_camera [OPTIONS] [<camera1_id>" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["camera9"], 'no device "camera9" - did you mean "camera0"?'),
        (["--out=c.xml/folder"], "cannot be made"),
        (["--config=none.xml"], 'no "none.xml" in config'),
    ],
)
def test_what_is_wrong_is_one_line(configure, arguments, says, capsys):
    assert main([configure(), "--fast", *arguments]) == 2
    err = capsys.readouterr().err
    assert says in err
    assert len(err.splitlines()) == 1


@pytest.mark.proves("D02")
def test_help_has_the_shape_of_2003(capsys):
    assert main(["--help"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Usage: test_camera [OPTIONS] [<camera1_id> [..<cameraN_id>]]\n")
    for option in ("--frames <count>", "--quality <quality>", "--pause-time <duration>"):
        assert option in out
