"""What nobody asked for just now is said when it disturbs nobody, the most important first."""

from hri.conversation import Importance, speak_up
from hri.speech.behaviors import Voice
from tests.apps.test_companion import Visit
from tests.apps.test_manners import typing

LONG = "I am talking for a while now, and whoever has something to say waits for me."
NEWS, ALARM = "The laundry is done.", "It is time to go."


async def wait_to_speak(context):
    """Three things that come up while the robot talks."""
    await context.clock.sleep(1.0)
    context.behavior(Voice).say(LONG)
    for words, importance in (
        ("Nice day.", Importance.CHAT),
        (NEWS, Importance.NEWS),
        (ALARM, Importance.ALARM),
    ):
        context.manager.install(speak_up, words, importance)


def test_an_alarm_is_said_before_news_and_neither_talks_into_a_sentence():
    visit = Visit(16, {}, jobs=[wait_to_speak])
    assert visit.said() == [LONG, ALARM, NEWS], "nobody is there for a chat"
    assert all(not event.properties["cut"] for event in visit.named("speech.finished"))


def test_news_wait_until_it_need_not_be_quiet_any_more():
    async def tell(context):
        await context.clock.sleep(5.0)
        await speak_up(context, NEWS)

    visit = Visit(70, {}, jobs=[typing({1.0: "be quiet"}), tell])
    (said,) = (event for event in visit.named("speech.said") if event.properties["text"] == NEWS)
    assert said.time > 60
