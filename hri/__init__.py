"""A robot that is a companion: it hears, feels, shows a face, speaks, sees a nod and moves.

    from hri import Robot

    with Robot() as robot:
        robot.say("Hello.")
        robot.show("happy")
        if robot.ask("Shall I come closer?"):
            robot.move(0.5)

The map, from the class you use down to the foundations. Each package has a front door:
`from hri.behavior import Behavior, Input, Output`.

    Robot           opens resources, runs networks and tasks
    hri.behavior    behaviors, and the networks that they are wired into
    hri.task        tasks: coroutines that wait for time and events
    hri.speech      ears, a voice, and grammars
    hri.emotion     feelings, and their causes
    hri.face        a face that shows it; `render_face` is a picture as a numpy array
    hri.vision      who is there, and a nod or a shake of the head
    hri.drive       moving, safely
    hri.net         messages to and from other programs
    hri.hal         one interface a kind of device; drivers in hri.hal.drivers
    hri.core        clocks, events, errors, and the values that travel
"""

import os

import lazy_loader

__version__ = "0.1.0"

# onnxruntime, which the natural voice brings, reads it when it is imported; it would keep a device
# id and a queue of events, and send them to its maker. Child processes inherit it.
os.environ["ORT_DISABLE_TELEMETRY"] = "1"

# Read when numpy is first imported. The matrices here are small: more threads make their products
# slower (three times, for the phone network), and take the core that the robot loop runs on.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# What __init__.pyi names comes in when it is used: a tool that needs only a part starts faster.
__getattr__, __dir__, _ = lazy_loader.attach_stub(__name__, __file__)
