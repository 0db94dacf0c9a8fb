"""What keeps a base safe, in a process of its own below everything that wants it to move."""
