"""Hands: their shape, following them, and their gestures."""
