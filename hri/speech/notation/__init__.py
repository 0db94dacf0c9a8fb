"""Text as people write it, in the words that an American says."""
