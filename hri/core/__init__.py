"""What everything stands on: clocks, events, errors, and the values that travel.

from hri.core import Event, EventBus, FakeClock, HriError, RealClock
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
