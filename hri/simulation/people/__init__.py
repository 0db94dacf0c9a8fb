"""The people of the simulated world: how they move and what they look like."""
