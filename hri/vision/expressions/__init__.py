"""Facial expressions of people: what the parts of a face show, by name."""
