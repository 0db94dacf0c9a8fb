"""Prints the score of a single shake for `config/gestures.toml`, in seconds, always the same."""

from benchmarks.vision.cross_validation import learned_score, tell
from benchmarks.vision.recordings import read_recordings
from benchmarks.vision.swing_training import line
from hri.vision.gestures.gesture_patterns import answer_patterns

if __name__ == "__main__":
    print(line(learned_score(tell(read_recordings(), answer_patterns()))))
