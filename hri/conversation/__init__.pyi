from .agreement import face_for as face_for, suits as suits
from .alarm_keeper import ALARM_FILE as ALARM_FILE, AlarmKeeper as AlarmKeeper
from .alarms import (
    FURTHEST as FURTHEST,
    Alarm as Alarm,
    AlarmKind as AlarmKind,
    TooManyAlarms as TooManyAlarms,
    completed as completed,
    lacks_time as lacks_time,
    length_words as length_words,
)
from .authored_event import read_event as read_event
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
    answers_shown as answers_shown,
    are_alike as are_alike,
    nearest_sentence as nearest_sentence,
    sayings as sayings,
)
from .facts import Fact as Fact, fact_of as fact_of
from .filling import ASKED as ASKED, CONFIRMED as CONFIRMED, fill as fill
from .first_names import (
    as_name as as_name,
    introduced as introduced,
    introduces_self as introduces_self,
)
from .floor import (
    GIVES_WAY_SECONDS as GIVES_WAY_SECONDS,
    NEVER as NEVER,
    NIGHT as NIGHT,
    Importance as Importance,
    Scene as Scene,
    gives_way as gives_way,
    may_begin as may_begin,
    may_murmur as may_murmur,
)
from .forms import Form as Form, load_forms as load_forms
from .gist import Gist as Gist
from .idle_acts import (
    IdleAct as IdleAct,
    IdleActs as IdleActs,
    Idler as Idler,
    Stillness as Stillness,
    load_idle_acts as load_idle_acts,
)
from .memory import (
    MEETING_GAP as MEETING_GAP,
    Meeting as Meeting,
    Memory as Memory,
    MemoryFull as MemoryFull,
    Question as Question,
)
from .memory_file import people_file as people_file
from .memory_keeper import (
    PEOPLE_FILE as PEOPLE_FILE,
    MemoryKeeper as MemoryKeeper,
    file_of_run as file_of_run,
)
from .motions import turn_words as turn_words, way_words as way_words
from .people import Asked as Asked, Consent as Consent, Felt as Felt, KnownPerson as KnownPerson
from .puzzlement import (
    TELLING as TELLING,
    Answer as Answer,
    Kind as Kind,
    Puzzle as Puzzle,
    Puzzlement as Puzzlement,
    as_said as as_said,
)
from .reflection import deed_of as deed_of, echo_of as echo_of, turned as turned
from .relations import (
    Relation as Relation,
    load_relations as load_relations,
    remembered_by as remembered_by,
    source_of as source_of,
)
from .ringing import ring as ring
from .sentiment import sentiment_of as sentiment_of
from .speaking_up import SPEAKER as SPEAKER, speak_up as speak_up
from .spoken_text import check_text as check_text, fields_of as fields_of
