"""A network alone is run like an app."""

import pytest

from hri.core.errors import HriError
from hri.robot import load_app


def test_a_network_is_an_app_of_its_name_without_tasks(tmp_path):
    file = tmp_path / "idle.xml"
    file.write_text("<BehaviorNetwork/>")
    app = load_app(str(file))
    assert (app.name, app.is_network, app.load_tasks(), app.task_names()) == ("idle", True, [], [])
    assert [network.name for network in app.load_networks()] == ["idle"]


def test_a_network_is_found_by_name():
    assert load_app("networks/wander.xml").name == "wander"


def test_a_network_that_is_not_there_is_refused():
    with pytest.raises(HriError, match=r'no "missing\.xml" in config'):
        load_app("missing.xml")
