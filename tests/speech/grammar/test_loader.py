from __future__ import annotations

import pytest

from hri.core.errors import AuthoringError, HriError
from hri.speech.grammar import analysis, load_grammar, read_grammar
from hri.speech.grammar.loader import MOST_FILES
from hri.speech.grammar.matching import parse


@pytest.fixture
def put(tmp_path):
    """Writes a file below the test's folder, a grammar with the header its name asks for."""

    def put(file: str, rules: str, name: str | None = None):
        path = tmp_path / file
        path.parent.mkdir(parents=True, exist_ok=True)
        is_list = path.suffix == ".txt"
        head = "" if is_list else f"#JSGF V1.0;\ngrammar {name or path.stem};\n"
        path.write_text(head + rules, encoding="utf-8")
        return path

    return put


def places(errors):
    return [f"{e.place.path.name}:{e.place.line}:{e.place.column}" for e in errors]


@pytest.mark.parametrize(
    ("main", "other"),
    [
        ("a.jsgf", "colors.jsgf"),
        ("a.jsgf", "com/acme/colors.jsgf"),
        ("com/acme/apps/a.jsgf", "com/acme/colors.jsgf"),
        ("sub/a.jsgf", "path/grammars/com/acme/colors.jsgf"),
        ("sub/a.jsgf", "path/com/acme/colors.jsgf"),
    ],
)
def test_imports_are_found_by_package(put, tmp_path, monkeypatch, main, other):
    monkeypatch.setenv("HRI_PATH", str(tmp_path / "path"))
    put(other, "public <red> = red;", "com.acme.colors")
    path = put(main, "import <com.acme.colors.red>;\npublic <a> = <red>;", "com.acme.apps.a")

    assert parse(load_grammar(path), "red").rule == "a"


@pytest.mark.parametrize(
    ("main", "other", "grammar"),
    [
        ("main.gram", "polite.gram", "polite"),
        ("main.jsgf", "polite.gram", "polite"),
        ("main.gram", "polite.jsgf", "polite"),
        ("main.grm", "polite.grm", "polite"),
        ("main", "polite", "polite"),
        ("main.gram", "polite.gram", "com.acme.polite"),
        ("main.gram", "com/acme/polite.gram", "com.acme.polite"),
        ("main.gram", "path/com/acme/polite.gram", "com.acme.polite"),
        ("main.gram", "path/grammars/polite.gram", "polite"),
    ],
)
def test_imports_are_found_whatever_their_suffix(put, tmp_path, monkeypatch, main, other, grammar):
    monkeypatch.setenv("HRI_PATH", str(tmp_path / "path"))
    put(other, "public <p> = please;", grammar)
    path = put(main, f"import <{grammar}.p>;\npublic <c> = <p> open the door;")

    assert parse(load_grammar(path), "please open the door").rule == "c"


def test_of_two_suffixes_that_of_the_importing_file_counts(put):
    put("polite.gram", "public <p> = please;")
    put("polite.jsgf", "public <p> = kindly;")
    rules = "import <polite.p>;\npublic <c> = <p> go;"

    assert parse(load_grammar(put("main.gram", rules)), "please go")
    assert parse(load_grammar(put("main.jsgf", rules)), "kindly go")


def test_packages_begin_at_the_main_file_as_for_sphinx(put):
    """An imported file need not say its own package."""
    put("com/acme/words.gram", "public <red> = red;")
    put("com/other/things.gram", "import <com.acme.words.red>;\npublic <thing> = <red> ball;")
    path = put("main.gram", "import <com.other.things.thing>;\npublic <c> = get the <thing>;")

    assert parse(load_grammar(path), "get the red ball").rule == "c"


@pytest.mark.parametrize("suffix", [".gram", ".jsgf", ".grm"])
def test_a_missing_import_is_named_as_its_file_would_be(put, suffix):
    path = put(f"main{suffix}", "import <polite.p>;\npublic <c> = <p> go;")
    with pytest.raises(HriError, match=f'no grammar "polite" - put polite{suffix} into the same'):
        load_grammar(path)
    put("polite.grxml", "")
    with pytest.raises(HriError, match=f"name polite.grxml polite{suffix} if it is JSGF"):
        load_grammar(path)
    put(f"politte{suffix}", "public <p> = please;")
    with pytest.raises(HriError, match='no grammar "polite" - did you mean "politte"'):
        load_grammar(path)


@pytest.mark.parametrize("name", ["red", "colors.red", "com.acme.colors.red"])
def test_an_imported_rule_has_three_names(put, name):
    put("colors.jsgf", "public <red> = red;", "com.acme.colors")
    path = put("a.jsgf", f"import <com.acme.colors.*>;\npublic <a> = <{name}>;")

    assert parse(load_grammar(path), "red").rule == "a"


def test_a_full_name_needs_no_import(put):
    put("com/acme/colors.jsgf", "public <red> = <dark> red;\n<dark> = dark;", "com.acme.colors")
    path = put("a.jsgf", "public <a> = <com.acme.colors.red> | <com.acme.colors.dark>;")

    _, errors = read_grammar(path)

    assert places(errors) == ["a.jsgf:3:38"]
    assert '<dark> of "com.acme.colors" is not public - write "public"' in str(errors[0])


def test_own_rules_hide_imported_ones(put):
    put("colors.jsgf", "public <red> = crimson;")
    path = put("a.jsgf", "import <colors.*>;\npublic <a> = <red> <colors.red>;\n<red> = ruby;")

    assert parse(load_grammar(path), "ruby crimson").rule == "a"


def test_a_name_that_two_grammars_bring_must_be_said_in_full(put):
    put("wines.jsgf", "public <red> = merlot;")
    put("colors.jsgf", "public <red> = crimson;")
    rules = "import <wines.*>;\nimport <colors.*>;\npublic <a> = <wines.red> | {};"
    fine = put("fine.jsgf", rules.format("<colors.red>"))
    wrong = put("wrong.jsgf", rules.format("<red>"))

    assert parse(load_grammar(fine), "merlot").rule == "a"
    with pytest.raises(AuthoringError, match=r"5:28: <red> is imported twice - say which: <wines"):
        load_grammar(wrong)


def test_files_of_one_name_in_two_folders_stay_apart(put):
    put("x/colors.jsgf", "public <red> = crimson;", "x.colors")
    put("y/colors.jsgf", "public <red> = ruby;", "y.colors")
    path = put("a.jsgf", "public <a> = <x.colors.red> <y.colors.red>;")

    assert parse(load_grammar(path), "crimson ruby").rule == "a"


def test_rules_of_the_main_file_are_unknown_to_imported_ones(put):
    put("colors.jsgf", "public <red> = <shade> red;")
    path = put("a.jsgf", "import <colors.red>;\npublic <a> = <red>;\n<shade> = dark;")

    grammar, errors = read_grammar(path)

    assert not errors
    assert places(analysis.errors(grammar)) == ["colors.jsgf:3:16"]


def test_all_mistakes_are_told_at_once_and_nothing_that_follows_from_them(put):
    put("colors.jsgf", "public <red> = (crimson;\npublic <blue> = navy;")
    path = put(
        "a.jsgf",
        "import <colors.*>;\nimport <colours.green>;\n"
        "public <a> = <red> | <broken> | <green> | <blue> | <colours.pink>;\n"
        "<broken> = x | ;\n<c> = [y;\npublic <d> = z) z;\n",
    )

    grammar, errors = read_grammar(path)

    assert sorted(places(errors)) == [
        "a.jsgf:4:1", "a.jsgf:6:16", "a.jsgf:7:9", "a.jsgf:8:15", "colors.jsgf:3:24",
    ]  # fmt: skip
    assert any('did you mean "colors"?' in str(error) for error in errors)
    assert analysis.errors(grammar) == []


@pytest.mark.parametrize("name", ["distanc", "angl", "smal"])
def test_a_slip_in_the_name_of_an_imported_rule_is_mended_with_the_name_to_write(put, name):
    path = put("a.jsgf", f"import <distance.*>;\npublic <a> = go <{name}>;\n<g> = y;")

    (error,) = analysis.errors(read_grammar(path)[0])

    whole = {"distanc": "distance", "angl": "angle", "smal": "small"}[name]
    assert error.remedy == f'did you mean "{whole}"?'


def test_too_many_files_are_refused(put):
    for number in range(MOST_FILES + 1):
        put(f"g{number}.jsgf", f"import <g{number + 1}.*>;\npublic <r> = x;")

    with pytest.raises(AuthoringError, match=f"more than {MOST_FILES} grammar files"):
        load_grammar(put("a.jsgf", "import <g0.r>;\npublic <a> = <r>;"))


@pytest.mark.parametrize("encoding", ["UTF-8", "UTF-16", "ISO-8859-1", "windows-1252", "latin1"])
def test_encodings_of_text_are_read(tmp_path, encoding):
    path = tmp_path / "a.jsgf"
    text = f"#JSGF V1.0 {encoding} de;\ngrammar a;\npublic <a> = größer;\n"
    path.write_bytes(text.encode(encoding))

    assert load_grammar(path).words() == {"größer"}


@pytest.mark.parametrize("encoding", ["hex", "zlib", "punycode", "idna", "no-such"])
def test_what_encodes_no_text_is_refused(tmp_path, encoding):
    path = tmp_path / "a.jsgf"
    text = f"#JSGF V1.0 {encoding} de;\ngrammar a;\npublic <a> = größer;\n"
    path.write_bytes(text.encode("latin-1"))

    with pytest.raises(AuthoringError, match="unknown encoding"):
        load_grammar(path)


@pytest.mark.parametrize(
    ("declared", "real", "words", "doubt"),
    [
        ("ISO8859-1", "utf-8", "café éteins", "the header says ISO8859-1, but this file is UTF-8"),
        ("iso-8859-15", "utf-8-sig", "café", "says iso-8859-15, but this file is UTF-8"),
        ("windows-1252", "utf-8", "größer", "says windows-1252, but this file is UTF-8"),
        ("KOI8-R", "utf-8", "стоп", "says KOI8-R, but this file is UTF-8"),
        ("US-ASCII", "utf-8", "café", "says US-ASCII, but this file is UTF-8"),
        ("JIS", "utf-8", "停止", "says JIS, but this file is UTF-8"),
        ("Shift_JIS", "utf-8", "停止 進め", "says Shift_JIS, but this file is UTF-8"),
        ("GB2312", "utf-8", "打开 灯", "says GB2312, but this file is UTF-8"),
        ("UTF-16", "utf-8", "café", "says UTF-16, but this file is UTF-8"),
        ("UTF-16", "ascii", "stop", "says UTF-16, but this file is UTF-8"),
        ("utf9", "utf-8", "café", 'unknown encoding "utf9", read as UTF-8'),
        ("no-such", "ascii", "stop", 'unknown encoding "no-such", read as UTF-8'),
        ("ISO8859-1", "cp1252", "don\u2019t", "says ISO8859-1, but this file is cp1252"),
        ("GB2312", "gb18030", "镕", "says GB2312, but this file is gb18030"),
        ("ISO8859-1", "latin-1", "café", None),
        ("ISO8859-1", "ascii", "stop", None),
        ("ISO-8859-5", "iso8859-5", "стоп", None),
        ("KOI8-R", "koi8-r", "стоп", None),
        ("windows-1251", "cp1251", "вперёд стоп", None),
        ("JIS", "iso2022_jp", "停止", None),
        ("Shift_JIS", "shift_jis", "停止 進め", None),
        ("EUC-KR", "euc_kr", "정지", None),
        ("GBK", "gbk", "打开 灯", None),
        ("Big5", "big5", "開燈", None),
        ("UTF-16", "utf-16", "café", None),
        ("UTF-16", "utf-16-le", "café", None),
        ("UTF-16BE", "utf-16-be", "café", None),
    ],
)
def test_the_bytes_of_a_file_say_more_than_its_header(tmp_path, declared, real, words, doubt):
    path = tmp_path / "a.jsgf"
    text = f"#JSGF V1.0 {declared} xx;\ngrammar a;\npublic <a> = {words};\n"
    path.write_bytes(text.encode(real))

    grammar = load_grammar(path)

    assert grammar.words() == set(words.replace("\u2019", "'").split())
    assert len(grammar.warnings) == (doubt is not None)
    for odd in grammar.warnings:
        assert doubt in odd.what
        assert 'write "#JSGF V1.0 UTF-8 xx;"' in odd.remedy


# ------------------------------------------------------------------ lists of names


def test_a_list_of_names_is_a_rule(put):
    put("friends.txt", "# Who?\nRobin Smith\n  the boss = Alex  # always\nroom 12 = 12\nO'Neil\n")
    path = put("a.jsgf", 'import "friends.txt" as <friend>;\npublic <call> = call <friend>;')
    grammar = load_grammar(path)

    assert parse(grammar, "call robin smith").tags == {"friend": "Robin Smith"}
    assert parse(grammar, "call the boss").tags == {"friend": "Alex"}
    assert parse(grammar, "call room 12").tags == {"friend": 12.0}
    assert parse(grammar, "call O'Neil!").tags == {"friend": "O'Neil"}
    assert parse(grammar, "call who") is None


@pytest.mark.parametrize(
    ("names", "place", "what"),
    [
        ("robin\n\n = x", "n.txt:3:2", "no spoken words"),
        ("robin =", "n.txt:1:1", 'no value behind "="'),
        ('robin = a"b', "n.txt:1:1", "a quote inside"),
        ("robin = 1\nanne\nRobin = 2", "n.txt:3:1", '"robin" has another value in line 1'),
        ("robin = 1e999", "n.txt:1:1", "too large"),
        ("x" * 300, "n.txt:1:1", "too long"),
        ("# nobody", "n.txt:1:1", "no name in this list"),
    ],
)
def test_a_mistake_in_a_list_has_its_place_in_the_list(put, names, place, what):
    put("n.txt", names)
    _, errors = read_grammar(put("a.jsgf", 'import "n.txt" as <n>;\npublic <a> = <n>;'))

    assert places(errors) == [place]
    assert what in str(errors[0])


def test_a_list_that_is_not_there_is_told_once(put):
    put("friends.txt", "robin")
    path = put("a.jsgf", 'import "frends.txt" as <n>;\npublic <a> = <n>;')

    grammar, errors = read_grammar(path)

    assert places(errors) == ["a.jsgf:3:1"]
    assert 'did you mean "friends.txt"?' in str(errors[0])
    assert analysis.errors(grammar) == []


def test_a_list_that_is_no_text_is_told(put, tmp_path):
    (tmp_path / "n.txt").write_bytes(b"robin\n\xff\xfe")
    _, errors = read_grammar(put("a.jsgf", 'import "n.txt" as <n>;\npublic <a> = <n>;'))

    assert places(errors) == ["n.txt:2:1"]


def test_a_folder_is_no_grammar(tmp_path):
    with pytest.raises(HriError, match="this is a folder - name a grammar file in it"):
        load_grammar(tmp_path)


def test_a_forgotten_import_of_a_part_is_told(put, tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path / "path"))
    put("path/grammars/rooms.jsgf", "/** @part */ public <room> = hall;\npublic <go> = go on;")
    put("path/grammars/broken.jsgf", "(((")
    path = put("a.jsgf", "public <a> = to <room> | <go> | <small>;\n<smell> = sweet;")
    grammar, _ = read_grammar(path)

    assert [error.remedy for error in analysis.errors(grammar)] == [
        "write import <rooms.room>; for the one of that grammar",
        "write <go> = words;",
        "write import <numbers.small>; for the one of that grammar",
    ]


@pytest.mark.parametrize("way", ["absolute", "upwards", "link"])
def test_a_list_is_read_from_the_grammars_folder_and_the_search_path_only(way, tmp_path):
    """A grammar may come from anybody; it must not read the machine's files."""
    (tmp_path / "secret.txt").write_text("robin\n")
    folder = tmp_path / "grammars"
    folder.mkdir()
    (folder / "link.txt").symlink_to(tmp_path / "secret.txt")
    names = {
        "absolute": str(tmp_path / "secret.txt"), "upwards": "../secret.txt", "link": "link.txt"
    }  # fmt: skip
    text = (
        f'#JSGF V1.0;\ngrammar a;\nimport "{names[way]}" as <who>;\npublic <call> = call <who>;\n'
    )
    (folder / "a.jsgf").write_text(text)
    with pytest.raises(AuthoringError, match="leads out of the grammar's folder") as refused:
        load_grammar(folder / "a.jsgf")
    assert "robin" not in str(refused.value)


def test_a_list_with_a_name_that_no_file_has_is_one_line(tmp_path):
    file = tmp_path / "a.jsgf"
    name = "a" * 300
    file.write_text(f'#JSGF V1.0;\ngrammar a;\nimport "{name}" as <who>;\npublic <a> = <who>;\n')
    with pytest.raises(AuthoringError, match="no list of names"):
        load_grammar(file)


def test_the_same_files_are_compiled_once_and_a_changed_one_again(tmp_path):
    main, colors, names = (tmp_path / name for name in ("main.jsgf", "colors.jsgf", "names.txt"))
    main.write_text(
        '#JSGF V1.0;\ngrammar main;\nimport <colors.color>;\nimport "names.txt" as <person>;\n'
        "public <see> = see <color> | ask <person>;"
    )
    colors.write_text("#JSGF V1.0;\ngrammar colors;\npublic <color> = red;")
    names.write_text("ann\n")
    first = load_grammar(main)
    assert load_grammar(main) is first
    assert first.called("Robin") is first.called("robin")

    colors.write_text("#JSGF V1.0;\ngrammar colors;\npublic <color> = tan;")
    second = load_grammar(main)
    assert set(second.sentences(9)) == {"see tan", "ask ann"}
    names.write_text("bob\n")
    assert set(load_grammar(main).sentences(9)) == {"see tan", "ask bob"}
    assert set(first.sentences(9)) == {"see red", "ask ann"}
