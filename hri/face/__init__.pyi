from .animator import Animator as Animator
from .behaviors import Face as Face, FaceRenderer as FaceRenderer
from .model import FaceModel as FaceModel, load_face as load_face
from .motion.gesture_tracks import load_gestures as load_gestures
from .still import render_face as render_face
