"""Seeing with OpenCV: pictures made ready, faces found, meshes fitted, motion followed."""
