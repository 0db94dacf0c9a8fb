"""Behaviors wired into networks that tick at a fixed rate."""
