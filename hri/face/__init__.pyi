from .animator import Animator as Animator
from .behaviors import Face as Face, FaceRenderer as FaceRenderer
from .frames import Frame as Frame, speaking_frames as speaking_frames
from .model import FaceModel as FaceModel, load_face as load_face
from .motion.gesture_tracks import load_gestures as load_gestures
from .renderers.bits import face_bits as face_bits
from .still import render_face as render_face
