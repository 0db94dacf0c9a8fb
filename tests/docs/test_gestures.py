"""The page about head gestures: what it shows works."""

import re
import tomllib
from pathlib import Path

from hri.core import paths
from hri.vision.gestures.gesture_patterns import FILE, PatternRow, load_patterns

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/gestures.md").read_text()


def block(language: str) -> str:
    (found,) = re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)
    return str(found)


def test_the_gesture_of_the_page_is_that_of_the_file(tmp_path: Path) -> None:
    path = tmp_path / "gestures.toml"
    path.write_text(block("toml"))
    assert load_patterns(path) == {"look_up": load_patterns()["look_up"]}


def test_the_table_has_every_key_of_a_row() -> None:
    table = set(re.findall(r"`(\w+)`", PAGE.split("| key of a row |")[1].split("\n\n")[0]))
    used = tomllib.loads(paths.find("config", FILE).read_text())
    keys = {key for gesture in used.values() for row in gesture["row"] for key in row}
    assert keys <= table
    assert len(table & {"when", "first", "widest_deg", *keys}) == len(PatternRow.__slots__)


def test_the_program_of_the_page_runs() -> None:
    exec(block("python"), {})
