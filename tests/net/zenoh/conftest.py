import pytest


@pytest.fixture
def living(tmp_path):
    """Lets robots live, and ends them."""
    from hri.net.zenoh.session import FleetSettings
    from tests.net.zenoh.robots import NETWORK, Living

    robots = []

    def live(name, links="", devices=(), **settings):
        path = tmp_path / f"{name}.xml"
        path.write_text(NETWORK.format(name=name, links=links))
        robots.append(Living(FleetSettings(name, **settings), path, devices))
        return robots[-1]

    yield live
    for one in robots:
        one.end()
