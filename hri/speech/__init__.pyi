from .automatic_level import VERY_QUIET_DB as VERY_QUIET_DB
from .behaviors import SpeakOn as SpeakOn
from .grammar import (
    Grammar as Grammar,
    Parse as Parse,
    Rule as Rule,
    load_grammar as load_grammar,
    parse as parse,
    read_grammar as read_grammar,
)
from .grammar.dates import resolve as resolve
from .grammar.guessing import LEAST_SURE as LEAST_SURE, guess_rule as guess_rule
from .grammar.matching import departure as departure
from .grammar.slot_values import values_of as values_of
from .grammar.sure_tags import sure_tags as sure_tags
from .grammar.tags import written as written
from .grammar.words import normalize as normalize
from .listener import Listener as Listener
from .sayings import both_sayings as both_sayings, without as without
from .tasks import hears_people as hears_people, say as say, wait_for_speech as wait_for_speech
from .turn import QUESTION as QUESTION
from .vocalizations.in_text import check_sounds as check_sounds
from .voice import Priority as Priority, Voice as Voice
