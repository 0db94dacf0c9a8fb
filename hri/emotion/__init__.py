"""Emotion: events change feelings; feelings show in face, voice and speed.

from hri.emotion import Dynamics, load_emotions
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
