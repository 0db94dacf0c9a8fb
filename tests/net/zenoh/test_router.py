"""Robots that know each other by a router alone, over TLS."""

import json
import socket

import pytest

pytest.importorskip("zenoh", reason="the extra zenoh is not installed")

import trustme
import zenoh

from hri.core.errors import HriError
from hri.net.zenoh.fleet import fleet
from hri.net.zenoh.session import FleetSettings
from tests.net.zenoh.robots import until

AUTHORITY = trustme.CA()


def configuration(mode, **parts):
    return json.dumps({"mode": mode, "scouting": {"multicast": {"enabled": False}}, **parts})


def tls(**files):
    return {"link": {"tls": {name: str(path) for name, path in files.items()}}}


@pytest.fixture
def router(tmp_path):
    """A router that listens with a certificate of the authority; where it does."""
    path = tmp_path / "router.pem"
    AUTHORITY.issue_cert("localhost").private_key_and_cert_chain_pem.write_to_path(path)
    with socket.create_server(("127.0.0.1", 0)) as free:
        endpoint = f"tls/localhost:{free.getsockname()[1]}"
    own = configuration(
        "router",
        listen={"endpoints": [endpoint]},
        transport=tls(listen_private_key=path, listen_certificate=path),
    )
    with zenoh.open(zenoh.Config.from_json5(own)):
        yield endpoint


@pytest.fixture
def client(tmp_path, router):
    """How a program joins the fleet by the router alone, if it trusts this authority."""

    def settings(authority, **more):
        path, trusted = tmp_path / f"client{len(more)}.json5", tmp_path / "authority.pem"
        authority.cert_pem.write_to_path(trusted)
        connect, transport = {"endpoints": [router]}, tls(root_ca_certificate=trusted)
        path.write_text(configuration("client", connect=connect, transport=transport, **more))
        return {"allows_remote": True, "file": path}

    return settings


def are_seen(names, **settings):
    """Whether these robots, and no others, are in a fleet."""
    with fleet(FleetSettings(**settings)) as found:
        return until(lambda: found.names() == names)


def test_robots_know_each_other_by_a_router_over_tls(living, client):
    living("anna", **client(AUTHORITY))
    level = living("berta", **client(AUTHORITY)).board.slot("anna/level")
    assert until(lambda: level.value == 5.0)
    with fleet(FleetSettings(**client(AUTHORITY))) as found:
        assert until(lambda: found.names() == ["anna", "berta"])
        assert found.ask("anna", "state", {})["app"] == "anna"


def test_a_namespace_is_a_fleet_by_itself(living, client):
    site = client(AUTHORITY, namespace="site7")
    living("anna", **site)
    level = living("berta", **site).board.slot("anna/level")
    living("carla", **client(AUTHORITY))
    assert until(lambda: level.value == 5.0)
    assert are_seen(["anna", "berta"], **site)
    assert are_seen(["carla"], **client(AUTHORITY))


def test_who_trusts_another_authority_comes_not_in(living, client):
    living("anna", **client(AUTHORITY))
    with (
        pytest.raises(HriError, match="the fleet cannot be joined"),
        fleet(FleetSettings(**client(trustme.CA()))),
    ):
        pass
