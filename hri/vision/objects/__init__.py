"""Objects learned by showing: local features, model sets, and what recognizes them in a picture."""
