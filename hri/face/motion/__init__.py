"""How a face moves over time: expressions, gestures, gaze, lids and idle life."""
