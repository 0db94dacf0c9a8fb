"""Bases that are not there: what they would answer on their serial line, and how they would move.

The same bytes go over a port in memory, on any clock, or over a pseudo-terminal in real time.
"""
