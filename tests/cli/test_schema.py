import pytest

from hri.behavior.catalog import find_behavior
from hri.behavior.schema import load_schema, schema_of
from hri.cli.main import main
from hri.core import registry


@pytest.mark.proves("B01")
def test_a_schema_is_printed(capsys):
    assert main(["schema", "export", "Evolution.Addition"]) == 0
    out = capsys.readouterr().out
    assert (
        '<BehaviorSchema type="Hri.Addition" driver="Hri.Addition" display_name="Addition"' in out
    )


@pytest.mark.proves("B01")
def test_all_schemas_are_exported_to_a_search_folder(tmp_path):
    assert main(["schema", "export", "--all", "--to", str(tmp_path)]) == 0
    for name in registry.known("hri.behaviors"):
        path = tmp_path / "behavior" / f"{name.replace('.', '/')}.xml"
        assert load_schema(path) == schema_of(find_behavior(name))


def test_what_to_export_must_be_said(capsys):
    assert main(["schema", "export"]) == 2
    assert main(["schema", "export", "Hri.Addition", "--all"]) == 2
    assert main(["schema", "export", "Hri.Adition"]) == 2
    assert 'did you mean "Hri.Addition"' in capsys.readouterr().err
