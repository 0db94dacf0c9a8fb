"""Signs of units and currencies."""

from __future__ import annotations

LENGTHS = {
    "mm": ("millimeter", "millimeters"), "cm": ("centimeter", "centimeters"),
    "m": ("meter", "meters"), "km": ("kilometer", "kilometers"), "in": ("inch", "inches"),
    "ft": ("foot", "feet"), "yd": ("yard", "yards"), "mi": ("mile", "miles"),
    "dm": ("decimeter", "decimeters"), "nm": ("nanometer", "nanometers"),
    "µm": ("micrometer", "micrometers"),
}  # fmt: skip
"""Those that have squares and cubes."""
_UNITS = LENGTHS | {
    "g": ("gram", "grams"), "kg": ("kilogram", "kilograms"), "mg": ("milligram", "milligrams"),
    "µg": ("microgram", "micrograms"), "mcg": ("microgram", "micrograms"),
    "kgs": ("kilogram", "kilograms"),
    "lb": ("pound", "pounds"), "lbs": ("pound", "pounds"), "oz": ("ounce", "ounces"),
    "fl oz": ("fluid ounce", "fluid ounces"), "t": ("ton", "tons"),
    "L": ("liter", "liters"), "l": ("liter", "liters"), "mL": ("milliliter", "milliliters"),
    "ml": ("milliliter", "milliliters"), "cL": ("centiliter", "centiliters"),
    "cl": ("centiliter", "centiliters"), "dL": ("deciliter", "deciliters"),
    "dl": ("deciliter", "deciliters"), "µL": ("microliter", "microliters"),
    "gal": ("gallon", "gallons"), "qt": ("quart", "quarts"), "pt": ("pint", "pints"),
    "tbsp": ("tablespoon", "tablespoons"), "tsp": ("teaspoon", "teaspoons"),
    "cc": ("cubic centimeter", "cubic centimeters"),
    "s": ("second", "seconds"), "sec": ("second", "seconds"), "secs": ("second", "seconds"),
    "ms": ("millisecond", "milliseconds"), "µs": ("microsecond", "microseconds"),
    "ns": ("nanosecond", "nanoseconds"), "min": ("minute", "minutes"),
    "mins": ("minute", "minutes"), "h": ("hour", "hours"), "hr": ("hour", "hours"),
    "hrs": ("hour", "hours"), "wk": ("week", "weeks"), "wks": ("week", "weeks"),
    "mo": ("month", "months"),
    "mos": ("month", "months"), "yr": ("year", "years"), "yrs": ("year", "years"),
    "Hz": ("hertz", "hertz"), "kHz": ("kilohertz", "kilohertz"), "MHz": ("megahertz", "megahertz"),
    "GHz": ("gigahertz", "gigahertz"), "V": ("volt", "volts"), "mV": ("millivolt", "millivolts"),
    "kV": ("kilovolt", "kilovolts"), "A": ("amp", "amps"), "mA": ("milliamp", "milliamps"),
    "W": ("watt", "watts"), "mW": ("milliwatt", "milliwatts"), "kW": ("kilowatt", "kilowatts"),
    "MW": ("megawatt", "megawatts"), "GW": ("gigawatt", "gigawatts"),
    "Wh": ("watt hour", "watt hours"), "kWh": ("kilowatt hour", "kilowatt hours"),
    "MWh": ("megawatt hour", "megawatt hours"), "Ah": ("amp hour", "amp hours"),
    "mAh": ("milliamp hour", "milliamp hours"), "Ω": ("ohm", "ohms"), "kΩ": ("kiloohm", "kiloohms"),
    "MΩ": ("megaohm", "megaohms"), "F": ("farad", "farads"), "µF": ("microfarad", "microfarads"),
    "nF": ("nanofarad", "nanofarads"), "pF": ("picofarad", "picofarads"),
    "J": ("joule", "joules"), "kJ": ("kilojoule", "kilojoules"), "N": ("newton", "newtons"),
    "kN": ("kilonewton", "kilonewtons"), "Nm": ("newton meter", "newton meters"),
    "N·m": ("newton meter", "newton meters"), "Pa": ("pascal", "pascals"),
    "kPa": ("kilopascal", "kilopascals"), "hPa": ("hectopascal", "hectopascals"),
    "MPa": ("megapascal", "megapascals"), "mbar": ("millibar", "millibars"),
    "psi": ("pound per square inch", "pounds per square inch"), "hp": ("horsepower", "horsepower"),
    "cal": ("calorie", "calories"), "kcal": ("kilocalorie", "kilocalories"),
    "lm": ("lumen", "lumens"), "lx": ("lux", "lux"), "mol": ("mole", "moles"),
    "K": ("kelvin", "kelvin"), "dB": ("decibel", "decibels"), "dBA": ("decibel", "decibels"),
    "rad": ("radian", "radians"), "deg": ("degree", "degrees"), "px": ("pixel", "pixels"),
    "MP": ("megapixel", "megapixels"), "ppm": ("part per million", "parts per million"),
    "bit": ("bit", "bits"), "kbit": ("kilobit", "kilobits"), "Mbit": ("megabit", "megabits"),
    "B": ("byte", "bytes"), "KB": ("kilobyte", "kilobytes"), "kB": ("kilobyte", "kilobytes"),
    "MB": ("megabyte", "megabytes"), "GB": ("gigabyte", "gigabytes"),
    "TB": ("terabyte", "terabytes"), "PB": ("petabyte", "petabytes"),
    "KiB": ("kibibyte", "kibibytes"), "MiB": ("mebibyte", "mebibytes"),
    "GiB": ("gibibyte", "gibibytes"), "Mb": ("megabit", "megabits"), "Gb": ("gigabit", "gigabits"),
    "kbps": ("kilobit per second", "kilobits per second"),
    "Kbps": ("kilobit per second", "kilobits per second"),
    "Mbps": ("megabit per second", "megabits per second"),
    "Gbps": ("gigabit per second", "gigabits per second"),
    "mph": ("mile per hour", "miles per hour"), "mpg": ("mile per gallon", "miles per gallon"),
    "kph": ("kilometer per hour", "kilometers per hour"),
    "kmh": ("kilometer per hour", "kilometers per hour"),
    "rpm": ("revolution per minute", "revolutions per minute"),
    "RPM": ("revolution per minute", "revolutions per minute"),
    "bpm": ("beat per minute", "beats per minute"), "BPM": ("beat per minute", "beats per minute"),
    "fps": ("frame per second", "frames per second"),
    "FPS": ("frame per second", "frames per second"), "dpi": ("dot per inch", "dots per inch"),
    "sq ft": ("square foot", "square feet"), "sq mi": ("square mile", "square miles"),
    "sq m": ("square meter", "square meters"), "sqft": ("square foot", "square feet"),
    "sq. ft.": ("square foot", "square feet"), "cu ft": ("cubic foot", "cubic feet"),
    "ha": ("hectare", "hectares"), "ac": ("acre", "acres"), "pct": ("percent", "percent"),
    "doz": ("dozen", "dozen"),
}  # fmt: skip
_IN_ANY_CASE = (
    *(
        "km",
        "cm",
        "mm",
        "kg",
        "kgs",
        "mg",
        "lb",
        "lbs",
        "oz",
        "ft",
        "yd",
        "ml",
        "mph",
        "kmh",
        "kph",
    ),
    *("Hz", "kHz", "MHz", "GHz", "kWh", "kW", "mAh", "dB", "GB", "MB", "TB", "Mbps", "Gbps", "min"),
    *("mins", "hr", "hrs", "sec", "secs", "yrs", "psi", "rpm", "fps", "bpm", "dpi", "kcal", "tbsp"),
    "tsp",
)
UNITS = {
    written: _UNITS[unit]
    for unit in _IN_ANY_CASE
    for written in (unit.lower(), unit.upper(), unit.capitalize())
} | _UNITS
"""One and many of each."""
AFTER_PER = {"d": "day"}
"""Short names of what amounts are counted by, besides units: "$20/d"."""
CURRENCIES = {
    "$": ("dollar", "dollars", "cent", "cents"), "£": ("pound", "pounds", "penny", "pence"),
    "€": ("euro", "euros", "cent", "cents"), "¥": ("yen", "yen", "sen", "sen"),
    "₹": ("rupee", "rupees", "paisa", "paise"), "₩": ("won", "won", "jeon", "jeon"),
    "₽": ("ruble", "rubles", "kopek", "kopeks"), "₿": ("bitcoin", "bitcoin", "", ""),
}  # fmt: skip
"""One and many of each, and of its hundredth part."""
COINS = {
    "US$": ("", "$"), "C$": ("Canadian ", "$"), "CA$": ("Canadian ", "$"),
    "A$": ("Australian ", "$"), "AU$": ("Australian ", "$"), "USD": ("", "$"), "EUR": ("", "€"),
    "GBP": ("", "£"), "JPY": ("", "¥"), "INR": ("", "₹"), "CAD": ("Canadian ", "$"),
    "AUD": ("Australian ", "$"),
} | {sign: ("", sign) for sign in CURRENCIES}  # fmt: skip
"""What stands for a currency: whose it is, and its sign."""
SCALES = {
    "k": "thousand", "K": "thousand", "m": "million", "M": "million", "mn": "million",
    "mm": "million", "MM": "million", "b": "billion", "B": "billion", "bn": "billion",
    "T": "trillion", "tn": "trillion",
} | {name: name for name in ("hundred", "thousand", "million", "billion", "trillion")}  # fmt: skip
