from hri.task import TaskContext, immediate

SUITS = ("hearts", "spades", "diamonds", "clubs")
CARDS = [f"the {value} of {suit}" for suit in SUITS for value in ("ace", "king", "queen", "jack")]


@immediate
def draw_cards(context: TaskContext, count: float = 1) -> str:
    """Draw some cards; the robot says what this returns."""
    if not 1 <= count <= 5:
        return "I draw up to five cards."
    return f"I drew {' and '.join(context.chance.sample(CARDS, int(count)))}."
