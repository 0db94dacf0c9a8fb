from __future__ import annotations

from hri.core.clock import FakeClock
from tests.docs.tutorial import Tutorial


def test_the_voice_tells_of_itself_what_the_page_shows(capsys):
    tutorial = Tutorial("speech-03-voice")
    tutorial.load("voice.py").main(FakeClock())
    assert tutorial.prints(capsys.readouterr().out)
