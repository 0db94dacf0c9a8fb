"""Seeing with OpenCV: pictures made ready, faces found, motion followed."""
