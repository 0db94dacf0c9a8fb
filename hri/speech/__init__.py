"""Speech: grammars, what is heard by them, and the voice."""
