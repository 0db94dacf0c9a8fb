"""`hri forget`: afterwards no file that the program wrote has anything of who was forgotten."""

import io
import json
import shutil
import stat
import zipfile
from dataclasses import replace

import numpy as np
import pytest

import hri.face.renderers.kernel  # noqa: F401 - its code is not compiled into each test's folder
from hri.cli.diagnostics import camera as camera_tool
from hri.cli.main import main
from hri.conversation import personal_data
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.event_log import EventLog
from hri.core.recorded import ABOUT
from hri.core.stored_data_index import note, noted, whereabouts_file
from hri.emotion.model_spec import load_emotions
from hri.emotion.persistence import Memory, keep, memory_file, recall
from hri.hal.audio_file import AudioFileRecorder
from hri.hal.choices import choices_file, save_choices
from hri.hal.drivers.image_size import write_picture
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.studio.composer.files import Library
from hri.vision.color.color_model import find_color, load_color, own_colors, save_color
from hri.vision.objects.local_features import SIFT
from hri.vision.objects.model_file import load_models, own_models, save_models
from hri.vision.objects.object_model import ModelSet
from hri.vision.tracking.face_recognition import Acquaintances
from tests.vision.objects.pictures import learned

ANNA = "Quillobrand"
"""No dictionary knows how she is said."""
BEN = "Wexlafert"
CAMERA = """\
<Resources><Devices>
  <Device id="camera0" type="Hri.VideoFileCamera"><Parameter name="file" value="{}"/></Device>
</Devices></Resources>
"""
TASKS = f"""

async def meet(context):
    await context.clock.sleep(2.0)
    companion = Companion.of(context)
    companion.emotion.feel("praise", 1.0, "{ANNA}")
    companion.emotion.feel("scold", 0.5, "{BEN}")
    companion.say("Good evening.")
"""


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    """A user of their own."""
    for name in ("CONFIG", "CACHE", "STATE"):
        monkeypatch.delenv(f"XDG_{name}_HOME", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)  # recordings below the current folder are theirs, too
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path


def forget(*words):
    return main(["forget", *words])


def holding(folder, name):
    """The names of all files below a folder that hold a name, in their bytes or their own names."""
    found = set()
    for file in folder.rglob("*"):
        held = file.name.encode() + (file.read_bytes() if file.is_file() else b"")
        if name.lower().encode() in held.lower():
            found.add(file.name)
    return found


def open_to_others(home):
    """What lies in the folders of the program, and they themselves, that others can read."""
    state, settings, cache = memory_file().parent, choices_file().parent, paths.cache_folder()
    folders = (state, settings, cache, home / "out", home / "known")
    files = [file for folder in folders for file in folder.iterdir() if file.is_file()]
    return {path for path in (*folders, *files) if stat.S_IMODE(path.stat().st_mode) & 0o077}


def an_app(folder):
    """The companion, to whom two people did something."""
    app = folder / "app"
    shutil.copytree(paths.find("apps", "companion"), app)
    toml = app / "app.toml"
    toml.write_text(toml.read_text().replace('"converse"', '"converse", "meet"'))
    (app / "tasks.py").write_text((app / "tasks.py").read_text() + TASKS)
    return app


def a_config(folder):
    """The simulated robot with a small screen."""
    text = paths.find("config", "simulated").read_text()
    config = folder / "small.xml"
    config.write_text(text.replace('"640"', '"160"').replace('"480"', '"120"'))
    return config


def live(home, authored):
    """What a robot and its owner do in a while: live, learn a face, say a name, choose devices."""
    words = ("--config", a_config(authored), "--record", home / "out", "--duration", 6)
    assert main(["run", str(an_app(authored)), *map(str, words), "--fast", "--keep"]) == 0
    known = Acquaintances()
    known.learn(ANNA, np.array([1.0, 0.0]))
    known.save(home / "known" / "faces.json")
    assert main(["grammar", "pronounce", ANNA]) == 0
    assert main(["grammar", "pronounce", ANNA, "--add", "K W IH L"]) == 0
    assert main(["grammar", "pronounce", BEN, "--add", "W EH K S"]) == 0
    save_choices({"microphone": f"Headset of {ANNA}", "speaker": "USB"})
    save_models(own_models(), learned(f"{ANNA}'s cup", "key"))
    color = load_color(find_color("red_ball"))
    for name in (f"{ANNA} shirt", "sky"):
        save_color(own_colors() / f"{name}.color", color)


@pytest.mark.proves("R11")
def test_nothing_of_who_was_forgotten_is_in_any_file_that_the_program_wrote(
    tmp_path_factory, home, capsys
):
    memory_file().parent.mkdir(parents=True)
    memory_file().write_text(f'{{"damaged": "{ANNA}')
    memory_file().with_name("feelings.json.new").write_text(ANNA)
    memory_file().with_name("feelings.json.new").chmod(0o600)
    live(home, tmp_path_factory.mktemp("authored"))
    out = home / "out"
    kept_of_her = {
        "feelings.json", "feelings.json.new", "feelings.unusable-1.json", "faces.json",
        "events.jsonl", "guessed-words-2.txt", "lexicon.txt", "devices.toml", "objects.mdl",
        f"{ANNA} shirt.color",
    }  # fmt: skip
    assert holding(home, ANNA) == kept_of_her
    assert open_to_others(home) == set()

    capsys.readouterr()
    assert forget(ANNA.lower()) == 0
    assert holding(home, ANNA) == {"events.jsonl"}
    assert f"{out}: a recording: {ANNA.lower()} - it stays" in capsys.readouterr().out
    assert forget(ANNA, "--yes") == 0
    assert holding(home, ANNA) == set()
    assert not out.exists()
    assert not whereabouts_file().exists() or str(out) not in whereabouts_file().read_text()
    assert BEN in recall(memory_file()).imprint.relations
    assert [one.name for one in load_models(own_models()).objects] == ["key"]
    assert [file.name for file in own_colors().iterdir()] == ["sky.color"]
    assert holding(home, BEN) == {"feelings.json", "lexicon.txt"}

    assert main(["emotion", "forget", "--yes"]) == 0
    assert holding(home, BEN) == set()
    assert personal_data.traces() == []
    capsys.readouterr()
    assert forget() == 0
    assert "nothing to forget" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["anna_cup", "anna2", "IMG_anna", "Annas cup", "annaCup"])
def test_an_object_and_a_color_of_hers_are_found_however_they_are_written(home, name):
    save_models(own_models(), learned(name, "Joannas key"))
    color = load_color(find_color("red_ball"))
    for stem in (name, "hannah"):
        save_color(own_colors() / f"{stem}.color", color)
    assert forget("Anna") == 0
    assert [one.name for one in load_models(own_models()).objects] == ["Joannas key"]
    assert [file.stem for file in own_colors().iterdir()] == ["hannah"]


def test_an_object_from_a_picture_of_hers_is_found_in_a_set_that_another_tool_packed(home):
    (model,) = learned("cup").objects
    view = replace(model.views[0], source="pictures/anna_01.jpg")
    save_models(own_models(), ModelSet(SIFT, (replace(model, views=(view,)),)))
    with zipfile.ZipFile(own_models()) as archive:
        entries = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(own_models(), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in entries.items():
            archive.writestr(name, data)
    assert b"anna" not in own_models().read_bytes()
    whereabouts_file().unlink()
    assert forget("Anna") == 0
    assert load_models(own_models()).objects == ()


@pytest.mark.parametrize("name", [".wander.xml.draft", ".wander.xml.0f3a.draft"])
def test_a_draft_of_a_network_is_on_the_list(home, capsys, name):
    draft = home / name
    draft.write_text(json.dumps({"path": "wander.xml", "text": f"<!-- for {ANNA} -->"}))
    (home / ".notes.draft").write_text(f"of another program: {ANNA}")
    assert forget(BEN) == 0
    assert "nothing to forget" in capsys.readouterr().out
    assert forget(ANNA) == 0
    assert f"{draft}: a draft of a network: {ANNA} - it stays; --yes" in capsys.readouterr().out
    assert forget("--yes") == 0
    assert [file.name for file in home.glob(".*.draft")] == [".notes.draft"]


def test_a_draft_that_the_studio_kept_is_found_wherever_it_lies(home, monkeypatch):
    folder = home / "mine"
    folder.mkdir()
    Library(lambda: 0.0, start=folder).keep_draft(str(folder / "new.xml"), "<x/>", None)
    monkeypatch.chdir(home)
    assert forget("--yes") == 0
    assert list(folder.iterdir()) == []


def test_a_sound_that_a_program_recorded_is_on_the_list(home, capsys):
    devices = {"microphone": "Hri.MemoryMicrophone", "recorder": "Hri.AudioFileRecorder"}
    resources = ResourceManager(
        [Description(id, kind) for id, kind in devices.items()], FakeClock()
    )
    recorder = resources.obtain("recorder", AudioFileRecorder)
    recorder.record(home / "anna.wav", 1.0)
    resources.close()
    assert forget("Anna") == 0
    assert "anna.wav: a sound of the microphone: Anna - it stays" in capsys.readouterr().out
    assert forget("--yes") == 0
    assert not (home / "anna.wav").exists()


def test_forgetting_in_the_old_words_asks_nobody_and_names_what_stays(home, capsys, monkeypatch):
    monkeypatch.setattr("builtins.input", lambda question: pytest.fail("nobody is there"))
    out = a_recording(home / "out")
    assert main(["emotion", "forget"]) == 0
    assert f"{out}: a recording - it stays; --yes deletes it" in capsys.readouterr().out
    assert (out / "events.jsonl").exists()


@pytest.mark.parametrize(
    ("answer", "stays"), [("y", False), ("yes", False), ("", True), ("n", True)]
)
def test_a_recording_is_deleted_after_a_yes(home, capsys, monkeypatch, answer, stays):
    out = a_recording(home / "out", f"We met {ANNA}.")
    other = a_recording(home / "other", f"We met {BEN}.")
    asked = []
    monkeypatch.setattr("sys.stdin", Terminal())
    monkeypatch.setattr("builtins.input", lambda question: asked.append(question) or answer)
    assert forget(ANNA) == 0
    assert len(asked) == 1
    assert str(out) in asked[0]
    assert out.exists() == stays
    assert other.exists()


def test_a_recording_that_began_with_feelings_about_someone_goes_too(home):
    out = a_recording(home / "out")
    told = {"feelings": {"relations": {ANNA: 0.5}}, "cwd": f"/home/{BEN}"}
    (out / ABOUT).write_text(json.dumps(told))
    assert forget(BEN, "--yes") == 0
    assert out.exists()
    assert forget(ANNA, "--yes") == 0
    assert not out.exists()


def test_of_a_folder_with_other_files_only_the_recording_is_deleted(home):
    out = a_recording(home / "out")
    (out / "notes.txt").write_text("mine")
    assert forget("--yes") == 0
    assert [file.name for file in out.iterdir()] == ["notes.txt"]


def test_a_recording_that_goes_on_stays_until_its_robot_has_ended(home, capsys):
    out = a_recording(home / "out")
    log = EventLog(out / "events.jsonl", EventBus(FakeClock()))
    assert forget("--yes") == 2
    assert f"{out}: it is still being recorded - end the robot" in capsys.readouterr().err
    assert (out / "face.mp4").exists()
    log.close()
    assert forget("--yes") == 0
    assert not out.exists()


def test_pictures_of_a_camera_are_their_owners_alone_and_go_after_a_yes(home, capsys):
    write_picture(home / "room.png", np.zeros((48, 64, 3), np.uint8))
    config = home / "camera.xml"
    config.write_text(CAMERA.format(home / "room.png"))
    words = ["--config", str(config), "--out", str(home / "seen"), "--frames", "2"]
    assert camera_tool.main([*words, "--fast"]) == 0
    pictures = sorted((home / "seen").glob("*.jpg"))
    assert [stat.S_IMODE(file.stat().st_mode) for file in pictures] == [0o600, 0o600]
    assert forget() == 0
    told = capsys.readouterr().out
    assert all(f"{file}: a picture or film of the camera - it stays" in told for file in pictures)
    assert forget("--yes") == 0
    assert list((home / "seen").iterdir()) == []


def test_whoever_is_not_known_is_told_of_those_who_are(home, capsys):
    dynamics = load_emotions("neutral").dynamics()
    affect = dynamics.feel(dynamics.rest(0.0), "praise", 1.0, 0.0, BEN)
    keep(memory_file(), Memory(affect.imprint, 0.0, 1e9))
    assert forget(BEN[:-1]) == 2
    assert f'did you mean "{BEN}"' in capsys.readouterr().err


def test_one_whose_name_is_part_of_another_is_forgotten_alone(home):
    known = Acquaintances()
    for number, name in enumerate(("Ann", "Ann Lee", "Annabel")):
        known.learn(name, np.eye(3)[number])
    known.save(home / "faces.json")
    assert forget("ann") == 0
    assert Acquaintances.load(home / "faces.json").names == ["Ann Lee", "Annabel"]


def test_what_cannot_be_read_keeps_nothing_else_from_being_forgotten(home, capsys):
    memory_file().parent.mkdir(parents=True)
    memory_file().write_text(f'{{"damaged": "{ANNA}')
    (home / "faces.json").write_text(f'["{ANNA}"')
    note("faces", home / "faces.json")
    save_models(own_models(), learned(f"{ANNA}'s cup"))
    own_models().write_bytes(own_models().read_bytes()[:-100])
    a_recording(home / "out", f"\n{ANNA}\n")
    assert forget(ANNA, "--yes") == 0
    assert holding(home, ANNA) == set()


def test_where_recordings_are_is_noted_once_and_only_as_long_as_they_are_there(home):
    out = a_recording(home / "out")
    note("recording", out)
    assert noted("recording") == [out]
    shutil.rmtree(out)
    assert noted("recording") == []
    assert stat.S_IMODE(whereabouts_file().stat().st_mode) == 0o600
    whereabouts_file().write_text('no JSON\n{"kind": 1}\n[]\n')
    assert noted("recording") == []
    a_recording(home / "again")
    assert noted("recording") == [home / "again"]


def test_recordings_from_before_the_notes_are_found_where_robots_record_by_default(home, capsys):
    old = a_recording(home / "recordings" / "2024-05-01-12-00-00", f"We met {ANNA}.")
    other = a_recording(home / "recordings" / "mine", f"We met {ANNA}.")
    whereabouts_file().unlink()
    assert forget(ANNA, "--yes") == 0
    assert not old.exists()
    assert other.exists()
    assert str(old) in capsys.readouterr().out


def test_a_choice_that_somebody_else_may_have_written_is_forgotten_whole(home):
    save_choices({"microphone": f"Headset of {ANNA}", "speaker": "USB"})
    choices_file().chmod(0o666)
    assert forget(ANNA, "--yes") == 0
    assert not choices_file().exists()


class Terminal(io.StringIO):
    """A standard input at which somebody sits."""

    def isatty(self):
        return True


def a_recording(out, said="Hello."):
    """What a robot would leave behind."""
    out.mkdir(parents=True)
    line = {"t": 1.0, "event": "speech.said", "text": said}
    (out / "events.jsonl").write_text(json.dumps(line) + "\n")
    (out / "face.mp4").write_bytes(b"film")
    note("recording", out)
    return out


@pytest.mark.parametrize("words", [(), (ANNA,)])
def test_what_the_telemetry_of_a_package_kept_is_forgotten_without_asking(home, capsys, words):
    folder = paths.cache_folder().parent / "Microsoft" / "DeveloperTools" / ".onnxruntime"
    folder.mkdir(parents=True)
    (folder / "deviceid").write_text("0b9e6a")
    (folder / "onnxruntime.db").write_bytes(b"\x00\xff/home/" + ANNA.encode() + b"/python\x00")
    session = home / ".ses"
    session.write_text("1795649504638\ncdefa83e-e7ff-cac0-fbef-bffd944ef77f")
    assert forget(BEN) == 0  # nothing of him
    assert (folder / "deviceid").exists()
    assert forget(*words) == 0
    assert f"{folder}: telemetry of onnxruntime" in capsys.readouterr().out
    assert not (home / ".cache" / "Microsoft").exists()
    assert session.exists() == bool(words)
    session.write_text("someone else's")
    assert forget() == 0
    assert session.exists()
