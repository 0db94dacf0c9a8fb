import pytest

from hri.behavior.library.callback import CallbackBehavior
from tests.behavior.library.ticking import Links, tick


class Listener:
    def __init__(self):
        self.heard = []

    def handle_input(self, behavior, port, data):
        self.heard.append((behavior.id, port, data))


@pytest.mark.proves("B19", "E14")
def test_callbacks_are_told_of_each_value_until_they_are_removed():
    tell, first, second = CallbackBehavior("tell"), Listener(), Listener()
    tell.add(first)
    tell.add(second)
    tick(tell, input=Links(["go", None, 3.0]))
    tell.remove(second)
    tell.remove(second)
    tick(tell, input="stop")
    tick(tell)
    assert second.heard == [("tell", "input", "go"), ("tell", "input", 3.0)]
    assert first.heard == [*second.heard, ("tell", "input", "stop")]
