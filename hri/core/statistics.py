"""How sure a counted share is."""

from __future__ import annotations

import math

Z_95 = 1.959964
"""The standard normal distribution holds 95 % within this many deviations of its middle."""


def wilson(count: int, total: int) -> tuple[float, float]:
    """The 95 % score interval of the share `count` of `total`; 0 to 1 when nothing was counted.

    E. B. Wilson, "Probable inference, the law of succession, and statistical inference", Journal
    of the American Statistical Association 22 (1927), 209-212.
    """
    if total == 0:
        return 0.0, 1.0
    rate, spread = count / total, Z_95**2 / total
    middle = (rate + spread / 2) / (1 + spread)
    half = Z_95 / (1 + spread) * math.sqrt(rate * (1 - rate) / total + spread / (4 * total))
    # Rounding must not leave the share outside.
    return max(0.0, min(middle - half, rate)), min(1.0, max(middle + half, rate))


def told(count: int, total: int) -> str:
    """For people: "63 of 65, 97 % (89 to 99 %)"."""
    if total == 0:
        return "none"
    low, high = wilson(count, total)
    return f"{count} of {total}, {count / total:.0%} ({low:.0%} to {high:.0%})".replace("%", " %")
