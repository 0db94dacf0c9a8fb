"""Over the network: the Malleable bridge, a client for scripts, the event server.

protocol, values, inbox    the arithmetic: lines, values of ports, what waits for a tick
peer, link                 sockets: one other end, and a port with its thread
server, client, sharing    the two kinds of port, and those that behaviors have in common
control, door, loopback    the token and the stop; who may write; which addresses are our own
malleable                  the behavior whose ports a schema defines
connection                 for scripts and programs without a robot
event_server               the task that carries events
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
