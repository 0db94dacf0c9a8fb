from .choosing import (
    Moment as Moment,
    Pool as Pool,
    Spoken as Spoken,
    Texts as Texts,
    Wording as Wording,
    pools as pools,
)
from .curiosity import DAY as DAY, Curiosity as Curiosity
from .day import (
    PARTS_OF_DAY as PARTS_OF_DAY,
    clock_words as clock_words,
    part_of_day as part_of_day,
)
from .dialog_act import act_of as act_of
from .examples import (
    are_alike as are_alike,
    different as different,
    nearest_sentence as nearest_sentence,
    sayings as sayings,
)
from .first_names import introduced as introduced
from .floor import (
    GIVES_WAY_SECONDS as GIVES_WAY_SECONDS,
    NEVER as NEVER,
    Scene as Scene,
    gives_way as gives_way,
    may_begin as may_begin,
)
from .gist import Gist as Gist
from .motions import turn_words as turn_words, way_words as way_words
from .puzzlement import (
    TELLING as TELLING,
    Answer as Answer,
    Kind as Kind,
    Puzzle as Puzzle,
    Puzzlement as Puzzlement,
    as_said as as_said,
)
from .reflection import deed_of as deed_of, echo_of as echo_of
from .sentiment import sentiment_of as sentiment_of
