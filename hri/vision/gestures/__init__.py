"""Gestures of the head: nods, shakes and others, from head poses and optical flow."""
