"""Figures as JSON: each module measures one part and returns a dictionary."""
