"""The simulated world: a room, a base, a person with a voice and a head, and their drivers."""
