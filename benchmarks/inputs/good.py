"""Good inputs that bad ones are made of: the shipped files, and small files made here."""

from __future__ import annotations

import io
import json
import struct
import tempfile
import wave
import zipfile
from collections.abc import Callable, Iterable, Mapping
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from hri.core import paths
from hri.core.signals import Speech

RATE = 16_000
"""Samples a second of the sounds."""


def shipped(patterns: Iterable[str]) -> list[bytes]:
    """Contents of the built-in files whose paths match the patterns, the smallest first."""
    found = {file for pattern in patterns for file in paths.house().glob(pattern)}
    contents = sorted({file.read_bytes() for file in found}, key=lambda data: (len(data), data))
    assert contents, f"no built-in file matches {patterns}"
    return contents


def stimulus_file() -> str:
    """The name of the shipped file of stimuli, in whose place another one is read."""
    return min(file.name for file in (paths.house() / "emotions/stimuli").glob("*.toml"))


def _lines(*texts: str) -> list[bytes]:
    return [text.encode() for text in texts]


def apps() -> list[bytes]:
    """An app of shipped networks."""
    networks = 'networks = ["networks/wander", "networks/follow"]'
    return _lines(
        f'about = "An app"\n{networks}\ntasks = ["converse"]\n',
        'extends = "companion"\n[on]\n"timer.ended" = "wonder"\n"head.*" = ["notice", "wonder"]\n',
    )


def forms() -> list[bytes]:
    """A form that confirms, and one that does not."""
    slot = '[[form.date.slot]]\nname = "date"\nask = "On which day?"\n'
    texts = 'confirm = "On {date}?"\nchange = "What else?"\nevent = "day.chosen"\n'
    return _lines(
        f"[form.date]\n{texts}{slot}", f'[form.date]\ngrammar = "date"\n{slot}none = "any"\n'
    )


def skills() -> list[bytes]:
    """A skill with a network and a reaction."""
    return _lines(
        'about = "A skill"\nnetworks = ["networks/follow"]\nevents = ["a.b"]\n',
        'about = "Dice"\n[on]\n"timer.ended" = "wonder"\n"head.*" = ["notice", "wonder"]\n',
    )


def choices_of_skills() -> list[bytes]:
    """What `hri skill off` writes."""
    return _lines('off = ["dice", "sums"]\n')


def choices() -> list[bytes]:
    """What `hri doctor --choose` writes."""
    return _lines('[microphone]\ndevice = "USB Audio"\n\n[camera]\ndevice = "/dev/video0"\n')


def timelines() -> list[bytes]:
    """Both forms of `hri emotion simulate`."""
    toml = '[[event]]\nt = 20\ngoal = "charger"\nutility = 1.0\nlikelihood_after = 0.0\n\n'
    return _lines(
        "# seconds stimulus intensity person\n1.5 praise 0.8 Anna\n2 scold 1\n3e1 greeting\n",
        toml + '[[event]]\nt = 30\nstimulus = "praise"\nintensity = 0.5\nperson = "Anna"\n',
    )


def event_forms() -> list[bytes]:
    """Events as people read them."""
    return _lines(
        '{Event Examples.PhotoEvent.Shoot [time 0] (count: 3.000000) (name: "a_")}',
        '{Event a.b [time 1.7e9] (x: -1e-9) (y: 0.1) (text: "a\\"b\\\\\\n\\u00e9 \\t")}',
    )


def event_queries() -> list[bytes]:
    """Events over the wire."""
    return _lines(
        "Examples.PhotoEvent.Shoot?count=3&name=a_", "a.b?x=%20%3D%C3%A9&y=1e-9&z=%ED%A0%80"
    )


def expectations() -> list[bytes]:
    """A test of a grammar."""
    return _lines(
        "grammar companion\n+ go back one meter => move: distance=-1\n+ hello robot => greet: {}\n"
        "- fly to the moon  # not understood\n// a comment\n+ go back one meter =>\n"
    )


def outside_sentences() -> list[bytes]:
    """Sentences that mean no command."""
    return _lines("# what else people say\nfly to the moon\n\nwho ate my biscuits?\n")


def expressions() -> list[bytes]:
    """Values of parameters."""
    return _lines("-5*pi/6", "(1+2)/3-e*2.5", "+-1e3")


def formulas() -> list[bytes]:
    """How strong a stimulus is."""
    return _lines('clip(value, 0, 1)*(kind == "a") + min(a, b, 2e-3)/max(1, abs(c)) < 3')


def weights() -> list[bytes]:
    """A recording of a face, as an app on a phone writes it."""
    head = "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen,HeadYaw\n"
    rows = "".join(f"00:00:00:{i:02}.000,61,0.1,{i / 60},0.2\n" for i in range(50))
    return _lines(head + rows)


def poses() -> list[bytes]:
    """The turns of a head over time."""
    rows = "".join(f"{i / 30:.3f},{i % 7},{-i % 5},0.5\n" for i in range(60))
    return _lines("t_s,pitch_deg,yaw_deg,roll_deg\n" + rows)


def lexicons() -> list[bytes]:
    """How words sound."""
    return _lines("# cats\nschrodinger  SH R OW1 D IH0 NG ER0\nread(2) R EH1 D\nread R IY D\n")


def names() -> list[bytes]:
    """A list that a grammar imports."""
    return _lines("# Who\nRobin Smith\nthe boss = Alex\nroom twelve = 12\nyes = true\n")


def known_names() -> list[bytes]:
    """What the free slot of a grammar usually is."""
    return _lines("# Who\nRobin\nJean-Luc\nMary Ann\n")


def manifests() -> list[bytes]:
    """Recordings and what is said in them."""
    row = "a.wav\tgo back one meter\tmove: distance=-1\nb.wav\t-\n"
    return _lines("file\tsentence\ttags\n" + row, "a.wav\thello robot\n")


def memories() -> list[bytes]:
    """What a robot feels between runs."""
    from hri.emotion.model_spec import load_emotions
    from hri.emotion.persistence import Memory, dump

    dynamics = load_emotions("neutral").dynamics()
    affect = dynamics.rest(0.0)
    for name, person in (("praise", "Ann"), ("scold", "Bob"), ("bump", None)):
        affect = dynamics.feel(affect, name, 0.7, affect.time + 3.0, person)
    return [dump(Memory(affect.imprint, affect.time + 3.0, 1e9)).encode()]


def alarms() -> list[bytes]:
    """What a robot has promised to say."""
    from hri.conversation.alarm_file import Contents, dump
    from hri.conversation.alarms import AlarmKind, Alarms, Instant
    from hri.core.clock import Uptime

    at = Instant(1e9, Uptime(500.0, "one"))
    promised = Alarms(at=at)
    for kind, about, length in (("timer", "tea", 300.0), ("reminder", "call Ann", 0.0)):
        promised.add(AlarmKind(kind), 1e9 + 300.0, about, length)
    return [dump(Contents(promised.by_id, at, promised.last_id)).encode()]


def relations() -> list[bytes]:
    """What an app remembers of people."""
    return _lines(
        '[relation.likes]\nseveral = true\ntell = "You like {value}."\n'
        'ask_for = "What do you like?"\nfollow_up = ["How was your {value} evening, {name}?"]\n',
        '[relation.sister]\ntell = "Your sister is {value}."\nask = "Is {value} well?"\n',
    )


def databases() -> list[bytes]:
    """The people that a robot remembers."""
    from hri.conversation.memory import Memory
    from hri.conversation.memory_file import Contents, keep
    from hri.conversation.relations import Relation

    now, made = datetime(2026, 5, 4, 9, 30), []
    memory = Memory({"likes": Relation("likes", "You like {value}.", several=True)})
    for name in ("Anna", "Zoë"):
        id = memory.introduce(name, now, heard=("AE1", "N", "AH0")).id
        memory.allow(id, now, "word")
        memory.learn(id, "likes", "jazz", now, {"kind": "music", "how": 2.5})
        memory.feel(id, "joy", "praise", now)
        memory.note_asked(id, "likes", "jazz", "How was your jazz evening?")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "people.db")
            keep(file, Contents(memory.remembered, memory.last_id))
            made.append(file.read_bytes())
    return made


def people() -> list[bytes]:
    """Faces by name."""
    vectors = [[0.1 * number for number in range(16)], [0.5] * 16]
    return [json.dumps({"Anna": vectors, "Ben": vectors[:1]}).encode()]


def load_personality_file(path: Path) -> object:
    """A personality by the path of its file."""
    from hri.emotion.personality import load_personality

    return load_personality(str(path))


def runs() -> list[bytes]:
    """Recordings of a robot and of a trip."""
    trip = [json.dumps({"goal": [1, 2], "radius": 0.2, "title": "room"})] + [
        json.dumps({"t": i / 10, "robot": [i, 0, 0.1], "people": [[1, 1]], "seen": []})
        for i in range(20)
    ]
    return event_logs() + _lines("\n".join(trip) + "\n")


def event_logs() -> list[bytes]:
    """What a robot's recording holds."""
    odometry = [
        json.dumps({"t": i / 10, "event": "odometry", "x_cm": i, "y_cm": -i, "heading_rad": 0.1})
        for i in range(20)
    ]
    heard = json.dumps({"t": 2.0, "event": "speech.heard", "text": "hello", "tags": {"a": [1]}})
    return _lines("\n".join([*odometry, heard]) + "\n")


def value_logs() -> list[bytes]:
    """What a ValueRecorder writes."""
    values = (1.5, "a text", True, [1, 2.5], 3)
    lines = [json.dumps({"t": i / 10, "value": value}) for i, value in enumerate(values)]
    return _lines("\n".join(lines) + "\n")


def wire_lines() -> list[bytes]:
    """Frames of the bridge."""
    return _lines(
        '<tutorial><number count="1">5.000000</number></tutorial>',
        '<server><event count="2">"Examples.Event?count=3&amp;name=a_"</event></server>',
        "<a><values>(1, 2.5, 3)</values><text>&lt;plain&gt; &#65;</text></a>",
    )


def _samples() -> np.ndarray[tuple[int], np.dtype[np.int16]]:
    time = np.arange(RATE // 10) / RATE
    return np.asarray(8000 * np.sin(2 * np.pi * 440 * time), np.int16)


def wavs() -> list[bytes]:
    """PCM of 16 and 8 bits, one channel and two."""
    made = []
    for channels, width in ((1, 2), (2, 2), (1, 1)):
        file = io.BytesIO()
        with wave.open(file, "wb") as sound:
            sound.setparams((channels, width, RATE, 0, "NONE", "not compressed"))
            sound.writeframes(np.repeat(_samples(), channels).tobytes())
        made.append(file.getvalue())
    return made


def sounds() -> list[bytes]:
    """Ogg, FLAC and MP3."""
    import soundfile

    made = []
    for kind in ("OGG", "FLAC", "MP3"):
        file = io.BytesIO()
        soundfile.write(file, _samples(), RATE, format=kind)
        made.append(file.getvalue())
    return [_of_stream_0(made[0]), *made[1:]]


def _of_stream_0(ogg: bytes) -> bytes:
    """An Ogg file with 0 for the number of its stream, which is drawn at random (RFC 3533)."""
    pages = b""
    while ogg:
        table = 27 + ogg[26]
        size = table + sum(ogg[27:table])
        page = bytearray(ogg[:size])
        page[14:18] = page[22:26] = bytes(4)
        page[22:26] = struct.pack("<I", _checksum(page))
        pages, ogg = pages + page, ogg[size:]
    return pages


def _checksum(page: bytearray) -> int:
    """CRC-32 of an Ogg page: polynomial 0x04C11DB7, the highest bit first, from 0."""
    value = 0
    for byte in page:
        value ^= byte << 24
        for _ in range(8):
            value = (value << 1) ^ (0x1_04C1_1DB7 if value & 0x8000_0000 else 0)
    return value


def pictures() -> list[bytes]:
    """A small picture in many formats, of 8 bits, 16 bits, and with a point."""
    import cv2

    picture = np.add.outer(np.arange(24), np.arange(32)).astype(np.uint8)
    color = np.dstack([picture, picture * 2, picture * 3])
    deep = color.astype(np.uint16) * 16
    made: list[tuple[str, Any]] = [
        (suffix, picture) for suffix in (".png", ".jpg", ".bmp", ".webp", ".pgm")
    ]
    made += [(suffix, color) for suffix in (".avif", ".tif", ".gif")]
    made += [(suffix, deep) for suffix in (".png", ".tif", ".ppm")]
    made += [
        (".tif", deep[..., 0]),
        (".tif", np.float32(color)),
        (".png", np.dstack([color, picture])),
    ]
    return [cv2.imencode(suffix, array)[1].tobytes() for suffix, array in made]


def videos() -> list[bytes]:
    """A film of some pictures, and a picture that stands for one."""
    import cv2

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "a.avi")
        writer = cv2.VideoWriter(str(file), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (32, 24))
        for shade in range(8):
            writer.write(np.full((24, 32, 3), 30 * shade, np.uint8))
        writer.release()
        return [file.read_bytes(), *pictures()[:2]]


def archives() -> list[bytes]:
    """Archives of a model, packed and as it is."""
    members = {
        "model/am/final.mdl": bytes(range(256)) * 4,
        "model/conf/model.conf": b"--rate=16000\n",
        "model/empty/": b"",
    }
    made = []
    for method in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w", method) as archive:
            for name, content in members.items():
                archive.writestr(zipfile.ZipInfo(name), content, method)  # of 1980, not of today
        made.append(file.getvalue())
    return made


def object_sets() -> list[bytes]:
    """Sets of two objects by either kind of features, as they are written, and deflated."""
    from hri.vision.objects.cutout import whole
    from hri.vision.objects.learning import view_of
    from hri.vision.objects.local_features import METHODS
    from hri.vision.objects.model_file import save_models
    from hri.vision.objects.object_model import ModelSet, ObjectModel
    from hri.vision.objects.printed_label import printed_label

    made = []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "a.mdl")
        for method in METHODS:
            views = {
                name: view_of(printed_label(name), whole(printed_label(name)), method, 0.001, "a")
                for name in ("cup", "key")
            }
            objects = tuple(ObjectModel(name, (view,), "2026") for name, view in views.items())
            save_models(file, ModelSet(method, objects))
            made.append(file.read_bytes())
        with zipfile.ZipFile(file, "w") as deflated:
            for name, content in entries_of(made[0]).items():
                deflated.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
        made.append(file.read_bytes())
    return made


def manifests_of_objects() -> list[bytes]:
    """What a set says of its objects."""
    return [entries_of(object_sets()[0])["model_set.json"]]


def pictures_of_objects() -> list[bytes]:
    """Small pictures."""
    return [*pictures()[:2], entries_of(object_sets()[0])["0000-00.jpg"]]


def entries_of(archive: bytes) -> dict[str, bytes]:
    """What is in an archive, by name."""
    with zipfile.ZipFile(io.BytesIO(archive)) as opened:
        return {name: opened.read(name) for name in opened.namelist()}


def packed(entries: Mapping[str, bytes]) -> bytes:
    """An archive of these entries."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as made:
        for name, content in entries.items():
            made.writestr(zipfile.ZipInfo(name), content)
    return file.getvalue()


def object_names() -> list[bytes]:
    """Lists of names that stand for objects."""
    return _lines("# the kitchen\ncup\nkey  # the spare one\n", "Søren's étui\n")


def speeches() -> list[bytes]:
    """Texts with markup."""
    return _lines(
        '<speak>It is <emphasis level="strong">very</emphasis> late.<break time="500ms"/>'
        '<mark name="bye"/><prosody rate="120%" pitch="-12st" volume="+6dB">Good '
        '<sub alias="evening">eve</sub></prosody>, sir.</speak>',
        '<speak><p><s>On <say-as interpret-as="date" format="dmy">24/11/2026</say-as></s>'
        '<say-as interpret-as="cardinal">-1,024.5</say-as> <voice name="robot">'
        '<phoneme alphabet="ipa" ph="kæt">cat</phoneme></voice>'
        '<break strength="weak"/></p></speak>',
    )


def orders() -> list[bytes]:
    """What the page asks of the robot: a name, and arguments."""
    asked = (
        ("say", {"text": "hello"}),
        ("visitor_go", {"x": 1.5, "y": -2, "who": "Anna"}),
        ("mute", {"on": True}),
        ("network_start", {"path": "wander.xml", "text": "<BehaviorNetwork/>"}),
        ("network_break", {"name": "face", "port": "a.b", "condition": ">= 2*pi"}),
    )
    return _lines(*(json.dumps({"name": name, "arguments": given}) for name, given in asked))


def conditions() -> list[bytes]:
    """Of breakpoints."""
    return _lines("< 30", ">= -pi/2", "== true", "!= hello you", "changes", "sent")


def entries() -> list[bytes]:
    """What someone who wants to enter the studio shows: a code, a cookie, a host, an origin."""
    (cookie,) = cookies()
    return _lines(
        f"abc-DEF_123\n{cookie}\nlocalhost:8000\nhttp://localhost:8000",
        f"x\n{cookie[:-1]}\n[::1]:80\nhttps://pi.local",
    )


@cache
def cookies() -> list[str]:
    """Of the one who was let in."""
    from hri.studio.access import Cookies

    return [Cookies(SECRET).new(1e9)]


SECRET = "of the bench"


def tokens() -> list[bytes]:
    """Files of tokens."""
    return _lines("abcdefghijklmnopqrstuvwxyz012345\n", "-_.~+/=-_.~+/=-_.~+/=")


def drafts() -> list[bytes]:
    """Networks that were not saved."""
    text = '<BehaviorNetwork><Behavior type="Hri.Constant" id="a"/></BehaviorNetwork>\n'
    return _lines(
        json.dumps({"path": "/home/a/n.xml", "text": text, "mark": None, "time": 1.5e9}),
        json.dumps({"path": "/home/a/n.xml", "text": text, "mark": "0f" * 32, "time": 0}),
    )


def laid_out() -> list[bytes]:
    """Networks with the places of their parts."""
    return _lines(
        '<?xml version="1.0" encoding="UTF-8"?>\n<!-- adds -->\n<BehaviorNetwork>\n'
        '  <Behavior type="Hri.Constant" id="one"><Parameter name="parsed_value" value="2.5"/>'
        '</Behavior>\n  <Behavior type="Hri.InputCollector" id="told"/>\n'
        '  <Link from="one.value" to="told.input"/>\n'
        '  <Layout><Box id="one" x="40" y="-20"/><Box id="told" x="300" y="60"/></Layout>\n'
        "</BehaviorNetwork>\n",
    )


def recordings() -> list[bytes]:
    """Logs as a robot begins them."""
    head = {"t": 5.0, "event": "recording.started", "face": 5.1, "sound": 5.2}
    return [json.dumps(head).encode() + b"\n" + log for log in event_logs()]


def tensors() -> list[bytes]:
    """Weight files with two small tensors, packed and as they are."""
    made = []
    for save in (np.savez, np.savez_compressed):
        file = io.BytesIO()
        save(file, allow_pickle=False, matrix=np.ones((2, 3), np.float16), bias=np.zeros(6))
        made.append(file.getvalue())
    return made


@cache
def silent_voice() -> Callable[[str], Speech]:
    """What speaks the texts of a scene without a sound."""
    from hri.core.clock import FakeClock
    from hri.hal.resource import Description
    from hri.hal.resource_manager import ResourceManager
    from hri.speech.synthesizers.silent import SilentVoice

    description = Description("voice", "Hri.SilentVoice", {})
    return SilentVoice(description, ResourceManager((), FakeClock())).synthesize
