"""What all commands share: standard streams, messages, progress, signals, exit status."""
