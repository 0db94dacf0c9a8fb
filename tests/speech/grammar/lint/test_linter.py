from __future__ import annotations

import time
from pathlib import Path

import pytest

from hri.core.errors import NotAvailable
from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.lint.linter import check
from hri.speech.grammar.lint.overwriting import overwritten
from hri.speech.grammar.phrases import phrases_of_rules
from hri.speech.pronunciation.lexicon import VARIABLE, load_lexicon

HOUSE = Path(__file__).resolve().parents[4]


@pytest.fixture(autouse=True)
def own_folders(tmp_path, monkeypatch):
    """Nobody's lexicon and nobody's cache."""
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.mark.parametrize(
    ("rules", "place", "what", "remedy"),
    [
        ("public <a> = go forward;\n<b> = never;", "4:1", "<b> is not used", "use it"),
        ("public <a> = go forward | go forward;", "3:27", "stands twice", "take the second"),
        ("public <a> = (go | move) on | go on;", "3:31", "is said already", "take the second"),
        ("public <a> = go on | (go {x=1}) on;", "3:22", "its tags will not count", "take the"),
        ("public <a> = go forward | /0/ forward;", "3:31", "weight 0", "raise"),
        ("public <a> = go (forward | away <VOID>);", "3:28", "can never be said", "take it out"),
        ("public <a> = [go forward];", "3:1", "allows silence", "at least one word"),
        ("public <a> = go forwrd;", "3:17", '"forwrd" is in no', 'did you mean "forward"?'),
        ("public <a> = go robotarm;", "3:17", '"robotarm" is in no', 'write "robot arm"?'),
        ("public <a> = go forward 10;", "3:25", '"10" is in no', 'write numbers as words, "ten"'),
        ("public <a> = go forward 7 times;", "3:25", '"7" is in no', 'numbers as words, "seven"'),
        ("public <a> = turn_on that;", "3:14", '"turn_on" is in no', 'write "turn on"?'),
        (
            "import <color.*>;\npublic <a> = go on;",
            "3:1",
            "is not a command",
            "write public <name> =",
        ),
        ("import <color.color>;\npublic <a> = go on;", "3:1", "is imported", "<color.color>;"),
        (
            "import <numbers.small>;\npublic <a> = from <small> to <small>;",
            "4:30",
            'the second "number" replaces the first',
            "<numbers.small> {first=$number}",
        ),
        (
            "public <a> = make it big {size=big} twice {size*=2};",
            "3:37",
            '"size*=" does nothing, for size is a text',
            "give size a number",
        ),
        (
            "public <a> = go very fast {speed*=2};",
            "3:22",
            '"speed*=" does nothing, for nothing gives',
            "{speed=1}",
        ),
        (
            "public <a> = go on {w=so} more {n=1} here {n*=$w};",
            "3:38",
            '"n*=" does nothing, for $w is a text',
            "give w a number",
        ),
        (
            "public <a> = put on ham {top=ham} and more {top+=2};",
            "3:39",
            '"top+=" collects texts, for top is a text, and adds nothing',
            'in quotes, "2"',
        ),
        ("public <a> = go forward | no;", "3:27", '"no" is very short', "longer"),
        (
            "public <b> = say no to it;\npublic <a> = no no | no {x=1};",
            "4:22",
            '"no" is very short',
            "longer",
        ),
        ("/** @carefull */ public <a> = go on;", "3:5", "mark @carefull", 'mean "careful"?'),
        ("/** @careful */ <b> = on;\npublic <a> = go <b>;", "3:5", "says nothing here", "public"),
        (
            "public <a> = turn left {x=1};\npublic <b> = turn (left | right);",
            "3:1",
            '"turn left" means <a> {x=1}, and also <b>',
            "only the first counts",
        ),
    ],
)
def test_warnings_have_their_place(write, rules, place, what, remedy):
    findings = check(load_grammar(write(rules)), load_lexicon())
    finding = next(finding for finding in findings if what in finding.what)

    assert finding.severity == "warning"
    assert f"{finding.place.line}:{finding.place.column}" == place
    assert remedy in finding.remedy


@pytest.mark.parametrize(
    "rules",
    [
        "public <a> = from <small> {x=$number} to <small> {y=$number};",
        "public <a> = from <small> to <small> {y=$number};",
        "public <a> = go (<small> | to <small>);",
        "public <a> = go <small> feet [and {feet=$number} <small> {inches=$number} inches];",
        "public <a> = say <digits> (and <color> {c+=$color})*;",
        "public <a> = <list>;\n<list> = <color> {c+=$color} | <color> {c+=$color} and <list>;",
        "public <a> = turn left {angle=90} [<small> degrees {angle=$number}];",
    ],
)
def test_only_values_that_are_lost_are_told(write, rules):
    imports = "import <numbers.*>;\nimport <color.color>;\n"
    findings = check(load_grammar(write(imports + rules)))
    lost = [finding for finding in findings if "replaces the first" in finding.what]

    assert len(lost) == ("to <small> {y" in rules and "{x" not in rules)


@pytest.mark.parametrize(
    ("rules", "place", "remedy"),
    [
        (
            "public <a> = <list>;\n<list> = <color> | <color> and <list>;",
            "5:32",
            "<list> {first=$color}, or collect them, {all+=$color}",
        ),
        ("public <a> = say it (and <color> {c=$color})*;", "4:26", "collect them, {c+=$color}"),
        (
            "public <a> = coffee {drink=coffee} and tea {drink=tea};",
            "4:40",
            "give each its own name, or collect them, {drink+=tea}",
        ),
        ("public <a> = <color> or <paint>;\n<paint> = any (red {color=r} | blue);", "4:25", "name"),
        ("public <a> = [red {color=r}] or blue {color=b};", "4:33", "{color+=b}"),
        ("public <a> = (red {x=1} | blue {x=2}) {x=3};", "4:15", "collect them"),
        ("public <a> = red wine {x=red x=wine};", "4:18", "{x+=red x+=wine}"),
    ],
)
def test_a_value_that_another_part_replaces_is_told(write, rules, place, remedy):
    findings = check(load_grammar(write("import <color.color>;\n" + rules)))
    (finding,) = [finding for finding in findings if "replaces the first" in finding.what]

    assert f"{finding.place.line}:{finding.place.column}" == place
    assert remedy in finding.remedy


def test_a_part_that_may_be_said_again_and_again_keeps_its_last_value(write):
    rules = "import <color.color>;\npublic <a> = paint it <color> (and <color>)*;"
    (finding,) = check(load_grammar(write(rules)))

    assert 'the second "color" replaces the first' in finding.what


def test_a_very_long_row_of_rules_is_looked_through_at_once(write):
    row = "<small> x {a+=$number} " * 5_000
    grammar, _ = read_grammar(write(f"import <numbers.small>;\npublic <a> = {row};"))
    start = time.process_time()
    assert list(overwritten(grammar, grammar.rules.values())) == []
    assert time.process_time() - start < 0.5


def test_words_of_imported_files_that_nobody_can_say_are_not_told(write):
    write("public <b> = go on;\npublic <c> = xyzzy plugh;", "other")
    path = write("import <other.b>;\npublic <a> = <b>;")

    assert check(load_grammar(path), load_lexicon()) == []


def test_a_list_of_names_that_no_rule_uses_is_told(write):
    path = write('import "names.txt" as <friend>;\npublic <a> = go on;')
    path.with_name("names.txt").write_text("robin\n")
    (finding,) = check(load_grammar(path))

    assert str(finding.place) == f"{path}:3:1"
    assert finding.what == "<friend> is not used by any rule"


@pytest.mark.parametrize(
    ("rules", "severities"),
    [
        ("public <a> = stop;", ["note"]),
        ("public <a> = lights;", ["note"]),
        ("public <a> = no;", ["warning"]),
        ("/** @answer */ public <a> = stop;", []),
        ("public <a> = robot stop;", []),
    ],
)
def test_a_command_of_one_word_is_worth_a_note_and_a_short_one_a_warning(write, rules, severities):
    findings = check(load_grammar(write(rules)), load_lexicon())
    assert [finding.severity for finding in findings] == severities


def test_a_good_grammar_gets_no_advice(write):
    rules = "/** @example go forward */ public <a> = go (forward | back) | turn around;"
    assert check(load_grammar(write(rules)), load_lexicon()) == []


@pytest.mark.parametrize(
    "path",
    [
        *sorted((HOUSE / "grammars").glob("*.jsgf")),
        *sorted((HOUSE / "hri" / "bench" / "speech").glob("*.jsgf")),
        *sorted((HOUSE / "docs" / "tutorials").rglob("*.jsgf")),
    ],
    ids=lambda path: path.stem,
)
def test_the_grammars_of_the_house_get_no_warnings(path):
    findings = check(load_grammar(path), load_lexicon())
    assert [finding for finding in findings if finding.severity in ("error", "warning")] == []


def test_parts_of_other_grammars_may_mean_the_same_but_not_two_things_alone(write):
    part = "/** @part */ public <{}> = big one {{n={}}}{};\n"
    parts = part.format("a", 1, "") + part.format("b", 2, "")
    assert check(load_grammar(write(parts))) == []

    found = check(load_grammar(write(part.format("a", 1, " | big one {n=2}"))))
    assert any("means <a> {n=1}, and also <a> {n=2}" in finding.what for finding in found)

    (found,) = check(load_grammar(write(parts + "public <c> = big one;")))
    assert "means <a> {n=1}, and also <c>" in found.what


def test_meanings_are_told_as_grammars_write_them(write):
    rules = 'public <a> = go on {n=1234567.5 x};\npublic <b> = go on {x="a b"};'
    (finding,) = check(load_grammar(write(rules)))
    assert '<a> {n=1234567.5 x=true}, and also <b> {x="a b"}' in finding.what


@pytest.mark.parametrize("mark", ["answer", "wake", "part"])
def test_a_rule_that_has_to_be_short_may_be(write, mark):
    rules = f"/** @{mark} */ public <a> = no | yes;\npublic <b> = go forward;"
    assert check(load_grammar(write(rules)), load_lexicon()) == []


def test_an_example_that_is_not_understood_is_an_error(write):
    rules = (
        "/** @example go back\n * @example go forward */\npublic <a> = go forward;\n"
        "/** @example turn left */ public <b> = turn <side>;\n"
        "/** @example left\n @example up */ <side> = left | right;"
    )
    findings = check(load_grammar(write(rules)))

    assert [(finding.severity, finding.place.line) for finding in findings] == [
        ("error", 3),
        ("error", 8),
    ]
    assert '<a> does not allow its example "go back"' in findings[0].what


def test_an_example_must_be_understood_by_its_own_rule(write):
    rules = "/** @example stop it */ public <a> = go forward;\npublic <b> = stop it;"
    (finding,) = check(load_grammar(write(rules)))
    assert "does not allow" in finding.what


def test_names_nobody_knows_are_a_hint_with_a_line_for_the_lexicon(write):
    findings = check(load_grammar(write("public <a> = call zorblax;")), load_lexicon())

    (finding,) = findings
    assert finding.severity == "hint"
    assert '"Z AO R B L AE K S"' in finding.remedy
    assert "lexicon.txt" in finding.remedy


def test_without_a_voice_to_ask_an_unknown_word_is_a_hint(write, monkeypatch):
    def missing():
        raise NotAvailable("espeak-ng is missing - install it")

    monkeypatch.setattr("hri.speech.pronunciation.letter_to_sound.load_espeak", missing)
    (finding,) = check(load_grammar(write("public <a> = call zorblax;")), load_lexicon())

    assert (finding.severity, finding.what) == ("hint", '"zorblax" is in no dictionary')


def test_a_word_nobody_can_say_is_an_error(write):
    (finding,) = check(load_grammar(write("public <a> = call 친구;")), load_lexicon())
    assert (finding.severity, str(finding.place).rsplit(":", 2)[1:]) == ("error", ["3", "19"])


def test_a_list_of_names_is_not_told_name_by_name(write):
    letters = "abcdefghij"
    names = " | ".join(f"zq{a}{b}x" for a in letters for b in letters)
    findings = check(load_grammar(write(f"public <a> = call ({names});")), load_lexicon())

    assert len(findings) == 21
    assert "80 more words" in findings[-1].what


def test_many_short_commands_are_not_told_one_by_one(write):
    rules = "public <a> = red | blue | green | right | up | down | white | teal;"
    findings = check(load_grammar(write(rules)), load_lexicon())

    assert [finding.severity for finding in findings] == ["warning"] * 6 + ["note"]
    assert findings[5].what == "2 more commands are as short"
    assert findings[6].what.startswith('"green" is one word')


def test_a_rule_that_moves_the_robot_and_sounds_like_another_is_told(write):
    rules = (
        "/** @careful */ public <a> = go to the bedroom;\npublic <b> = go to the bathroom;\n"
        "public <c> = what time is it;"
    )
    (finding,) = check(load_grammar(write(rules)), load_lexicon())

    assert finding.severity == "hint"
    assert '"go to the bedroom" sounds much like "go to the bathroom" <b>' in finding.what


def test_two_meanings_are_found_wherever_they_hide(write):
    rules = (
        "public <a> = please fetch <thing> from the <room>;\n"
        + "<thing> = "
        + " | ".join(f"the {word} {{what={word}}}" for word in ("ball", "cup", "book", "pen"))
        + " | the ball {what=toy};\n<room> = kitchen | garden | hall | cellar;"
    )
    findings = check(load_grammar(write(rules)))

    told = [finding for finding in findings if "and also" in finding.what]
    assert len(told) == 1
    assert "<a> {what=ball}, and also <a> {what=toy}" in told[0].what


def test_no_ambiguity_hides_another(write):
    rules = "import <numbers.small>;\n" + "".join(
        f"public <{name}{number}> = {words} {{{name}={number}}} please;\n"
        for name, words in (("a", "turn the light on"), ("b", "turn the light off"), ("c", "go"))
        for number in (1, 2)
    )
    harmless = (
        "public <go> = walk <small> meters | please [now] walk <small> meters |"
        " please walk <small> meters;\n"
    )
    findings = check(load_grammar(write(rules + harmless)))

    told = [finding.what for finding in findings if "and also" in finding.what]
    assert [what[:20] for what in told] == [
        '"go please" means <c',
        '"turn the light on p',
        '"turn the light off ',
    ]


def test_two_ways_to_one_meaning_are_no_ambiguity(write):
    rules = "public <a> = [please] (go on | go (on | back)) [please | now];"
    assert not any("and also" in finding.what for finding in check(load_grammar(write(rules))))


def test_the_keyboard_may_share_a_sentence_with_the_ear(write):
    typed = "/** @typed\n * @as stop */ public <urgent> = watch out | get going;\n"
    spoken, stop = "public <warn> = watch out;\n", "public <stop> = stop that now;\n"
    for rules in (stop + typed + spoken, stop + spoken + typed):
        assert not any("and also" in one.what for one in check(load_grammar(write(rules))))


def test_errors_hide_warnings_and_come_alone(write):
    grammar, _ = read_grammar(write("public <a> = <b>;\n<c> = go;"))

    (finding,) = check(grammar, load_lexicon())

    assert finding.severity == "error"
    assert "no rule <b>" in finding.what


def test_the_worst_comes_first(write):
    rules = "public <a> = call zorblax;\n<b> = never;\n/** @example x */ public <c> = go forward;"
    severities = [finding.severity for finding in check(load_grammar(write(rules)), load_lexicon())]
    assert severities == ["error", "warning", "hint"]


def test_a_thousand_rules_are_checked_at_once(write):
    rules = "".join(f"<r{n}> = go <r{n + 1}> | no [<r{n + 1}>];\n" for n in range(1000))
    path = write(f"public <a> = <r0> forward;\n{rules}<r1000> = go;")

    start = time.process_time()
    grammar, errors = read_grammar(path)
    assert not errors
    check(grammar, load_lexicon())
    assert time.process_time() - start < 2.0


def test_the_sounds_of_another_language_are_of_no_concern(tmp_path):
    path = tmp_path / "lamp.jsgf"
    both = ["error", "error", "warning"]
    for locale, severities in ((" ko", ["warning"]), ("", ["warning"]), (" en", both)):
        path.write_text(f"#JSGF V1.0 UTF-8{locale};\ngrammar lamp;\npublic <a> = 불을 켜;\n")
        found = check(load_grammar(path), load_lexicon())
        assert [one.severity for one in found] == severities
        assert "this grammar is in Korean, and only Vosk" in found[-1].what


def test_thousands_of_alternatives_are_checked_in_a_moment(write):
    words = [f"{a}{b}{c}" for a in "bdfgklmnp" for b in "aeiou" for c in "bdfgklmnprst"]
    choices = " | ".join(f"{one} {two}" for one in words[:60] for two in words[:100])
    grammar, _ = read_grammar(write(f"public <a> = {choices};"))
    begun = time.process_time()
    check(grammar, load_lexicon())
    assert time.process_time() - begun < 5.0


def test_thousands_of_examples_are_tried_at_once(write):
    examples = "".join(f" * @example left {number}\n" for number in range(1500))
    others = "".join(f"<c{number}> = other{number};\n" for number in range(300))
    path = write(f"public <a> = go <b>;\n{others}/** A side.\n{examples} */\n<b> = left | right;")
    grammar, _ = read_grammar(path)

    start = time.process_time()
    assert len([found for found in check(grammar) if found.severity == "error"]) == 1500
    assert time.process_time() - start < 1.5


def test_long_alternatives_of_large_rules_are_compared_at_once(write):
    clock = " | ".join(f"hour{number % 24} minute{number}" for number in range(1400))
    choices = " | ".join(["<b> <b>"] * 30)
    grammar, _ = read_grammar(write(f"public <a> = {choices};\n<b> = {clock};"))

    start = time.process_time()
    assert not phrases_of_rules(grammar, 3)["a"].is_all
    assert time.process_time() - start < 1.0


@pytest.mark.parametrize(
    "rules",
    [
        "public <a> = twenty more {n+=20} times two {n*=2};",
        "public <a> = give me {k=2} hundred of them {n=$k} {n*=100};",
        "public <a> = with ham and {t+=ham} three {t+=3} of it;",
        "public <a> = half way {n*=0.5} | ten ways {n=10};",
    ],
)
def test_operators_that_may_apply_are_not_told(write, rules):
    findings = check(load_grammar(write(rules)), load_lexicon())
    assert not [finding for finding in findings if '="' in finding.what]
