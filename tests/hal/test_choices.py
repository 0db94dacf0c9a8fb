import pytest

from hri.core.clock import FakeClock, RealClock
from hri.core.errors import AuthoringError, HriError
from hri.hal.choices import apply_choices, choices_file, load_choices, save_choices
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager


@pytest.fixture(autouse=True)
def own_settings(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))


def test_what_was_chosen_is_there_the_next_time():
    assert load_choices() == {}
    chosen = {"microphone": 'Ann\'s "USB" Audio', "camera": "1"}
    save_choices(chosen)
    assert load_choices() == chosen


def test_the_choice_reaches_real_devices_only():
    devices = (
        Description("microphone", "Evolution.WmmeAudioRecord"),
        Description("speaker", "Hri.SilentSpeaker"),
        Description("camera", "Hri.Webcam", {"width": "320"}),
    )
    chosen = apply_choices(devices, {"microphone": "3", "speaker": "4", "camera": "1"})
    assert [dict(device.parameters) for device in chosen] == [
        {"device": "3"},
        {},
        {"width": "320", "device": "1"},
    ]


def test_programs_in_real_time_use_it_and_runs_that_repeat_do_not(tmp_path):
    file = tmp_path / "resource-config.xml"
    camera = '<Device id="camera" type="Hri.Webcam"/>'
    file.write_text(f"<Resources><Devices>{camera}</Devices></Resources>")
    save_choices({"camera": "1"})
    with ResourceManager.load(file, RealClock()) as resources:
        assert resources.descriptions["camera"].text("device") == "1"
    with ResourceManager.load(file, FakeClock()) as resources:
        assert resources.descriptions["camera"].text("device") == ""


def test_a_spoilt_choice_is_told_with_its_place():
    choices_file().parent.mkdir(parents=True)
    choices_file().write_text("[microphon]\ndevice = '1'\n")
    with pytest.raises(AuthoringError, match=r"devices.toml:1:1: unknown key .* did you mean"):
        load_choices()


def test_a_choice_that_somebody_else_may_have_written_is_not_used():
    path = save_choices({"microphone": "USB Audio"})
    path.chmod(0o666)
    with pytest.raises(HriError, match=r"devices.toml: someone else may have written this choice"):
        load_choices()
    path.chmod(0o600)
    assert load_choices() == {"microphone": "USB Audio"}
