from .behaviors import (
    Attention as Attention,
    EngagementLevel as EngagementLevel,
    PersonTracker as PersonTracker,
)
from .camera_view import CameraView as CameraView
from .expressions.expression_behaviors import FacialExpressions as FacialExpressions
from .gestures.gesture_behaviors import HeadGestures as HeadGestures
from .hands.hand_behaviors import HandGestures as HandGestures
from .head_pose import head_pose as head_pose
from .markers.card_table import load_cards as load_cards
from .markers.marker_behaviors import MarkerFinder as MarkerFinder
from .markers.marker_reader import MarkerReader as MarkerReader
from .naming import FaceNames as FaceNames
from .objects.learning import ObjectLearner as ObjectLearner
from .objects.model_file import load_models as load_models, save_models as save_models
from .objects.object_model import ModelSet as ModelSet
from .objects.object_tasks import (
    NoCamera as NoCamera,
    NothingShown as NothingShown,
    forget_object as forget_object,
    learn_object as learn_object,
    objects_of as objects_of,
)
from .objects.recognizer import ObjectRecognizer as ObjectRecognizer
from .point_and_go import PointAndGo as PointAndGo
from .tasks import look_at as look_at, people_of as people_of, wait_for_person as wait_for_person
