"""Signs of arithmetic and of programs, and what is silent."""

# ruff: noqa: RUF001 - signs of texts are meant.
from __future__ import annotations

import re
import unicodedata

from hri.speech.notation import hyphens, number_words as say
from hri.speech.notation.abbreviations import SPELLED
from hri.speech.notation.context import text_after, text_before
from hri.speech.notation.rule import SUPERSCRIPTS, Match, Rule, Scan, rule

WORDS = {
    "=": "equals", "+": "plus", "<": "less than", ">": "greater than", "±": "plus or minus",
    "×": "times", "÷": "divided by", "−": "minus", "≈": "approximately", "≠": "not equal to",
    "≤": "less than or equal to", "≥": "greater than or equal to", "√": "the square root of",
    "∞": "infinity", "→": "to", "⇒": "implies", "&": "and", "@": "at", "%": "percent",
    "‰": "per mille", "$": "dollar", "€": "euro", "£": "pound", "¥": "yen", "¢": "cents",
    "§": "section", "¶": "paragraph", "©": "copyright", "°": "degrees", "℃": "degrees Celsius",
    "℉": "degrees Fahrenheit", "µ": "micro", "№": "number", "∆": "delta", "∑": "sum", "⁄": "slash",
    "∴": "therefore", "∈": "in", "∝": "proportional to",
}  # fmt: skip
"""What is said for a sign, wherever it stands."""
PAUSES = frozenset(".,;:!?…—()\"'“”")
"""Signs that are heard in the melody, and so stay."""
_ASKED = re.compile(
    r"(?i)\b(?:what'?s|what is|calculate|compute|how much is|equals?) [\d. ]+$|[\sa-z]= ?[\d. ]+$"
)
_PRODUCT = re.compile(r" ?\S{1,12} ?=| ?10[⁰¹²³⁴-⁹⁻^]")
_FACTOR = re.compile(
    r" (?:more|faster|slower|as|bigger|better|larger|smaller|cheaper|the|a day|daily|per|longer"
    r"|higher|lower|less|speed|zoom)\b|[.,;!?]?$|[.,;!?]\s"
)


def _slash(match: Match, scan: Scan) -> str:
    before, after = text_before(match)[-1:], text_after(match)
    if scan.is_after_amount and re.match(r" ?\d", after):
        return "divided by"
    if before.isalpha() and after[:1].isalpha():
        return ""
    return "slash" if before.isalnum() or after[:1].isalnum() else ""


def _star(match: Match, scan: Scan) -> str:
    before, after = text_before(match), text_after(match)
    is_product = scan.is_after_amount and re.match(r" ?[\d(a-z]", after)
    is_letters = re.search(r"\b[a-z] ?$", before) and re.match(r" ?[a-z]\b", after)
    return "times" if is_product or is_letters else ""


def _times(match: Match, scan: Scan) -> str:
    """The sign of a product, or of a size."""
    before, after = text_before(match), text_after(match)
    is_product = not scan.is_after_amount or _ASKED.search(before) or _PRODUCT.match(after)
    return "times" if is_product else "by"


def _letter_x(match: Match, scan: Scan) -> str | None:
    """4x6, "3x faster", "a 10x engineer"."""
    if not scan.is_after_amount:
        return None
    if re.match(r" ?[\d.½¼¾]", text_after(match)):
        return _times(match, scan)
    if not text_before(match)[-1:].isdecimal():
        return None
    return "times" if _FACTOR.match(text_after(match)) else "X"


def _colon(match: Match, scan: Scan) -> str | None:
    is_ratio = re.search(r"\d$", text_before(match)) and re.match(r"\d", text_after(match))
    is_apart = re.search(r"\d $", text_before(match)) and re.match(r" \d", text_after(match))
    return "to" if scan.is_after_amount and (is_ratio or is_apart) else None


_POWERS = {"2": "squared", "3": "cubed", "-": "minus", "+": "plus"}


def _power(match: Match, scan: Scan) -> str:
    power = match[1].translate(_DIGITS)
    if power in _POWERS:
        return _POWERS[power]
    sign = "minus " if power[0] == "-" else ""
    power = power.lstrip("+-")
    return f"to the power of {sign}{say.number(power) if power.isdecimal() else power}"


def _underscore(match: Match, scan: Scan) -> str:
    inside = text_before(match)[-1:].isalnum() and text_after(match)[:1].isalnum()
    return "underscore" if inside and len(match[0]) == 1 else ""


def _hash(match: Match, scan: Scan) -> str:
    after = text_after(match)
    if after[:1].isdecimal():
        return "number"
    return "hashtag" if after[:1].isalpha() else ""


def _tilde(match: Match, scan: Scan) -> str:
    return "about" if re.match(r" ?[$€£]?\d", text_after(match)) else ""


def _backslash(match: Match, scan: Scan) -> str:
    return "backslash" if text_after(match)[:1].isalnum() else ""


def _short_year(match: Match, scan: Scan) -> str | None:
    """'76, but not digits that close a quotation."""
    return None if scan.is_quoted else say.in_pairs(match[1]).replace("zero", "oh", 1)


def _dotted(match: Match, scan: Scan) -> str | None:
    """The end of a name, by itself: ".NET", ".txt"."""
    name = match[1].lower()
    if text_before(match)[-1:].isalnum():
        return None
    return f"dot {SPELLED.get(name, name)}" if name in SPELLED or name in ("net", "com") else None


def _greek(match: Match, scan: Scan) -> str | None:
    words = unicodedata.name(match[0], "").lower().split()
    return words[-1].replace("lamda", "lambda") if words[-2:-1] == ["letter"] else None


def _comparison(match: Match, scan: Scan) -> str | None:
    """< and > between two things; alone they are of some markup."""
    before, after = text_before(match).strip(), text_after(match).strip()
    is_between = before[-1:].isalnum() and re.match(r"[\w$€£.-]", after)
    return WORDS[match[0]] if is_between or re.match(r" ?[$€£]?\d", text_after(match)) else ""


_DIGITS = str.maketrans(SUPERSCRIPTS, "0123456789-+")
_EMOTICON = rule(r"[:;=8]['’]?-[()DPpO/|](?!\w)|(?<!\S)[:;=][()DPpO](?!\w)|<3(?!\d)", "")
_RULE = rule(r"([-–—=_*~#])\1{2,200}", "")
"""A line drawn of signs."""
_REPEATED = rule(r"([!?,;:])\1{1,80}", "{1}")
RULES: tuple[tuple[str, tuple[Rule, ...]], ...] = (
    (":;=8<", (_EMOTICON,)),
    ("-–—=_*~#", (_RULE,)),
    ("!?,;:", (_REPEATED,)),
    ("-", hyphens.DOUBLE),
    ("-–", hyphens.SINGLE),
    ("=", (rule(r"=>", "to"), rule(r"={2,3}(?!=)", "equals"))),
    ("!", (rule(r"!=", "not equal to"),)),
    ("<", (rule(r"<=(?!>)", "less than or equal to"),)),
    (">", (rule(r">=", "greater than or equal to"),)),
    ("<>", (rule(r"[<>]", _comparison),)),
    ("&", (rule(r"&&", "and"),)),
    ("'", (
        rule(r"'(\d0)s\b", lambda m, s: say.plural(say.cardinal(int(m[1])))),
        rule(r"'(\d\d)(?![\w'])", _short_year),
        rule(r"'n'(?!\w)", "and"),
    )),
    (".", (
        rule(r"\.([A-Za-z]{2,9})\b", _dotted),
        rule(r"\.{2,80}", "..."),
    )),
    (SUPERSCRIPTS, (rule(r"([⁻⁺]?[⁰¹²³⁴-⁹]{1,12}|[⁻⁺])", _power),)),
    ("^", (rule(r"\^ ?\(?([-+]?\d{1,9}|[a-z])\)?(?!\w)", _power), rule(r"\^", ""))),
    ("/", (rule(r"/", _slash),)),
    ("*", (rule(r"\*{1,2}", _star),)),
    ("×", (rule(r"×", _times),)),
    (":", (rule(r":", _colon),)),
    ("_", (rule(r"_{1,2}", _underscore),)),
    ("#", (rule(r"#{1,40}", _hash),)),
    ("~", (rule(r"~{1,2}", _tilde),)),
    ("\\", (rule(r"\\", _backslash),)),
    ("|", (rule(r"\|{1,40}", ","),)),
)  # fmt: skip
"""What a sign may begin."""
LETTERS: tuple[Rule, ...] = (
    rule(r"[xX](?=\b| ?\d)", _letter_x),
    rule(r"[aA](?= ?(?:[=+*^<>≤≥≠×÷²³]|->))", "A"),
    rule(r"[Ͱ-Ͽ](?![Ͱ-Ͽ])(?<![Ͱ-Ͽ]{2})", _greek),
)


def alone(sign: str) -> str | None:
    """What is said for a sign that no rule reads; None for one that stays."""
    if sign in WORDS:
        return WORDS[sign]
    if (number := unicodedata.digit(sign, None)) is not None:
        return say.cardinal(number)  # a number in a circle
    if sign in PAUSES or sign.isspace() or unicodedata.category(sign)[0] in "LN":
        return None
    return None if unicodedata.category(sign) in ("Mn", "Mc", "Pd") else ""
