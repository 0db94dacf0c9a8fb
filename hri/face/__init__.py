"""The face: drawings that morph with what is felt, said and looked at.

    from hri.face import render_face
    picture = render_face(expression="happy")       # RGB, uint8, [480, 640, 3]

outline, paint, drawing   SVG files: parts by id, one drawing for each morph target
baking                    all drawings as one linear morph
settings, model           face.toml, and the loaded face
spring, idle, lipsync     motion as functions of time; envelope for voices without phonemes
mixer, animator           layers become weights that never jump
renderers                 weights become a picture; captions
behaviors                 Face and FaceRenderer, for networks
"""

from hri.face.model import FaceModel, load_face
from hri.face.still import render_face

__all__ = ["FaceModel", "load_face", "render_face"]
