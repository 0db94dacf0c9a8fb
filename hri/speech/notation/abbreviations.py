"""Abbreviations, and what is said for them."""

from __future__ import annotations

MONTHS = (
    "January", "February", "March", "April", "May", "June", "July", "August", "September",
    "October", "November", "December",
)  # fmt: skip
_MONTH_OF = {name[:3]: name for name in MONTHS} | {"Sept": "September"} | {n: n for n in MONTHS}
MONTH_OF = _MONTH_OF | {
    written: month
    for name, month in _MONTH_OF.items()
    for written in (name.upper(), name.lower())
    if written not in ("may", "mar", "march")
}
"""The months by their names, whole or short, also in capitals or small letters."""
DAYS = ("Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday", "Sunday")
DAY_OF = (
    {name[:3]: name for name in DAYS}
    | {"Tues": "Tuesday", "Thur": "Thursday", "Thurs": "Thursday"}
    | {name: name for name in DAYS}
)
TITLES = {
    "Mr": "Mister", "Mrs": "Mrs", "Ms": "Miz", "Mx": "Mix", "Dr": "Doctor", "Prof": "Professor",
    "St": "Saint", "Mt": "Mount", "Ft": "Fort", "Gen": "General", "Gov": "Governor",
    "Sen": "Senator", "Rep": "Representative", "Capt": "Captain", "Lt": "Lieutenant",
    "Col": "Colonel", "Sgt": "Sergeant", "Cmdr": "Commander", "Rev": "Reverend",
    "Hon": "Honorable", "Pres": "President", "Supt": "Superintendent", "Cpl": "Corporal",
    "Pvt": "Private", "Maj": "Major", "Adm": "Admiral", "Fr": "Father", "Msgr": "Monsignor",
    "Sec": "Secretary", "Amb": "Ambassador", "Insp": "Inspector", "Det": "Detective",
}  # fmt: skip
"""Before a name."""
WITHOUT_PERIOD = frozenset(("Mr", "Mrs", "Ms", "Mx", "Dr", "Prof", "St", "Mt", "Lt", "Sgt"))
"""Titles that are written without one, too."""
STREETS = {
    "St": "Street", "Dr": "Drive", "Ave": "Avenue", "Av": "Avenue", "Blvd": "Boulevard",
    "Rd": "Road", "Ln": "Lane", "Hwy": "Highway", "Pkwy": "Parkway", "Ct": "Court", "Pl": "Place",
    "Sq": "Square", "Ter": "Terrace", "Cir": "Circle", "Expy": "Expressway", "Fwy": "Freeway",
    "Trl": "Trail", "Aly": "Alley", "Plz": "Plaza", "Tpke": "Turnpike",
}  # fmt: skip
"""After a name."""
STREET_NAMES = frozenset((*STREETS.values(), "Way", "Row", "Broadway", "Loop"))
DIRECTIONS = {
    "N": "North", "S": "South", "E": "East", "W": "West", "NE": "Northeast", "NW": "Northwest",
    "SE": "Southeast", "SW": "Southwest",
}  # fmt: skip
STATES = {
    "AL": "Alabama", "AK": "Alaska", "AZ": "Arizona", "AR": "Arkansas", "CA": "California",
    "CO": "Colorado", "CT": "Connecticut", "DE": "Delaware", "FL": "Florida", "GA": "Georgia",
    "HI": "Hawaii", "ID": "Idaho", "IL": "Illinois", "IN": "Indiana", "IA": "Iowa",
    "KS": "Kansas", "KY": "Kentucky", "LA": "Louisiana", "ME": "Maine", "MD": "Maryland",
    "MA": "Massachusetts", "MI": "Michigan", "MN": "Minnesota", "MS": "Mississippi",
    "MO": "Missouri", "MT": "Montana", "NE": "Nebraska", "NV": "Nevada", "NH": "New Hampshire",
    "NJ": "New Jersey", "NM": "New Mexico", "NY": "New York", "NC": "North Carolina",
    "ND": "North Dakota", "OH": "Ohio", "OK": "Oklahoma", "OR": "Oregon", "PA": "Pennsylvania",
    "RI": "Rhode Island", "SC": "South Carolina", "SD": "South Dakota", "TN": "Tennessee",
    "TX": "Texas", "UT": "Utah", "VT": "Vermont", "VA": "Virginia", "WA": "Washington",
    "WV": "West Virginia", "WI": "Wisconsin", "WY": "Wyoming", "DC": "D C",
}  # fmt: skip
"""After a city and a comma, or before a ZIP code."""
BEFORE_NUMBERS = {
    "no": "number", "nos": "numbers", "p": "page", "pp": "pages", "vol": "volume",
    "vols": "volumes", "fig": "figure", "figs": "figures", "ch": "chapter", "sec": "section",
    "sect": "section", "ver": "version", "art": "article", "ext": "extension", "tel": "telephone",
    "c": "circa", "ca": "circa", "eq": "equation", "apt": "apartment", "ste": "suite",
    "rm": "room", "fl": "floor", "bldg": "building", "para": "paragraph", "ln": "line",
    "pg": "page", "hwy": "highway", "rte": "route", "rt": "route",
}  # fmt: skip
"""In any case of letters, with a period."""
PLAIN = {
    "e.g.": "for example", "i.e.": "that is", "eg.": "for example", "etc.": "et cetera",
    "&c.": "et cetera", "vs.": "versus", "vs": "versus", "cf.": "compare", "et al.": "et al",
    "viz.": "namely", "a.k.a.": "also known as", "aka": "also known as",
    "AKA": "also known as", "approx.": "approximately", "est.": "established",
    "dept.": "department", "Dept.": "Department", "govt.": "government", "Govt.": "Government",
    "Univ.": "University", "Assn.": "Association", "Inc.": "Incorporated", "Inc": "Incorporated",
    "Ltd.": "Limited", "Ltd": "Limited", "Corp.": "Corporation", "Co.": "Company",
    "Bros.": "Brothers", "Jr.": "Junior", "Jr": "Junior", "Sr.": "Senior", "Sr": "Senior",
    "Esq.": "Esquire", "Atty.": "Attorney", "Asst.": "Assistant", "asst.": "assistant",
    "Attn.": "Attention", "misc.": "miscellaneous", "avg.": "average", "max.": "maximum",
    "min.": "minimum", "temp.": "temperature", "incl.": "including", "excl.": "excluding",
    "w/": "with", "w/o": "without", "b/c": "because", "ed.": "edition",
    "eds.": "editors", "Apt.": "Apartment", "Ste.": "Suite", "Bldg.": "Building",
    "Mt.": "Mount", "tbsp": "tablespoons", "tsp": "teaspoons", "tbsp.": "tablespoons",
    "tsp.": "teaspoons", "lbs.": "pounds", "oz.": "ounces", "qty.": "quantity",
    "Qty.": "Quantity", "intl.": "international", "Intl.": "International",
    "Ph.D.": "P H D", "PhD": "P H D", "M.D.": "M D", "B.A.": "B A", "M.A.": "M A",
    "B.S.": "B S", "M.Sc.": "M S C", "BTW": "by the way", "IMO": "in my opinion",
    "TBD": "T B D", "ASAP": "as soon as possible", "FYI": "F Y I", "'n'": "and",
    "appt.": "appointment", "hrs.": "hours", "mins.": "minutes", "secs.": "seconds",
    "yrs.": "years", "wk.": "week", "mo.": "month", "yr.": "year", "hr.": "hour",
    "ext.": "extension", "tel.": "telephone", "Tel.": "Telephone", "vol.": "volume",
    "Vol.": "Volume", "fig.": "figure", "Fig.": "Figure", "pp.": "pages", "Ave.": "Avenue",
    "Blvd.": "Boulevard", "Rd.": "Road", "Hwy.": "Highway", "Pkwy.": "Parkway", "St.": "Street",
    "Mr.": "Mister", "Mrs.": "Mrs", "Ms.": "Miz", "Dr.": "Doctor", "Prof.": "Professor",
    "WWI": "World War one", "WWII": "World War two", "N/A": "N A", "n/a": "N A", "I/O": "I O",
}  # fmt: skip
SPELLED = {
    "xml": "X M L", "html": "H T M L", "css": "C S S", "js": "J S", "py": "P Y", "txt": "T X T",
    "csv": "C S V", "pdf": "P D F", "png": "P N G", "jpg": "J P G", "jpeg": "J peg",
    "svg": "S V G", "mp": "M P", "exe": "E X E", "md": "M D", "rs": "R S", "ts": "T S",
    "cpp": "C P P", "sh": "S H", "yml": "Y M L", "yaml": "yammel", "json": "jason",
    "toml": "tommel", "ini": "I N I", "cfg": "C F G", "conf": "conf", "log": "log", "wav": "wave",
    "ogg": "ogg", "zip": "zip", "tar": "tar", "gz": "G Z", "tgz": "T G Z", "docx": "doc X",
    "doc": "doc", "xlsx": "X L S X", "xls": "X L S", "pptx": "P P T X", "ppt": "P P T",
    "bmp": "B M P", "tiff": "tiff", "gif": "gif", "webp": "web P", "c": "C", "h": "H",
    "hpp": "H P P", "so": "S O", "dll": "D L L", "deb": "deb", "rpm": "R P M", "iso": "I S O",
    "sql": "S Q L", "db": "D B", "ipynb": "I P Y N B", "gov": "gov", "edu": "E D U", "io": "I O",
    "uk": "U K", "us": "U S", "de": "D E", "ai": "A I", "eu": "E U", "tv": "T V", "ly": "L Y",
    "fr": "F R", "ca": "C A", "jp": "J P", "www": "w w w", "jsgf": "J S G F", "bat": "bat",
    "http": "H T T P", "https": "H T T P S", "ftp": "F T P", "bin": "bin", "lock": "lock",
    "mkv": "M K V", "avi": "A V I", "mov": "M O V", "aac": "A A C", "flac": "flack", "rb": "R B",
    "go": "go", "java": "java", "kt": "K T", "tsx": "T S X", "jsx": "J S X", "onnx": "onnix",
    "npz": "N P Z", "npy": "N P Y", "usb": "U S B", "etc": "E T C", "usr": "user", "tmp": "temp",
    "dev": "dev", "lib": "lib", "src": "source", "rss": "R S S", "php": "P H P", "asp": "A S P",
    "apk": "A P K", "dmg": "D M G", "rtf": "R T F", "ttf": "T T F", "epub": "E pub",
}  # fmt: skip
"""Parts of names of files and of addresses."""
