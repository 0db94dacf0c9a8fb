"""Keeps a base safe, in a separate process below everything that wants it to move."""
