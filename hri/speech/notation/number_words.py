"""Numbers in American English words: no "and" after hundreds, no hyphens."""

from __future__ import annotations

ONES = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
    "nineteen",
)
TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
SCALES = ("", " thousand", " million", " billion", " trillion")
LONGEST = 3 * len(SCALES)
"""Digits of the largest number that is read as one."""
ORDINALS = {
    "one": "first", "two": "second", "three": "third", "five": "fifth", "eight": "eighth",
    "nine": "ninth", "twelve": "twelfth",
}  # fmt: skip


def cardinal(number: int) -> str:
    """1234 is "one thousand two hundred thirty four". From 0; at most LONGEST digits."""
    if number == 0:
        return ONES[0]
    groups = []
    for scale in SCALES:
        number, group = divmod(number, 1000)
        if group:
            groups.append(_below_thousand(group) + scale)
    return " ".join(reversed(groups))


def _below_thousand(number: int) -> str:
    hundreds, rest = divmod(number, 100)
    words = [f"{ONES[hundreds]} hundred"] if hundreds else []
    if rest >= 20:
        words.append(TENS[rest // 10 - 2])
        rest %= 10
    if rest:
        words.append(ONES[rest])
    return " ".join(words)


def ordinal(number: int) -> str:
    """23 is "twenty third"."""
    head, space, last = cardinal(number).rpartition(" ")
    ending = last[:-1] + "ieth" if last.endswith("y") else last + "th"
    return head + space + ORDINALS.get(last, ending)


def year(number: int) -> str:
    """1984 is "nineteen eighty four", 2005 "two thousand five", 1905 "nineteen oh five"."""
    if number % 1000 < 10 or not 1000 <= number <= 9999:
        return cardinal(number)
    return in_pairs(str(number))


def in_pairs(digits: str) -> str:
    """Numbers of rooms, flights and houses: "204" is "two oh four", "1600" "sixteen hundred".

    Those of more than four digits are read digit by digit.
    """
    if digits[0] == "0" or len(digits) > 4:
        return by_digits(digits)
    high, low = divmod(int(digits), 100)
    if not high or (low == 0 and high % 10 == 0):
        return cardinal(int(digits))
    if low == 0:
        return f"{cardinal(high)} hundred"
    return f"{cardinal(high)} {'oh ' if low < 10 else ''}{cardinal(low)}"


def by_digits(digits: str) -> str:
    """ "911" is "nine one one"."""
    return " ".join(ONES[int(digit)] for digit in digits)


def number(written: str) -> str:
    """ "1,250.50" is "one thousand two hundred fifty point five zero", "007" "zero zero seven"."""
    whole, _, decimals = written.replace(",", "").partition(".")
    is_code = len(whole) > LONGEST or (len(whole) > 1 and whole[0] == "0")
    said = by_digits(whole) if is_code else cardinal(int(whole)) if whole else ""
    return f"{said} point {by_digits(decimals)}".strip() if decimals else said


def plural(words: str) -> str:
    """ "nineteen ninety" is "nineteen nineties"."""
    if words.endswith("y"):
        return words[:-1] + "ies"
    return words + ("es" if words.endswith("x") else "s")
