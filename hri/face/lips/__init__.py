"""From the sounds of a voice to the shapes of the mouth."""
