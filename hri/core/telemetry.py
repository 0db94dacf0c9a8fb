"""Switches off the telemetry of packages before any of them is imported.

Child processes inherit it.
"""

import os

SWITCHES = {
    # onnxruntime would keep a device id and a queue of events, and send them to its maker.
    "ORT_DISABLE_TELEMETRY": "1",
}
"""Environment variables; what the user set them to makes no difference."""

os.environ.update(SWITCHES)
