"""Ids of the configuration of 2003 find the devices of ours."""

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.hal.ids_2003 import IDS
from hri.hal.resource import Description, Resource
from hri.hal.resource_manager import ResourceManager


@pytest.mark.parametrize("id", sorted(IDS))
def test_an_id_of_2003_is_a_device_of_the_default_configuration(id):
    with ResourceManager.load("resource-config", FakeClock()) as resources:
        assert resources.obtain(id, Resource) is resources.obtain(IDS[id], Resource)
        assert resources.pose_of(id) == resources.pose_of(IDS[id])


def test_a_configuration_that_has_the_id_goes_by_its_own():
    devices = [Description("camera", "Hri.BlankCamera"), Description("camera0", "Hri.BlankCamera")]
    with ResourceManager(devices, FakeClock()) as resources:
        own = resources.obtain("camera0", Resource)
        assert own is not resources.obtain("camera", Resource)


def test_without_the_device_the_id_is_unknown():
    with ResourceManager([], FakeClock()) as resources, pytest.raises(HriError, match="camera0"):
        resources.obtain("camera0", Resource)
