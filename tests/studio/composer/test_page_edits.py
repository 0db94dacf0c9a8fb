"""The page's own model of a network keeps to the rules of `hri network`: form, wiring, XML."""

import json
import random
import shutil
import subprocess
from pathlib import Path

import pytest

from hri.behavior.library.constant import Constant
from hri.behavior.network_difference import compare
from hri.behavior.network_file import read_network
from hri.behavior.network_writer import write_network
from hri.core import paths
from hri.core.errors import AuthoringError
from hri.core.xml import parse_xml
from hri.studio.composer import inspection

PAGE = paths.house() / "hri" / "studio" / "page"
ESBUILD = PAGE / "node_modules" / ".bin" / "esbuild"
pytestmark = [
    pytest.mark.skipif(not shutil.which("node"), reason="no node - apt install nodejs"),
    pytest.mark.skipif(not ESBUILD.exists(), reason="no esbuild - npm ci in hri/studio/page"),
]

SHIPPED = [
    path
    for folder in ("apps", "config")
    for path in sorted((paths.house() / folder).rglob("*.xml"))
    if "<BehaviorNetwork" in path.read_text(encoding="utf-8")
]
EMPTY = '<?xml version="1.0" encoding="UTF-8"?>\n<BehaviorNetwork/>\n'
CANONICAL = """\
<?xml version="1.0" encoding="UTF-8"?>
<!-- Adds. -->
<BehaviorNetwork name="sums" invocation_interval="1/30">
  <!-- One. -->
  <Behavior id="one" type="Hri.Constant">
    <!-- A half turn. -->
    <Parameter name="parsed_value" value="pi"/>
  </Behavior>

  <Behavior id="sum" type="Evolution.Addition"/>

  <!-- The wires. -->
  <Link from="one.value" to="sum.input"/>

  <Link from="sum.sum" to="board.speech"/>

  <Layout>
    <!-- On the left. -->
    <Box id="one" x="40" y="-8"/>

    <Box id="board.speech" x="240" y="80"/>
  </Layout>
  <!-- The end. -->
</BehaviorNetwork>
"""
TYPES = [
    "Hri.Addition",
    "Hri.And",
    "Hri.Camera",
    "Hri.Constant",
    "Hri.DoubleArrayJoiner",
    "Hri.Greater",
    "Hri.InputCollector",
    "Hri.MotionDetector",
    "Hri.PriorityArbiter",
    "Hri.RangeSensor",
    "Hri.Scale",
    "Hri.VelocityMixer",
]
"""Of all kinds, but none that two of could not be in a network."""
NAME = Path("/nowhere/net.xml")


@pytest.fixture(scope="module")
def ask(tmp_path_factory):
    """What the page's model answers."""
    folder = tmp_path_factory.mktemp("model")
    program = folder / "model.mjs"
    options = ["--bundle", "--platform=node", "--format=esm", "--log-level=warning"]
    subprocess.run(
        [ESBUILD, "test/model.ts", *options, f"--outfile={program}"], cwd=PAGE, check=True
    )
    palette = inspection.palette() | {"devices": []}
    texts = [CANONICAL, *map(constant, WRITTEN), *(path.read_text("utf-8") for path in SHIPPED)]
    known = {"palette": palette, "constants": {"0": "double"} | dict(constants_of(texts))}

    def answers(**questions):
        file = folder / "questions.json"
        file.write_text(json.dumps(known | questions))
        run = subprocess.run(["node", program, file], capture_output=True, check=True)
        return json.loads(run.stdout)

    return answers


def constants_of(texts):
    """Values of constants, and their datatypes as `check` says them."""
    for text in texts:
        decided = inspection.check(text, str(NAME))["datatypes"] or {}
        for one in read_network(text, NAME).authored:
            if isinstance(one, Constant):
                yield one.parsed_value, decided[f"{one.id}.value"]


def edits(text, seed, count=80):
    return {"text": text, "types": TYPES, "seed": seed, "count": count}


@pytest.mark.slow
def test_a_difference_is_what_hri_network_diff_finds(ask):
    (made,) = ask(edits=[edits(CANONICAL, seed=8, count=300)])["edits"]
    texts = [CANONICAL, *(text for _, text in made)]
    pairs = list(zip(texts, texts[7:], strict=False))
    for (old, new), found in zip(pairs, ask(differences=pairs)["differences"], strict=True):
        expected = compare(read_network(old, NAME), read_network(new, NAME))
        assert set(found["added"]) == set(expected.added)
        assert set(found["removed"]) == set(expected.removed)
        assert found["links"]["added"] == list(expected.added_links)
        assert found["links"]["removed"] == list(expected.removed_links)
        # The page tells of another spelling of the same number as well.
        assert {one["id"] for one in found["changed"]} >= set(expected.changed)


@pytest.mark.proves("V03")
@pytest.mark.parametrize("start", [EMPTY, CANONICAL], ids=["new", "with comments"])
def test_after_each_edit_a_network_is_in_canonical_form(ask, start):
    (made,) = ask(edits=[edits(start, seed=5, count=600)])["edits"]
    texts = dict.fromkeys(text for _, text in made)
    assert len(texts) > 400
    for label, text in made:
        assert write_network(read_network(text, NAME)) == text, label


def test_after_each_edit_a_shipped_network_is_in_canonical_form(ask):
    calm = [path for path in SHIPPED if "Drive" not in path.read_text(encoding="utf-8")]
    starts = [path.read_text(encoding="utf-8") for path in calm]
    assert len(starts) > 8
    made = ask(edits=[edits(text, seed, count=40) for seed, text in enumerate(starts)])["edits"]
    for path, texts in zip(calm, made, strict=True):
        for label, text in texts:
            assert write_network(read_network(text, path)) == text, (path, label)


def ends(palette, text, rng):
    """An output and an input, now and then of something else."""
    network = read_network(text, NAME)
    outputs, inputs = (
        [f"{one.id}.{port}" for one in network.authored for port in getattr(one, kind)]
        for kind in ("outputs", "inputs")
    )
    slots = ["board.drive.goal", "board.speech", "board.people", "board.other", "board.a b"]
    odd = [*slots, "gone.port", f"{network.authored[0].id}.gone"]
    return rng.choice([*outputs, rng.choice(odd)]), rng.choice([*inputs, rng.choice(odd)])


def with_link(text, source, target):
    return text.replace("  <Layout>", f'  <Link from="{source}" to="{target}"/>\n  <Layout>')


@pytest.mark.slow
def test_a_link_is_refused_or_warned_of_in_the_words_of_the_check(ask):
    rng = random.Random(3)
    grown = ask(edits=[edits(CANONICAL, seed, count=150) for seed in range(6)])["edits"]
    texts = [text for all in grown for _, text in all[60::30] if text.count("<Behavior ") > 3]
    asked = [{"text": text, "pairs": [ends(None, text, rng) for _ in range(40)]} for text in texts]
    verdicts = ask(links=asked)["links"]
    refused = 0
    for question, answers in zip(asked, verdicts, strict=True):
        text = question["text"]
        before = {one.what for one in read_network(text, NAME).warnings}
        for (source, target), verdict in zip(question["pairs"], answers, strict=True):
            if source.startswith("board.") and target.startswith("board."):
                continue  # of no use, but no mistake either
            what = f"{source} -> {target}"
            found = checked(with_link(text, source, target))
            if isinstance(found, AuthoringError):
                refused += 1
                assert not verdict["ok"], (what, found.what)
                assert words(verdict["reason"]) == words(found.what), what
            else:
                assert verdict["ok"], (what, verdict["reason"])
                new = [one.what for one in found.warnings if one.what not in before]
                assert verdict["warning"] == "".join(new), what
    assert refused > 100


def checked(text):
    """The network, or what is wrong with it."""
    try:
        return read_network(text, NAME)
    except AuthoringError as error:
        return error


def words(what):
    """Without remedy and places; what is to come is not there yet."""
    what = what.partition(" - ")[0]
    if what.startswith("board.") and " (" in what:
        head, _, rest = what.partition(" (")
        return head, rest.rpartition("), but ")[2]
    if what.startswith("these links "):
        return "circle"
    return what.replace("is there twice", "is there already")


WRITTEN = [
    "3", "-5*pi/6", "1e-3", "- 2", ".5", "5.", "007", "1_000", "0x10", "1/0", "1e999", "pi", "PI",
    "e", "pie", "true", "False", "yes", "", " ", "hello 2", "hello, you", "1, 2", "1,", "(1, 2)",
    "(3)", "()", "(1, 2", "'5'", "&quot;5&quot;", "&quot;", "1 2", "2 # two", "äh", "nan", "-inf",
]  # fmt: skip


def constant(written, others=""):
    """A network of a constant and others."""
    parameter = f'<Parameter name="parsed_value" value="{written}"/>'
    behavior = f'<Behavior id="c" type="Hri.Constant">{parameter}</Behavior>'
    return f"<BehaviorNetwork>{others}{behavior}  <Layout></Layout></BehaviorNetwork>"


def test_a_constant_is_refused_where_the_robot_refuses_it(ask):
    takers = {"one": "Scale", "two": "Not", "three": "FaceRenderer", "four": "DoubleArraySplitter"}
    ports = ["one.input", "two.input", "three.caption", "four.array"]
    behaviors = "".join(f'<Behavior id="{id}" type="Hri.{name}"/>' for id, name in takers.items())
    texts = [constant(written, behaviors) for written in WRITTEN]
    asked = [{"text": text, "pairs": [("c.value", port) for port in ports]} for text in texts]
    refused = 0
    for text, verdicts in zip(texts, ask(links=asked)["links"], strict=True):
        for port, verdict in zip(ports, verdicts, strict=True):
            found = checked(with_link(text, "c.value", port))
            assert verdict["ok"] is not isinstance(found, AuthoringError), (text, port)
            if not verdict["ok"]:
                refused += 1
                assert verdict["reason"].startswith(found.what)
    assert refused > 40


PIECES = [
    "<", ">", "/", "&", "&amp;", "&#65;", "&#x1f;", "&#xD800;", '"', "'", "--", "<!--", "-->",
    "]]>", "<a/>", "<b>", "</b>", "=", 'id="x"', "ä", "🤖", "<?", "?>", "<![CDATA[", "<!DOCTYPE a>",
    ":", "xmlns:xsi", "\n", "\t", " ", "\r\n", "\x00", "\ufeff", "\u00a0",
]  # fmt: skip


def mutated(rng):
    text = rng.choice([CANONICAL, CANONICAL.replace('"', "'"), CANONICAL.replace("\n", "\r\n")])
    for _ in range(rng.choice([1, 1, 2, 3])):
        at = rng.randrange(len(text))
        text = text[:at] + rng.choice(["", rng.choice(PIECES)]) + text[at + rng.choice([0, 1, 9]) :]
    return text


def tree(text):
    """Its elements, or what is wrong with it."""
    try:
        return branches(parse_xml(text.encode(), NAME))
    except AuthoringError as error:
        return error.what


def branches(element):
    return [element.tag, element.attributes, [branches(child) for child in element]]


def test_a_text_is_read_or_refused_as_the_robot_does(ask):
    rng = random.Random(11)
    texts = [mutated(rng) for _ in range(3000)]
    read = 0
    for text, answer in zip(texts, ask(texts=texts)["texts"], strict=True):
        expected = tree(text)
        if isinstance(expected, list):
            read += 1
            assert answer == expected, text
        elif "encoding" not in expected:  # the page has letters, not bytes
            assert isinstance(answer, str), (expected, text)
    assert 500 < read < 2500
