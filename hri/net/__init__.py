"""Over the network: the Malleable bridge, a client for scripts, the event server.

malleable_protocol         the lines
values, inbox              the values of ports, and what waits for a tick
peer, tcp_port             sockets: one other end, and a port with its thread
server, client, port_pool  the two kinds of port, and those that behaviors have in common
control, handshake         the token and the stop; how a client proves the token without sending it
door                       who may write
loopback, other_end        which addresses are our own; whose program is at the other end
malleable                  the behavior whose ports a schema defines
connection                 for scripts and programs without a robot
event_server               the task that carries events
"""

import lazy_loader

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
