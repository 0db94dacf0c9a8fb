"""The studio needs nothing from outside: it works where there is only the loopback."""

import shutil
import subprocess
import sys

import pytest

from hri.core import paths
from tests.studio.browser import CHROMIUM

pytestmark = pytest.mark.slow

UNSHARE = shutil.which("unshare")
ALONE = f"""
import fcntl, socket, struct
with socket.socket() as some:  # the loopback begins switched off: SIOCSIFFLAGS, IFF_UP
    fcntl.ioctl(some, 0x8914, struct.pack("16sh14x", b"lo", 1))
assert [name for _, name in socket.if_nameindex()] == ["lo"]

import re
from tests.studio.browser import opened
from tests.studio.living import known, living, told

with living() as (studio, robot):
    with known(studio.address()) as client:
        told(client, "base", lambda base: True)
        page = client.get("/").text
        files = re.findall(r'(?:src|href)="([^"]+)"', page)
        assert files and all(client.get(one).status_code == 200 for one in files), files
        palette = client.get("/api/v1/networks/palette").json()
        assert any(one["type"] == "Hri.Camera" for one in palette["behaviors"])
        assert client.post("/api/v1/hear", json={{"text": "hello"}}).status_code == 200
    if {bool(CHROMIUM)}:
        with opened(studio.address()) as page:
            page.evaluate("location.hash = '#networks'")
            page.locator(".composer .palette .behavior").first.wait_for()
print("it works")
"""


def _is_allowed():
    if UNSHARE is None:
        return False
    words = [UNSHARE, "--map-root-user", "--net", "true"]
    return subprocess.run(words, capture_output=True, check=False).returncode == 0


@pytest.mark.skipif(not _is_allowed(), reason="no network namespaces here - unshare -rn is refused")
def test_the_page_and_its_composer_work_in_an_empty_network_namespace():
    words = [UNSHARE, "--map-root-user", "--net", sys.executable, "-c", ALONE]
    house = paths.house()
    ended = subprocess.run(words, cwd=house, capture_output=True, text=True, check=False)
    assert ended.stdout.endswith("it works\n"), ended.stderr
