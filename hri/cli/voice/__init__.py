"""The commands that use a voice."""
