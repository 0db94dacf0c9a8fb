"""Research, run from a checkout by `make bench`: comparisons with other programs, judgments of
recordings and made films, faults and bad inputs by the thousand, and training.

What judges the machine of a user is in `hri.bench`. `research/` has the scripts that made the
recognizer's network; nothing here needs them.
"""
