"""Vision: who is there, whom the eyes meet, and a nod or a shake of the head.

from hri.vision import HeadGestures, PersonTracker
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
