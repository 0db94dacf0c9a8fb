"""What the robot feels, why, and how it shows: charges, a mood, personalities, display rules."""
