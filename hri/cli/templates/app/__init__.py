"""Your own app."""
