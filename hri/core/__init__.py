"""What everything else stands on: time, values, events, files with places, names."""
