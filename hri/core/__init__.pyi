from .clock import Clock as Clock, FakeClock as FakeClock, RealClock as RealClock, Worker as Worker
from .errors import (
    AuthoringError as AuthoringError,
    AuthoringErrors as AuthoringErrors,
    HriError as HriError,
    Mistakes as Mistakes,
    NotAvailable as NotAvailable,
    Place as Place,
    did_you_mean as did_you_mean,
)
from .event_bus import (
    OWN_SUBJECTS as OWN_SUBJECTS,
    EventBus as EventBus,
    Subscription as Subscription,
)
from .latest import Board as Board, Latest as Latest
from .origin import KEYBOARD as KEYBOARD, caused_by as caused_by
from .signals import (
    EmotionState as EmotionState,
    Event as Event,
    Expression as Expression,
    FaceBox as FaceBox,
    FaceWeights as FaceWeights,
    FoundObject as FoundObject,
    Frame as Frame,
    Gaze as Gaze,
    Hand as Hand,
    HandGesture as HandGesture,
    HeadGesture as HeadGesture,
    HeadPose as HeadPose,
    HeardSlot as HeardSlot,
    People as People,
    Person as Person,
    Phoneme as Phoneme,
    Pose2D as Pose2D,
    Prosody as Prosody,
    RangeReading as RangeReading,
    Speech as Speech,
    Stimulus as Stimulus,
    Twist as Twist,
    Utterance as Utterance,
)
from .toml import Table as Table, load_toml as load_toml
