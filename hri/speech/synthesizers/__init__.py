"""Engines that make sound of text."""
