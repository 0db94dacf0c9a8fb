"""What a network costs, and what is lost on it."""
