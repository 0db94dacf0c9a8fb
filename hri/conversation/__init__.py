"""The talk between a person and the robot: pure decisions about what is said, and when."""
