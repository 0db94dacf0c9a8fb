from .behaviors import (
    Attention as Attention,
    EngagementLevel as EngagementLevel,
    PersonTracker as PersonTracker,
)
from .gesturing import HeadGestures as HeadGestures
from .naming import FaceNames as FaceNames
from .pointing import PointAndGo as PointAndGo
from .pose import head_pose as head_pose
from .tasks import look_at as look_at, people_of as people_of, wait_for_person as wait_for_person
from .view import CameraView as CameraView
