"""The commands that use a camera."""
