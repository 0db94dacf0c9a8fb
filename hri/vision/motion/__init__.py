"""What moves in the pictures of a camera."""
