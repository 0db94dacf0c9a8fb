"""Resources: pieces of hardware, or their stand-ins, behind one small interface each.

from hri.hal import RangeSensor, ResourceManager, load_configuration
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
