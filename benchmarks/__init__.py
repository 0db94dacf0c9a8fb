"""Research, run from a checkout by `make bench`: comparisons with other programs, judgments of
recordings and made films, faults and bad inputs by the thousand, and training.

What judges the machine of a user is in `hri.bench`. `phone_network/` has separate scripts.
"""
