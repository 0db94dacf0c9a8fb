"""An app of your own."""
