"""Seeing people: faces found and followed, nods and shakes recognized."""
