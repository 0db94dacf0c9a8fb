"""The default engine: phones by a small network, words by an exact search of the grammar."""
