from .clock import Clock as Clock, FakeClock as FakeClock, RealClock as RealClock
from .errors import (
    AuthoringError as AuthoringError,
    AuthoringErrors as AuthoringErrors,
    HriError as HriError,
    NotAvailable as NotAvailable,
    Place as Place,
)
from .event_bus import EventBus as EventBus, Subscription as Subscription
from .latest import Board as Board, Latest as Latest
from .signals import (
    EmotionState as EmotionState,
    Event as Event,
    Expression as Expression,
    FaceBox as FaceBox,
    FaceWeights as FaceWeights,
    Frame as Frame,
    Gaze as Gaze,
    HeadGesture as HeadGesture,
    HeadPose as HeadPose,
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
