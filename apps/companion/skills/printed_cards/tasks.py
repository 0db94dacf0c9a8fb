"""Cards: a task that looks for a printed marker, and does what its row of a table says."""

from pathlib import Path

from hri.behavior import load_network
from hri.robot import verbs
from hri.speech import QUESTION, Listener
from hri.task import TaskContext
from hri.vision import load_cards

FOLDER = Path(__file__).parent
CARDS = load_cards(FOLDER / "cards.toml")
PATIENCE = 12.0
"""Seconds for a card to be shown."""


async def take_card(context: TaskContext) -> str | None:
    """Look for a card, and hear its sentence as if it had been typed; a card counts once.

    Whatever is said to it ends the search.
    """
    network, slot = load_network(FOLDER / "cards.xml"), context.board.slot(QUESTION)
    slot.set(True, context.clock.now())  # so that it asks nothing else meanwhile
    with context.queue("marker.seen", "speech.heard") as queue:
        context.networks.start(network)
        try:
            await verbs.say(context, "Show me your card.")
            event = None
            with context.clock.move_on_after(PATIENCE):
                event = await queue.get()
        finally:
            context.networks.stop(network.name)
            slot.clear()
    if event is None:
        return "I see no card. Hold it still, in the light."
    if event.name == "speech.heard":
        return None
    if (sentence := CARDS.get(event.properties["marker"])) is None:
        return "I don't know that card."
    context.behavior(Listener).type_line(sentence)
    return None
