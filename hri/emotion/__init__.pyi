from .appraisal import (
    ActionEvent as ActionEvent,
    GoalEvent as GoalEvent,
    ObjectEvent as ObjectEvent,
)
from .behaviors import EmotionDisplay as EmotionDisplay, EmotionModel as EmotionModel
from .dynamics import Dynamics as Dynamics
from .everyday_words import KNOWN_FEELINGS as KNOWN_FEELINGS
from .expressive_motion import ExpressiveMotion as ExpressiveMotion
from .model_spec import EmotionModelSpec as EmotionModelSpec, load_emotions as load_emotions
from .personality import (
    Personality as Personality,
    load_personality as load_personality,
    personality_names as personality_names,
    personality_path as personality_path,
)
from .stimulus import StimulusSpec as StimulusSpec, load_stimuli as load_stimuli
