"""The ids that the configuration of 2003 gave its devices, and what ours are called.

So a network or a program of that time finds the devices of a configuration that has none of these
ids. One that has them goes by its own. Names of types are another thing: see `registry.ALIASES`.
"""

IDS = {
    "Battery": "battery",
    "IR_tn": "range_front",
    "IR_tne": "range_right",
    "IR_tnw": "range_left",
    "audio_in": "microphone",
    "audio_out": "speaker",
    "camera0": "camera",
    "eloquence_tts": "voice",
    "robohead": "screen",
    "viavoice_asr": "recognizer",
    "win_tts": "voice",
    "winvoice_asr": "recognizer",
    "winvoice_audio_level": "audio_level",
}
