"""The general behaviors: what every network may need, whatever the robot."""
