import pytest

from hri.drive.supervisor.noise import FEWEST, Noise


def test_a_few_bytes_say_nothing() -> None:
    noise = Noise()
    noise.add(FEWEST - 1, FEWEST - 1, 0.0)
    assert noise.share == 0.0


def test_the_share_is_that_of_the_last_second_however_the_bytes_are_bundled() -> None:
    one_by_one, bundled = Noise(), Noise()
    for number in range(3000):
        one_by_one.add(4, int(number % 4 == 0) * 4, number * 0.001)
        if number % 100 == 99:
            bundled.add(400, 100, number * 0.001)
    assert one_by_one.share == pytest.approx(0.25, abs=0.01)
    assert bundled.share == pytest.approx(0.25, abs=0.01)


def test_a_line_that_is_sound_again_is_believed_after_some_seconds() -> None:
    noise = Noise()
    noise.add(4000, 4000, 0.0)
    for number in range(400):
        noise.add(40, 0, number * 0.01)
    assert noise.share < 0.05
