"""An app: `hri run docs/samples/behavior/emotion`."""
