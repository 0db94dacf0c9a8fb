"""The real way of sound: a player, a sound server, PortAudio, our driver, endpointing, decoding."""

from __future__ import annotations

import ctypes.util
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.hal.drivers.resampling import resample
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.espeak import EspeakVoice
from tests.speech.sound_card_trial import START, STOP

HOUSE = Path(__file__).resolve().parents[2]
PATIENCE = 150.0
"""Seconds; it takes 15 where there is little else to do."""
SCRIPT = """
load-module module-native-protocol-unix
load-module module-null-sink sink_name=robot_test rate=16000 channels=1
set-default-sink robot_test
set-default-source robot_test.monitor
"""

needs_sound_server = pytest.mark.skipif(
    not shutil.which("pulseaudio") or not ctypes.util.find_library("portaudio"),
    reason="needs apt install pulseaudio pulseaudio-utils libasound2-plugins libportaudio2",
)


@pytest.fixture
def sound_server(tmp_path):
    """A PulseAudio of its own, whose only microphone hears its only loudspeaker.

    Gives the environment to reach it in, and the script it is started with.
    """
    home, runtime = tmp_path / "home", tmp_path / "run"
    home.mkdir()
    runtime.mkdir(mode=0o700)
    environment = {**os.environ, "HOME": str(home), "XDG_RUNTIME_DIR": str(runtime)}
    # Nothing of the user's own sound may be touched.
    for name in ("PULSE_SERVER", "PULSE_RUNTIME_PATH", "DISPLAY", "DBUS_SESSION_BUS_ADDRESS"):
        environment.pop(name, None)
    script = tmp_path / "start.pa"
    script.write_text(SCRIPT)
    # As a daemon it comes back as soon as it can be talked to.
    started = subprocess.run(
        [*START, str(script)],
        env=environment,
        capture_output=True,
        timeout=PATIENCE,
        check=False,
    )
    if started.returncode != 0:
        pytest.skip(f"the sound server does not start: {started.stderr.decode()[-200:]}")
    yield environment, script
    subprocess.run(STOP, env=environment, timeout=PATIENCE, check=False)


@needs_sound_server
@pytest.mark.proves("R01")
def test_what_a_loudspeaker_plays_is_heard_and_again_when_the_sound_card_was_away(
    sound_server, tmp_path
):
    environment, script = sound_server
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), ResourceManager((), FakeClock()))
    voice.activate()
    speech = voice.synthesize("go forward ten meters")
    sound = (0.5 * resample(speech.samples, speech.rate, 16000)).astype(np.int16)
    write_wav(tmp_path / "said.wav", sound, 16000)

    program = (sys.executable, "-m", "tests.speech.sound_card_trial")
    trial = subprocess.run(
        [*program, "companion", str(tmp_path / "said.wav"), "go forward ten meters", str(script)],
        env={**environment, "PYTHONPATH": str(HOUSE), "HRI_PATH": str(HOUSE)},
        cwd=HOUSE,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )

    assert trial.returncode == 0, trial.stderr[-2000:]
    told = json.loads(trial.stdout.splitlines()[-1])
    hearings = [what for name, what in told["events"] if name == "speech.heard"]
    # Where the machine is busy blocks are lost, and it is said again.
    right = [what for what in hearings if what["text"] == "go forward ten meters"]
    assert len(right) == 2, told
    assert right[-1]["tags"] == {"distance": 10.0}
    # A sound server that was just started on a busy machine has been seen to buffer two seconds.
    assert told["begun"] < right[-1]["start"] < right[-1]["end"]
    assert right[-1]["end"] < told["begun"] + told["length"] + 4.0
    assert sorted(told["notices"]) == [
        "microphone: gone - waiting for it to come back",
        "microphone: is back",
        "speaker: gone - waiting for it to come back",
        "speaker: is back",
    ]
