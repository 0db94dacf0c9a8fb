"""Digits and contractions count as the words that they stand for."""

import pytest
from hypothesis import given, strategies as st

from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse, refusal
from hri.speech.grammar.tolerance import nearest
from hri.speech.pronunciation.lexicon import load_lexicon


@pytest.fixture(scope="module")
def companion():
    return load_grammar("companion")


@pytest.fixture
def grammar(tmp_path):
    def grammar(rules):
        (tmp_path / "own.jsgf").write_text(f"#JSGF V1.0;\ngrammar own;\n{rules}\n")
        return load_grammar(tmp_path / "own.jsgf")

    return grammar


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("go forward 10 meters", "go forward ten meters"),
        ("turn left 45°", "turn left forty five degrees"),
        ("go back 120 centimeters", "go back one hundred twenty centimeters"),
        ("what's the time", "what is the time"),
        ("how's your battery", "how is your battery"),
        ("you're great", "you are great"),
        ("i don't like you", "i don't like you"),
        ("what\N{RIGHT SINGLE QUOTATION MARK}s your name", "what's your name"),
    ],
)
def test_a_typed_text_is_what_it_stands_for(companion, typed, meant):
    found = parse(companion, typed)
    assert found is not None
    assert found == parse(companion, meant)


NUMBERS = """
import <numbers.whole>; import <numbers.number>; import <numbers.ordinal>; import <numbers.digits>;
import <date.date>; import <time.time>; import <duration.duration>;
public <on> = on <date>;
public <at> = at <time>;
public <wait> = wait <duration>;
public <price> = set the price to <whole> (dollars | dollar);
public <set> = set it to <number>;
public <pay> = pay <whole> (dollars | dollar) [and <whole> {cents=$number} cents];
public <give> = give <number> (euros | pounds | yen);
public <crowd> = <whole> million people;
public <dear> = <whole> million dollars;
public <share> = <number> percent;
public <room> = the <ordinal> room;
public <dial> = dial <digits>;
"""


@pytest.fixture(scope="module")
def numbers(tmp_path_factory):
    path = tmp_path_factory.mktemp("numbers") / "n.jsgf"
    path.write_text(f"#JSGF V1.0;\ngrammar n;\n{NUMBERS}")
    return load_grammar(path)


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("set the price to 1,000 dollars", "set the price to one thousand dollars"),
        ("set the price to 1 000 dollars", "set the price to one thousand dollars"),
        ("set the price to 12\u202f345 dollars", "set the price to twelve thousand three hundred"
         " forty five dollars"),
        ("set the price to 1'000 dollars", "set the price to one thousand dollars"),
        ("set the price to 1_000 dollars", "set the price to one thousand dollars"),
        ("set the price to $1,000", "set the price to one thousand dollars"),
        ("set the price to $1,000.", "set the price to one thousand dollars"),
        ("set the price to $1 000", "set the price to one thousand dollars"),
        ("set the price to 1000$", "set the price to one thousand dollars"),
        ("set the price to 1,000 $", "set the price to one thousand dollars"),
        ("set the price to $1,000 dollars", "set the price to one thousand dollars"),
        ("set the price to $1", "set the price to one dollars"),
        ("set it to 1,000.50", "set it to one thousand point five zero"),
        ("set it to 1 000.5", "set it to one thousand point five"),
        ("set it to $1,000.50", "set it to one thousand point five zero"),
        ("set it to -5", "set it to minus five"),
        ("set it to \u22121,000", "set it to minus one thousand"),
        ("set it to -2.25", "set it to minus two point two five"),
        ("set it to +5", "set it to five"),
        ("set it to .5", "set it to zero point five"),
        ("set it to -$1,000", "set it to minus one thousand"),
        ("set it to $-5", "set it to minus five"),
        ("-10%", "minus ten percent"),
        (".5%", "zero point five percent"),
        ("set it to 2½", "set it to two and a half"),
        ("set it to -2¼", "set it to minus two and a quarter"),
        ("set it to ¾", "set it to three quarters"),
        ("on May 3", "on may third"),
        ("on May 3rd, 1984", "on may third nineteen eighty four"),
        ("on the 21st", "on the twenty first"),
        ("at 12:00", "at twelve o'clock"),
        ("at 5:00pm", "at five pm"),
        ("at 5:15 p.m.", "at five fifteen pm"),
        ("wait 1.5 hours", "wait one and a half hours"),
        ("set it to (5)", "set it to five"),
        ("pay $5.05", "pay five dollars and five cents"),
        ("pay $1,000.50", "pay one thousand dollars and fifty cents"),
        ("give €1,000", "give one thousand euros"),
        ("give 1,000 €", "give one thousand euros"),
        ("give £2.50", "give two point five zero pounds"),
        ("give ¥100", "give one hundred yen"),
        ("5 million people", "five million people"),
        ("$5 million", "five million dollars"),
        ("12,345%", "twelve thousand three hundred forty five percent"),
        ("the 3rd room", "the third room"),
        ("the 12th room", "the twelfth room"),
        ("the 40th room", "the fortieth room"),
        ("the 21st room", "the twenty first room"),
        ("dial 407", "dial four zero seven"),
        ("dial 555-1234", "dial five five five one two three four"),
    ],
)  # fmt: skip
def test_typed_numbers_are_said(numbers, typed, meant):
    found = parse(numbers, typed)
    assert found is not None
    assert found == parse(numbers, meant)


@pytest.mark.parametrize(
    "typed",
    ["set the price to -5 dollars", "set it to 1,2", "the -3rd room", "dial 1.5", "set it to 10cm"],
)
def test_no_number_changes_its_meaning_to_fit(numbers, typed):
    assert parse(numbers, typed) is None


@pytest.mark.parametrize("typed", ["9" * 5000, "1" + ",000" * 2000, "$" + "9" * 5000 + ".50"])
def test_numbers_without_end_are_refused(numbers, typed):
    assert parse(numbers, f"set it to {typed}") is None


@given(st.integers(0, 999_999), st.sampled_from(",'_ \u202f"))
def test_a_number_is_the_same_with_separators(numbers, number, separator):
    written = f"{number:,}".replace(",", separator)
    for text in (f"set it to {number}", f"set it to {written}", f"set it to ${written}"):
        assert parse(numbers, text).tags == {"number": float(number)}
    if number:
        assert parse(numbers, f"set it to -{written}").tags == {"number": -float(number)}


USA = [
    "the USA office",
    "the U.S.A. office",
    "the u.s.a office",
    "the U S A office.",
    "THE USA OFFICE",
]


@pytest.mark.parametrize(
    ("rules", "typed"),
    [
        ("public <a> = the U.S.A. office;", USA),
        ("public <a> = the USA office;", [*USA[:3], "the USA office."]),
        ("public <a> = the u s a office;", USA[1:4]),
        ("public <a> = in the U.S.A.;", ["in the USA", "in the U.S.A.", "in the U.S.A"]),
        ("public <a> = at five p.m. sharp;", ["at 5 pm sharp", "at 5pm sharp", "at 5 P.M. sharp"]),
        ("public <a> = call the Ph.D. now;", ["call the PhD now", "call the ph.d now"]),
        ("public <a> = at five pm;", ["at 5 p.m.", "at 5pm", "at 5 p.m"]),
    ],
)
def test_an_abbreviation_fits_however_it_is_written(grammar, rules, typed):
    own = grammar(rules)
    assert [text for text in typed if parse(own, text) is None] == []


def test_initials_keep_their_last_point(grammar):
    own = grammar("public <a> = call the U.S.A. and Mr. Smith now.;")
    assert own.words() == {"call", "the", "u.s.a.", "and", "mr", "smith", "now"}
    assert load_lexicon().known("u.s.a.")


def test_what_is_written_out_is_what_a_grammar_contracts(grammar):
    own = grammar("public <a> = i'd like tea | what's up;")
    assert parse(own, "I would like tea").text == "i'd like tea"
    assert parse(own, "I had like tea").text == "i'd like tea"
    assert parse(own, "what is up").text == "what's up"


def test_of_two_meanings_the_one_that_fits_counts(grammar):
    own = grammar("public <a> = i would go; public <b> = i had gone;")
    assert parse(own, "i'd go").rule == "a"
    assert parse(own, "i'd gone").rule == "b"


def test_little_words_are_forgiven_beside_digits(companion):
    assert nearest(companion, "um go forward 2 meters").parse.tags == {"distance": 2.0}


def test_a_refused_text_is_followed_as_far_as_it_goes(companion):
    refused = refusal(companion, "go forward 2 parsecs")
    assert (refused.understood, refused.word) == ("go forward two", "parsecs")


@pytest.mark.parametrize(
    "text", ["go forward 1000000 meters", "'s", "1", "i'd i'd i'd i'd i'd i'd"]
)
def test_what_stands_for_nothing_is_refused_as_before(companion, text):
    assert parse(companion, text) is None
    assert nearest(companion, text) is None


FORGIVEN = """
import "things.txt" as <thing>; import <numbers.whole>;
public <give> = give me <thing>;
public <pay> = pay <whole> (dollars | euros);
public <set> = set it to <whole> [meters];
public <many> = twenty five (things | t-shirts);
public <cold> = ice cream | hello marie curie | hello jean-luc;
"""
THINGS = "one thousand\n1,000 meters\nroom 12 = 12\nIce-Cream\nhot dog\n"


@pytest.fixture
def forgiving(tmp_path, grammar):
    (tmp_path / "things.txt").write_text(THINGS)
    return grammar(FORGIVEN)


@pytest.mark.parametrize(
    ("written", "rule", "tags"),
    [
        ("give me 1,000", "give", {"thing": "one thousand"}),
        ("give me 1 000", "give", {"thing": "one thousand"}),
        ("give me 1,000 meters", "give", {"thing": "1,000 meters"}),
        ("give me 1000 meters", "give", {"thing": "1,000 meters"}),
        ("give me one thousand meters", "give", {"thing": "1,000 meters"}),
        ("Give me Room twelve", "give", {"thing": 12.0}),
        ("give me ice cream", "give", {"thing": "Ice-Cream"}),
        ("give me a Hot-Dog", "", {}),
        ("give me Hot-Dog", "give", {"thing": "hot dog"}),
        ("pay $1,000", "pay", {"number": 1000.0}),
        ("pay $ 5", "pay", {"number": 5.0}),
        ("pay 5 $", "pay", {"number": 5.0}),
        ("pay 5\N{EURO SIGN}.", "pay", {"number": 5.0}),
        ("pay $5.00", "pay", {"number": 5.0}),
        ("set it to 12,345 meters", "set", {"number": 12345.0}),
        ("set it to 1.000 meters", "", {}),  # one, or a thousand
        ("set it to 1,0 meters", "", {}),
        ("twenty-five things", "many", {}),
        ("Twenty\N{EN DASH}five things", "many", {}),
        ("25 T shirts", "many", {}),
        ("25 tshirts", "many", {}),
        ("ice-cream", "cold", {}),
        ("Ice\N{NON-BREAKING HYPHEN}Cream!", "cold", {}),
        ("hello Marie-Curie", "cold", {}),
        ("HELLO Jean Luc", "cold", {}),
        ("hello JEAN-LUC?", "cold", {}),
        ("ice-", "", {}),
        ("- ice - cream -", "cold", {}),
    ],
)
def test_numbers_hyphens_signs_and_capitals_are_forgiven(forgiving, written, rule, tags):
    found = parse(forgiving, written)
    assert (found.rule, dict(found.tags)) == (rule, tags) if rule else found is None


@given(st.text("0123456789,.-$\N{EURO SIGN} abi", max_size=30))
def test_no_number_is_too_odd(text):
    companion = load_grammar("companion")
    parse(companion, text)
    parse(companion, f"go forward {text} meters")
