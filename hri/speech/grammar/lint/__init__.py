"""What the author of a grammar should know: errors, ambiguity, confusion, expectations."""
