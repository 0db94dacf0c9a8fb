from .behaviors import SpeakOn as SpeakOn
from .grammar import (
    Grammar as Grammar,
    Parse as Parse,
    Rule as Rule,
    load_grammar as load_grammar,
    parse as parse,
    read_grammar as read_grammar,
)
from .listener import Listener as Listener
from .tasks import say as say, wait_for_speech as wait_for_speech
from .voice import Priority as Priority, Voice as Voice
