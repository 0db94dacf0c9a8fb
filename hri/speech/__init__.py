"""Speech: ears that hear what a grammar allows, a voice, and the tasks that use them.

from hri.speech import Listener, Voice, load_grammar, say
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
