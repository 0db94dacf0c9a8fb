"""Driving: a gate that every velocity passes, and the verbs `move`, `turn` and `stop`."""
