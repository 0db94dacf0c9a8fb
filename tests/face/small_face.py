"""A face of a few shapes, written into a folder for tests that spoil, turn or measure it."""

from pathlib import Path

from hri.face.vocabulary import LABELS, VISEMES

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'

NEUTRAL = f"""{HEAD} viewBox="0 0 100 100">
  <defs>
    <radialGradient id="skin" gradientUnits="userSpaceOnUse" cx="50" cy="40" r="50">
      <stop offset="0" stop-color="#ffe0c0"/>
      <stop offset="1" stop-color="#c09070"/>
    </radialGradient>
    <clipPath id="clipMouth"><path id="lips" d="M 35,70 Q 50,66 65,70 Q 50,74 35,70 Z"/></clipPath>
  </defs>
  <rect id="neck" x="40" y="80" width="20" height="20" fill="#777"/>
  <circle id="head" cx="50" cy="50" r="40" fill="url(#skin)"/>
  <circle id="eyeRight" cx="35" cy="45" r="6" fill="#123"/>
  <circle id="eyeLeft" cx="65" cy="45" r="6" fill="#123"/>
  <path id="brow" d="M 28,35 L 72,35" fill="none" stroke="#321" stroke-width="3"/>
  <g id="mouth" clip-path="url(#clipMouth)">
    <rect id="dark" x="30" y="60" width="40" height="30" fill="#400"/>
  </g>
  <ellipse id="tear" cx="70" cy="55" rx="2" ry="3" fill="#8cf" opacity="0"/>
</svg>
"""

TARGETS = {
    "jawOpen": '<path id="lips" d="M 35,70 Q 50,66 65,70 Q 50,94 35,70 Z"/>',
    "mouthSmile": '<path id="lips" d="M 31,64 Q 50,68 69,64 Q 50,78 31,64 Z"/>',
    "mouthSmile+jawOpen": '<path id="lips" d="M 29,62 Q 50,66 71,62 Q 50,99 29,62 Z"/>',
    "browInnerUp": '<path id="brow" d="M 28,33 L 72,31" fill="none" stroke="#321"/>',
    "eyeBlink": '<ellipse id="eyeRight" cx="35" cy="47" rx="6" ry="1" fill="#123"/>'
    '<ellipse id="eyeLeft" cx="65" cy="47" rx="6" ry="1" fill="#123"/>',
    "tear": '<ellipse id="tear" cx="70" cy="65" rx="2" ry="3" fill="#8cf"/>',
}

FACE = """
about = "A test"

[background]
middle = "#ffffff"
corners = "#000000"

[head]
center = [50, 50]
radius = [40, 40]
still = ["neck"]

[head.depths]
"eye*" = 5

[timing.surprised]
onset_s = 0.1

[affect]
happy = [0.5, 0.25]

[aliases]
glad = "happy"

[blink]
weights = { eyeBlink = 1.0 }

[gaze]
right = { headX = 0.5 }
left = { headX = -0.5 }
up = {}
down = {}

[motion]
pivot = [50, 90]
"""


def write_face(folder: Path) -> Path:
    """Write all its files; the folder again."""
    (folder / "targets").mkdir(parents=True)
    (folder / "neutral.svg").write_text(NEUTRAL)
    for name, shapes in TARGETS.items():
        write_target(folder, name, shapes)
    lines = [FACE]
    for number, label in enumerate(LABELS):
        lines.append(f"[expressions.{label}]\nmouthSmile = {number / 40}\n")
    lines += [f"[visemes.{name}]\njawOpen = {n / 20}\n" for n, name in enumerate(VISEMES)]
    (folder / "face.toml").write_text("\n".join(lines))
    return folder


def write_target(folder: Path, name: str, shapes: str, view_box: str = "0 0 100 100") -> Path:
    """Write the drawing of a target; its file."""
    file = folder / "targets" / f"{name}.svg"
    file.write_text(f'{HEAD} viewBox="{view_box}">\n{shapes}\n</svg>\n')
    return file
