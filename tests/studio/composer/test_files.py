"""Files of networks: what was read comes back byte by byte, nothing is lost or half written."""

import json
from concurrent.futures import ThreadPoolExecutor

import pytest
from hypothesis import given, strategies as st

from hri.core import paths
from hri.core.errors import HriError
from hri.studio.composer import drafts, files
from hri.studio.composer.files import LARGEST, Changed, Library, NoFile

SHIPPED = sorted(
    path
    for folder in ("apps", "config", "docs")
    for path in (paths.house() / folder).rglob("*.xml")
    if "<BehaviorNetwork" in path.read_text(encoding="utf-8")
)
NETWORK = '<BehaviorNetwork>\n  <Behavior id="a" type="Hri.Constant"/>\n</BehaviorNetwork>\n'


@pytest.fixture
def library(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    start = tmp_path / "start"
    start.mkdir()
    return Library(lambda: 1000.0, start=start)


@pytest.fixture
def path(library):
    return str(library.start / "one.xml")


@pytest.mark.parametrize("shipped", SHIPPED, ids=lambda path: path.name)
def test_every_shipped_network_is_saved_as_it_was_read(library, path, shipped):
    data = shipped.read_bytes()
    (library.start / "one.xml").write_bytes(data)
    opened = library.open(path)
    library.save(path, opened["text"], opened["mark"])
    assert (library.start / "one.xml").read_bytes() == data


@given(data=st.text(max_size=400))
def test_any_text_comes_back_byte_by_byte(tmp_path_factory, data):
    library = Library(lambda: 0.0, start=tmp_path_factory.mktemp("net"))
    path = library.start / "one.xml"
    path.write_bytes(data.encode("utf-8", "surrogatepass"))
    try:
        opened = library.open(str(path))
    except HriError:
        assert any("\ud800" <= letter <= "\udfff" for letter in data)
        return
    library.save(str(path), opened["text"], opened["mark"])
    assert path.read_bytes() == data.encode()


def test_a_new_network_is_saved_where_there_is_none(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    assert library.open(path) == {
        "path": path,
        "text": NETWORK,
        "mark": mark,
        "is_writable": True,
        "why": "",
        "draft": None,
        "drafts": [],
        "damaged": [],
    }


def test_what_changed_outside_is_not_overwritten(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    (library.start / "one.xml").write_text("<other/>")
    with pytest.raises(Changed, match="changed since it was opened") as caught:
        library.save(path, NETWORK + "\n", mark)
    assert caught.value.text == "<other/>"
    library.save(path, NETWORK + "\n", caught.value.mark)
    (library.start / "one.xml").unlink()
    with pytest.raises(Changed, match="was removed"):
        library.save(path, NETWORK, mark)
    with pytest.raises(Changed):
        library.save(str(library.start / "one.xml"), NETWORK, "wrong")


def test_of_two_who_save_at_once_one_is_asked(library, path):
    mark = library.save(path, NETWORK, None)["mark"]

    def save(number):
        try:
            return library.save(path, NETWORK + number * "\n", mark)
        except Changed:
            return None

    outcomes = [save(number) for number in range(1, 5)]
    assert sum(one is not None for one in outcomes) == 1


def test_a_change_outside_is_noticed(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    assert library.watch(path, mark) == {"mark": mark}
    (library.start / "one.xml").write_text("<other/>")
    found = library.watch(path, mark)
    assert found["text"] == "<other/>"
    (library.start / "one.xml").unlink()
    assert library.watch(path, found["mark"]) == {"mark": None, "text": ""}


def test_a_draft_lies_beside_its_file_until_that_is_saved(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    library.keep_draft(path, NETWORK + "<!-- x -->", mark)
    draft = library.start / ".one.xml.draft"
    assert draft.stat().st_mode & 0o077 == 0
    assert library.open(path)["draft"] == {
        "text": NETWORK + "<!-- x -->",
        "mark": mark,
        "time": 1000.0,
    }
    (row,) = (one for one in library.listed()["networks"] if one["path"] == path)
    assert row["has_draft"]
    library.save(path, NETWORK, mark)
    assert not draft.exists()
    library.drop_draft(path)


def test_a_network_that_was_never_saved_is_listed_by_its_draft(library, path):
    library.keep_draft(path, NETWORK, None)
    (row,) = (one for one in library.listed()["networks"] if one["path"] == path)
    assert (row["has_draft"], row["name"]) == (True, "one")
    opened = library.open(path)
    assert (opened["text"], opened["mark"], opened["draft"]["text"]) == ("", None, NETWORK)
    library.drop_draft(path)
    with pytest.raises(NoFile, match="there is no such network"):
        library.open(path)


def test_a_draft_goes_to_the_users_folder_where_nothing_may_be_written(library, monkeypatch):
    shipped = str(SHIPPED[0])
    monkeypatch.setattr(files, "_is_installed", lambda path: str(path) == shipped)
    opened = library.open(shipped)
    assert (opened["is_writable"], opened["why"]) == (False, "it belongs to the installation")
    with pytest.raises(HriError, match="save it as another file"):
        library.save(shipped, NETWORK, opened["mark"])
    library.keep_draft(shipped, NETWORK, opened["mark"])
    (draft,) = (paths.data_folder() / "drafts").iterdir()
    assert json.loads(draft.read_text())["path"] == shipped
    assert library.open(shipped)["draft"]["text"] == NETWORK
    library.drop_draft(shipped)


def test_a_damaged_draft_is_named_and_hides_nothing(library, path):
    (library.start / ".one.xml.draft").write_text('{"text": 3')
    with pytest.raises(HriError, match="the draft is damaged - delete it"):
        library.open(path)
    library.save(path, NETWORK, None, "a")
    library.keep_draft(path, "<b/>", None, "b")
    opened = library.open(path)
    assert (opened["text"], texts_of(opened)) == (NETWORK, ["<b/>"])
    assert opened["damaged"] == [
        f"{library.start / '.one.xml.draft'}: the draft is damaged - delete it"
    ]


def texts_of(opened):
    return [one["text"] for one in opened["drafts"]]


def test_each_page_has_a_draft_that_no_other_replaces_or_deletes(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    times = iter(range(100))
    library = Library(lambda: float(next(times)), start=tmp_path)
    path = str(tmp_path / "one.xml")
    mark = library.save(path, NETWORK, None)["mark"]
    for page in ("", "a", "b"):
        library.keep_draft(path, f"<of{page}/>", mark, page)
    names = {file.name for file in tmp_path.glob(".*.draft")}
    assert names == {".one.xml.draft", ".one.xml.a.draft", ".one.xml.b.draft"}
    assert all(file.stat().st_mode & 0o077 == 0 for file in tmp_path.glob(".*.draft"))
    assert texts_of(library.open(path)) == ["<ofb/>", "<ofa/>", "<of/>"]
    assert library.open(path)["draft"]["text"] == "<ofb/>"
    mark = library.save(path, "<ofa/>", mark, "a")["mark"]
    assert texts_of(library.open(path)) == ["<ofb/>", "<of/>"]
    library.save(path, NETWORK, mark)
    assert texts_of(library.open(path)) == ["<ofb/>"]
    library.keep_draft(str(tmp_path / "one.xml.xml"), "<other/>", None, "b")
    assert texts_of(library.open(path)) == ["<ofb/>"]


def test_a_text_of_a_page_that_comes_late_replaces_no_later_one(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    library.keep_draft(path, "<later/>", mark, "a", "7")
    library.keep_draft(path, "<earlier/>", mark, "a", "6")
    assert texts_of(library.open(path)) == ["<later/>"]
    library.save(path, "<earlier/>", mark, "a", "6")
    assert texts_of(library.open(path)) == ["<later/>"]
    with pytest.raises(HriError, match="write digits"):
        library.keep_draft(path, "<x/>", mark, "a", "-1")


def test_a_draft_is_discarded_only_as_it_was_seen(library, path):
    library.keep_draft(path, "<seen/>", None, "a", "1")
    (row,) = library.open(path)["drafts"]
    library.keep_draft(path, "<more/>", None, "a", "2")
    library.drop_draft(path, "a", row["seen"])
    (row,) = library.open(path)["drafts"]
    assert row["text"] == "<more/>"
    assert library.watch(path, "", "a") == {"mark": None, "has_draft": True}
    library.drop_draft(path, "a", row["seen"])
    assert library.watch(path, "", "a") == {"mark": None, "has_draft": False}


def test_a_draft_that_the_file_has_word_by_word_is_gone(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    library.keep_draft(path, NETWORK, mark, "a")
    assert library.open(path)["drafts"] == []
    assert list(library.start.glob(".*.draft")) == []


def test_of_too_many_drafts_only_what_is_elsewhere_too_is_dropped(library, path):
    mark = library.save(path, NETWORK, None)["mark"]
    for number in range(drafts.MOST - 2):
        library.keep_draft(path, f"<n{number}/>", mark, f"p{number}")
    library.keep_draft(path, "<n0/>", mark, "same")
    library.keep_draft(path, NETWORK, mark, "file")
    library.keep_draft(path, "<new/>", mark, "new")
    library.keep_draft(path, "<newer/>", mark, "newer")
    with pytest.raises(HriError, match="open it in another tab and discard one"):
        library.keep_draft(path, "<newest/>", mark, "newest")
    library.keep_draft(path, "<newer2/>", mark, "newer")
    library.keep_draft(path, "<n1/>", mark, "continues")
    found = texts_of(library.open(path))
    assert len(found) == drafts.MOST
    kept = {f"<n{number}/>" for number in range(drafts.MOST - 2)} | {"<new/>", "<newer2/>"}
    assert set(found) == kept


def test_drafts_are_found_wherever_they_could_be_kept(library, path, monkeypatch):
    mark = library.save(path, NETWORK, None)["mark"]
    library.keep_draft(path, "<beside/>", mark, "a")
    monkeypatch.setattr(files, "_is_open", lambda path: False)
    library.keep_draft(path, "<apart/>", mark, "b")
    assert set(texts_of(library.open(path))) == {"<beside/>", "<apart/>"}
    long = str(library.start / ("x" * 240 + ".xml"))
    library.keep_draft(long, "<long/>", None, "a")
    assert texts_of(library.open(long)) == ["<long/>"]


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("{start}/.xml", "has no name"),
        ("{start}/sub/", "has no name"),
        ("{start}/.xml.xml", "is a hidden file"),
        ("{start}/../one.xml", "is not in a folder of networks"),
        ("{start}/a/../../one.xml", "is not in a folder of networks"),
        ("/etc/one.xml", "is not in a folder of networks"),
        ("{start}/~/one.xml", "write the path of your folder out"),
        ("{start}/there.xml", "already exists"),
        ("{start}/drafted.xml", "already exists"),
        ("{start}/closed/one.xml", "choose another folder"),
    ],
)
def test_a_network_begins_only_where_it_can_be_saved(library, monkeypatch, name, why):
    monkeypatch.setattr(
        files, "why_not", lambda path: "write-protected" if "closed" in str(path) else ""
    )
    (library.start / "there.xml").write_text(NETWORK)
    library.keep_draft(str(library.start / "drafted.xml"), NETWORK, None, "a")
    with pytest.raises(HriError, match=why):
        library.new(name.format(start=library.start))
    good = f"{library.start}/sub/../two.xml"
    assert library.new(good) == {"path": str(library.start / "two.xml")}


def test_a_page_has_a_short_plain_name(library, path):
    library.save(path, NETWORK, None)
    for page in ("../x", "A", "a.b", "x" * 33, "ä"):
        for work in (library.keep_draft, library.save):
            with pytest.raises(HriError, match="names no page"):
                work(path, "<gone/>", None, page)
    assert library.open(path)["text"] == NETWORK


@pytest.mark.parametrize(
    "name",
    [
        "",
        "one",
        "one.txt",
        "one.xml",
        "/etc/passwd",
        "/etc/one.xml",
        "{start}/../../one.xml",
        "{start}/one.xml\0",
        "{start}/link.xml",
        "~/one.xml",
        "/" * 5000 + "x.xml",
        "{start}/" + "x" * 5000 + ".xml",
        "{start}/\ud800.xml",
    ],
)
def test_other_files_are_not_its_business(library, tmp_path, name):
    (tmp_path / "secret.xml").write_text(NETWORK)
    (library.start / "link.xml").symlink_to(tmp_path / "secret.xml")
    (library.start / "one.xml").write_text(NETWORK)
    path = name.format(start=library.start)
    for work in (
        lambda: library.open(path),
        lambda: library.save(path, "<gone/>", None),
        lambda: library.keep_draft(path, "<gone/>", None),
    ):
        with pytest.raises(HriError):
            work()
    assert (tmp_path / "secret.xml").read_text() == NETWORK
    assert (library.start / "one.xml").read_text() == NETWORK


def test_what_is_not_a_network_or_too_long_is_refused(library, path):
    (library.start / "one.xml").write_bytes(b"\xff\xfe")
    with pytest.raises(HriError, match="save it as UTF-8"):
        library.open(path)
    for text in ("x" * (LARGEST + 1), "\ud800"):
        with pytest.raises(HriError):
            library.save(str(library.start / "two.xml"), text, None)
    assert not (library.start / "two.xml").exists()


def test_the_networks_of_apps_and_of_the_built_in_folders_are_listed(library):
    listed = library.listed()
    assert listed["home"] == str(library.start)
    names = {(one["app"], one["name"]) for one in listed["networks"]}
    assert {("companion", "moving"), ("companion", "face"), (None, "follow")} <= names
    kinds = {one["kind"] for one in listed["networks"]}
    assert kinds == {"app", "network", "primitive"}
    assert library.app("companion")["networks"][0].endswith("feeling.xml")


def test_drafts_that_come_all_at_once_leave_a_whole_one(library, path):
    texts = [NETWORK + number * "\n" for number in range(40)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda text: library.keep_draft(path, text, None), texts))
    assert library.open(path)["draft"]["text"] in texts


def test_drafts_of_many_pages_that_come_all_at_once_are_all_there(library, path):
    pages = [f"p{number}" for number in range(drafts.MOST)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda page: library.keep_draft(path, f"<{page}/>", None, page), pages))
    assert set(texts_of(library.open(path))) == {f"<{page}/>" for page in pages}
