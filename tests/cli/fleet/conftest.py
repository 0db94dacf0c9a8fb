"""Robots to ask, as in the tests of what they answer."""

from tests.net.zenoh.conftest import living as living
