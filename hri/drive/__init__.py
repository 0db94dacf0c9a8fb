"""Driving: the verbs of tasks, and the supervisor that every velocity passes.

from hri.drive import go_to, move, stop, turn
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
