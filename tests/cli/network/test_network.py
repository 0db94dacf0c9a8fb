import pytest

from hri.cli.main import main
from hri.cli.network.picture import STEPS, strokes
from hri.robot import load_app
from tests.disk import full_disk

NETWORK = """\
<BehaviorNetwork invocation_interval="0.02"><Link from="a.value" to="b.input"/>
<Behavior id="b" type="Hri.Scale"/>
<Behavior id="a" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
</BehaviorNetwork>
"""


@pytest.fixture
def network(tmp_path):
    path = tmp_path / "net.xml"
    path.write_text(NETWORK)
    return path


def test_check_is_quiet_when_all_is_well(network, capsys):
    assert main(["network", "check", str(network)]) == 0
    assert capsys.readouterr().out == f"{network}: 2 behaviors, 1 links, ok\n"


@pytest.mark.proves("B03")
def test_check_warns_of_what_looks_wrong(network, capsys):
    network.write_text(NETWORK.replace('<Link from="a.value" to="b.input"/>', ""))
    assert main(["network", "check", str(network)]) == 1
    assert "warning: nothing reaches b (input)" in capsys.readouterr().out


def test_check_refuses_what_is_wrong(network, capsys):
    network.write_text(NETWORK.replace("b.input", "c.input"))
    assert main(["network", "check", str(network)]) == 2
    assert 'net.xml:1:45: no behavior "c"' in capsys.readouterr().err


def test_show_tells_the_order_the_rate_and_the_links(network, capsys):
    assert main(["network", "show", str(network)]) == 0
    out = capsys.readouterr().out
    assert "every 0.02 s (50 Hz)" in out
    assert out.index("Hri.Constant") < out.index("Hri.Scale")
    assert "parsed_value = 3" in out
    assert "a.value -> b.input" in out


@pytest.mark.parametrize(("name", "begin"), [("out.svg", b"<svg"), ("out.png", b"\x89PNG\r\n")])
def test_draw_writes_a_picture(network, tmp_path, name, begin):
    out = tmp_path / name
    assert main(["network", "draw", str(network), "--out", str(out)]) == 0
    assert out.read_bytes().startswith(begin)


def test_a_level_piece_of_a_line_is_one_stroke_and_a_curve_many():
    """Rounding would break it into strokes at different heights."""
    level = ((0.0, 7.3), (150.0, 7.3), (150.0, 7.3), (300.0, 7.3))
    curve = ((0.0, 0.0), (50.0, 0.0), (50.0, 40.0), (100.0, 40.0))
    assert strokes(level) == [(0.0, 7.3), (300.0, 7.3)]
    assert len(strokes(curve)) == STEPS + 1


def test_draw_knows_which_pictures_it_can(network, capsys):
    assert main(["network", "draw", str(network), "--out", "x.gif"]) == 2
    assert "*.svg or *.png" in capsys.readouterr().err


@pytest.mark.proves("B04")
def test_format_rewrites_once(network, capsys):
    assert main(["network", "format", str(network)]) == 0
    text = network.read_text()
    assert text.splitlines()[2] == '  <Behavior id="b" type="Hri.Scale"/>'
    assert main(["network", "format", str(network)]) == 0
    assert network.read_text() == text
    assert "canonical" in capsys.readouterr().out


@pytest.mark.parametrize("app", ["companion", "docs/samples/behavior/emotion"])
def test_the_apps_of_the_house_give_nothing_to_warn_of(app):
    for network in load_app(app).load_networks():
        assert [*network.warnings, *network.loose_ends()] == []


def test_format_leaves_the_file_as_it_was_on_a_full_disk(network, capsys):
    with full_disk(after=60):
        assert main(["network", "format", str(network)]) == 2
    assert network.read_text() == NETWORK
    assert "net.xml: cannot be written" in capsys.readouterr().err


def test_show_names_who_uses_the_board_of_an_app(capsys):
    assert main(["network", "show", "companion"]) == 0
    shown = capsys.readouterr().out
    assert (
        """      speech  (speech)
          written by face.voice.speech
          read by hearing.listener.speech
"""
        in shown
    )
    assert (
        """      drive.command  (twist)  what tasks ask the base for
          read by moving.gate
"""
        in shown
    )


def test_an_app_is_checked_as_a_whole(tmp_path, capsys):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "app.toml").write_text('networks = ["one.xml", "two.xml"]\n')
    for name, link in (
        ("one", 'from="sum.sum" to="board.x"'),
        ("two", 'from="board.x" to="not.input"'),
    ):
        behaviors = '<Behavior id="sum" type="Hri.Addition"/><Behavior id="not" type="Hri.Not"/>'
        (folder / f"{name}.xml").write_text(
            f"<BehaviorNetwork>{behaviors}\n<Link {link}/></BehaviorNetwork>"
        )
    assert main(["network", "check", str(folder)]) == 2
    assert "two.xml:2:1: board.x is double" in capsys.readouterr().err


def test_what_is_wrong_with_an_app_found_by_its_name_is_said(tmp_path, monkeypatch, capsys):
    folder = tmp_path / "apps" / "mine"
    folder.mkdir(parents=True)
    (folder / "app.toml").write_text('networks = ["one.xml"]\n')
    (folder / "one.xml").write_text("<BehaviorNetwork>\n<Link/></BehaviorNetwork>")
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    assert main(["network", "check", "mine"]) == 2
    assert "one.xml:2:1" in capsys.readouterr().err


def test_the_picture_of_an_app_has_all_its_networks(tmp_path, capsys):
    out = tmp_path / "app.svg"
    assert main(["network", "draw", "companion", "--out", str(out)]) == 0
    drawn = out.read_text()
    for name in ("hearing", "seeing", "feeling", "moving", "voice.speech -&gt; board.speech"):
        assert name in drawn
