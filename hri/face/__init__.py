"""The face: drawings that morph with feelings, speech and gaze.

    from hri.face import render_face
    picture = render_face(expression="happy")       # RGB, uint8, [480, 640, 3]

drawing      SVG files become one linear morph and a head that turns, kept on disk when baked
lips         sounds become visemes, and visemes a track over time
motion       expressions, gestures, gaze, blinks and idle life, each as weights over time
renderers    weights become a picture; captions, contact sheets, movies, small screens
settings, model, lint       face.toml, the loaded face, and its likely mistakes
animator     all layers, by region, become the weights of now
scene, still, frames        a script of all that, one picture of it, and those of a sentence
live_link                   weights as CSV
behaviors    Face and FaceRenderer, for networks
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
