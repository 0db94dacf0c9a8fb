"""The face: drawings that morph with feelings, speech and gaze.

    from hri.face import render_face
    picture = render_face(expression="happy")       # RGB, uint8, [480, 640, 3]

outline, paint, drawing   SVG files: parts by id, one drawing for each morph target
baking, turning           all drawings as one linear morph, and a head that turns
blending, cache, exchange the morph of each frame; baked faces on disk, and as plain values
settings, model           face.toml, and the loaded face; checking   reports likely mistakes
phonemes, lipsync         sounds become visemes over time; envelope for voices without phonemes
affect, idle, gestures    valence and arousal, a moment of life, keyframes: each becomes weights
expressing, speaking, gesturing, looking, living, blinking
                          what is asked for jumps, what shows glides, on springs
mixer, animator           the layers, by region, become the weights of now
recording                 weights as CSV
scene, still              a script of all that, and one picture of it
renderers                 weights become a picture; captions, sheets, movies, small screens
behaviors                 Face and FaceRenderer, for networks
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
