"""Engines that find words in sound."""
