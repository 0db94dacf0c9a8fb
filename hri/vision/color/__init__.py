"""Colors learned from pictures, and the blobs that have them."""
