"""The compiled loops that paint a face: outlines become coverage, colors are laid through it.

Coverage is exact: each edge is cut at the lines between pixels, and adds to its pixel the area on
its right side, to the next one the rest; a sum along the row gives what is covered (Levien's
font-rs and FreeType's smooth rasterizer do the same). Where an outline overlaps itself, it is
covered once.

All that is compiled stands in this file: numba looks at no other to tell whether what it kept is
out of date. So whoever changes a number of `instructions` touches this file too.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.face.renderers.compiling import compiled, inlined
from hri.face.renderers.instructions import (
    BITS,
    BLOCK,
    CLOSING,
    FAINT,
    FULL,
    HALF,
    OPENING,
    RADIAL,
    SHADES,
    SHIFT,
    SOLID,
    STEPS,
    Box,
    Contours,
    Floats,
    Picture,
    Program,
    Scratch,
    Whole,
)

# Numbers of machine code; what they are to Python does not matter.
int32: Any = np.int32
int64: Any = np.int64
uint32: Any = np.uint32
uint64: Any = np.uint64
float32: Any = np.float32
float64: Any = np.float64

_VARIED = -1
"""Coverage that is not the same all over a span."""
_RED_BLUE, _ALPHA_GREEN = uint32(0x00FF00FF), uint32(0xFF00FF00)
_HALVES, _SOLID = uint32(0x00800080), uint32(0xFF000000)
_BYTE, _HALF_BYTE = uint32(8), uint32(0x80)


@compiled
def paint(
    program: Program, vertices: Whole, scalars: Floats, scratch: Scratch, canvas: Picture
) -> None:
    """Paint a program on a canvas.

    `vertices` are in steps, [n, 2]. The scratch must be as it was made, or as an earlier picture
    left it.
    """
    steps, contours, ramps = program
    sums, touched, alphas, spans, shades, masks, below = scratch
    boxes = np.zeros((len(masks) + 1, 4), np.int64)
    boxes[0, 2], boxes[0, 3] = canvas.shape[1], canvas.shape[0]
    depth = number = int64(0)
    while number < len(steps):
        step = steps[number]
        number += 1
        limits = boxes[depth, 0], boxes[depth, 1], boxes[depth, 2], boxes[depth, 3]
        if step.kind == CLOSING:
            depth -= 1
            _close(canvas, below, masks, depth, limits)
            continue
        box = _box(vertices, contours, step.first, step.last, limits)
        opacity = scalars[step.scalar]
        if not opacity >= FAINT or box[0] >= box[2] or box[1] >= box[3]:
            number = max(number, step.closing + 1)
            continue
        _add(sums, touched, vertices, contours, step.first, step.last, box)
        is_opening = step.kind == OPENING
        opacity = float32(1) if is_opening else min(opacity, float32(1))
        count = _cover(sums, touched, alphas, spans, box, opacity)
        if is_opening:
            _open(canvas, below, masks, depth, box, alphas, spans, count)
            depth += 1
            boxes[depth, 0], boxes[depth, 1], boxes[depth, 2], boxes[depth, 3] = box
            continue
        place = _place(step.kind, vertices, step.anchor)
        ramp, is_radial = ramps[step.ramp], step.kind == RADIAL
        _lay(canvas, ramp, step.is_opaque, is_radial, place, alphas, spans, count, shades)


# --- coverage ---


@inlined
def _box(vertices: Whole, contours: Contours, first: int, last: int, limits: Box) -> Box:
    """Pixels within limits that contours touch; it may be empty."""
    low_x = high_x = vertices[contours[first, 0], 0]
    low_y = high_y = vertices[contours[first, 0], 1]
    for vertex in range(contours[first, 0], contours[last - 1, 1]):
        x, y = vertices[vertex, 0], vertices[vertex, 1]
        low_x, high_x = x if x < low_x else low_x, x if x > high_x else high_x
        low_y, high_y = y if y < low_y else low_y, y if y > high_y else high_y
    left, top, right, bottom = limits
    low_x, high_x = low_x >> BITS, (high_x + STEPS - 1) >> BITS
    low_y, high_y = low_y >> BITS, (high_y + STEPS - 1) >> BITS
    left, right = low_x if low_x > left else left, high_x if high_x < right else right
    top, bottom = low_y if low_y > top else top, high_y if high_y < bottom else bottom
    return left, top, right, bottom


@inlined
def _add(
    sums: Whole,
    touched: NDArray[np.bool_],
    vertices: Whole,
    contours: Contours,
    first: int,
    last: int,
    box: Box,
) -> None:
    """Add the edges of contours to the sums of a box.

    Edges left of the box cover its whole rows, edges right of it cover nothing.
    """
    # One function of many loops: passing arrays on takes longer than what is done with them.
    left, top, right, bottom = box
    for contour in range(first, last):
        start, end = contours[contour, 0], contours[contour, 1]
        x1, y1 = int64(vertices[end - 1, 0]), int64(vertices[end - 1, 1])
        for vertex in range(start, end):
            x0, y0 = x1, y1
            x1, y1 = int64(vertices[vertex, 0]), int64(vertices[vertex, 1])
            if y0 == y1 or (x0 >> BITS >= right and x1 >> BITS >= right):
                continue
            way = 1 if y0 < y1 else -1
            upper_x, upper_y = (x0, y0) if y0 < y1 else (x1, y1)
            lower_x, lower_y = (x1, y1) if y0 < y1 else (x0, y0)
            slope = (x1 - x0) / (y1 - y0)
            y, floor = max(upper_y, top << BITS), min(lower_y, bottom << BITS)
            x = upper_x + int64((y - upper_y) * slope + 0.5)
            while y < floor:
                row = y >> BITS
                lower = min((row + 1) << BITS, floor)
                after = upper_x + int64((lower - upper_y) * slope + 0.5)
                if lower == lower_y:
                    after = lower_x
                # The piece of the edge in this row, from its left end.
                height, low, high = lower - y, min(x, after), max(x, after)
                y, x = lower, after
                at, done = low, 0
                if low < left << BITS:
                    at = left << BITS
                    done = height
                    if high > at:
                        done = int64((at - low) * height / (high - low) + 0.5)
                    sums[row, left] += way * done * 2 * STEPS
                    touched[row, left // BLOCK] = True
                column = at >> BITS
                while done < height and column < right:
                    stop = min((column + 1) << BITS, high)
                    covered = height
                    if stop < high:
                        covered = int64((stop - low) * height / (high - low) + 0.5)
                    rest = way * (covered - done) * (at + stop - (column << (BITS + 1)))
                    sums[row, column] += way * (covered - done) * 2 * STEPS - rest
                    touched[row, column // BLOCK] = True
                    at, done = stop, covered
                    column += 1
                    sums[row, column] += rest
                    touched[row, column // BLOCK] = True


@inlined
def _cover(
    sums: Whole,
    touched: NDArray[np.bool_],
    alphas: NDArray[np.uint8],
    spans: Whole,
    box: Box,
    opacity: float,
) -> Any:
    """Turn the sums of a box into spans of rows where something is covered; how many there are.

    What is covered, times the opacity, 0 to 255, is written in the spans, or among the alphas
    where it varies. The sums are emptied.
    """
    strength = int64(255 * opacity * FULL + 0.5)
    left, top, right, bottom = box
    count = int64(0)
    for row in range(top, bottom):
        total = int64(0)
        x = left
        while x < right:
            block = x // BLOCK
            stop = (block + 1) * BLOCK
            if touched[row, block]:
                touched[row, block] = False
                stop = min(stop, right)
                for place in range(x, stop):
                    total += sums[row, place]
                    sums[row, place] = 0
                    covered = min(abs(total), FULL)
                    alphas[row, place] = (covered * strength + HALF) >> SHIFT
                alpha = _VARIED
            else:
                while stop < right and not touched[row, stop // BLOCK]:
                    stop += BLOCK
                stop = min(stop, right)
                alpha = (min(abs(total), FULL) * strength + HALF) >> SHIFT
            if alpha:
                spans[count, 0], spans[count, 1], spans[count, 2] = row, x, stop
                spans[count, 3] = alpha
                count += 1
            x = stop
        sums[row, right] = 0
        touched[row, right // BLOCK] = False
    return count


# --- colors ---


@inlined
def _lay(
    canvas: Picture,
    ramp: NDArray[np.uint32],
    is_opaque: bool,
    is_radial: bool,
    place: tuple[Any, ...],
    alphas: NDArray[np.uint8],
    spans: Whole,
    count: int,
    shades: NDArray[np.uint32],
) -> None:
    """Lay the colors of a gradient over spans."""
    a, b, c, d, e, f = place
    last = float32(SHADES - 1)
    for number in range(count):
        row, alpha = uint64(spans[number, 0]), spans[number, 3]
        # Of unsigned numbers there is no doubt that they do not count from the end of a row.
        begin, end = uint64(spans[number, 1]), uint64(spans[number, 2])
        along, across = b * float32(spans[number, 0]) + c, e * float32(spans[number, 0]) + f
        # Loops of one thing each are what compilers do several pixels at a time of.
        if is_radial:
            for x in range(begin, end):
                u, v = a * float32(int32(x)) + along, d * float32(int32(x)) + across
                at = np.sqrt(u * u + v * v)
                shades[x] = int32(at if at < last else last)
        else:
            for x in range(begin, end):
                at = a * float32(int32(x)) + along
                at = (at + abs(at)) * float32(0.5)
                shades[x] = int32(at if at < last else last)
        if alpha == 255 and is_opaque:
            for x in range(begin, end):
                canvas[row, x] = ramp[shades[x]]
            continue
        for x in range(begin, end):
            shades[x] = ramp[shades[x]]
        if alpha != _VARIED:
            for x in range(begin, end):
                alphas[row, x] = alpha
        if is_opaque:
            for x in range(begin, end):
                canvas[row, x] = _mixed(canvas[row, x], shades[x], uint32(alphas[row, x]))
        else:
            for x in range(begin, end):
                share = _share(uint32(alphas[row, x]), shades[x] >> uint32(24))
                canvas[row, x] = _mixed(canvas[row, x], shades[x] | _SOLID, share)


@inlined
def _place(kind: int, vertices: Whole, anchor: int) -> tuple[Any, ...]:
    """Where a gradient lies: from columns x and rows y of pixels to shades.

    They are counted along a line, as a x + b y + c, or outward from 0, 0, where the other
    coordinate is d x + e y + f. All shades of a plain color are at 0.
    """
    x, y = float64(vertices[anchor, 0]), float64(vertices[anchor, 1])
    ux = uy = vx = vy = 0.0
    if kind != SOLID:
        ux, uy = vertices[anchor + 1, 0] - x, vertices[anchor + 1, 1] - y
        vx, vy = -uy, ux
    if kind == RADIAL:
        vx, vy = vertices[anchor + 2, 0] - x, vertices[anchor + 2, 1] - y
    area = ux * vy - uy * vx
    size = SHADES / (area if abs(area) >= 1 else 1.0)
    a, b, d, e = vy * size, -vx * size, -uy * size, ux * size
    # The middle of the first pixel.
    x, y = STEPS / 2 - x, STEPS / 2 - y
    return (
        float32(a * STEPS),
        float32(b * STEPS),
        float32(a * x + b * y),
        float32(d * STEPS),
        float32(e * STEPS),
        float32(d * x + e * y),
    )


@inlined
def _mixed(below: int, above: int, alpha: int) -> Any:
    """A color over another one, rounded, each byte for itself."""
    # Red and blue are far enough apart to be mixed at once, and so are green and alpha.
    rest = uint32(uint32(255) - alpha)
    both = uint32((below & _RED_BLUE) * rest) + uint32((above & _RED_BLUE) * alpha)
    both = uint32(both + _HALVES)
    both = uint32(both + ((both >> _BYTE) & _RED_BLUE))
    others = uint32(((below >> _BYTE) & _RED_BLUE) * rest)
    others = uint32(others + ((above >> _BYTE) & _RED_BLUE) * alpha)
    others = uint32(others + _HALVES)
    others = uint32(others + ((others >> _BYTE) & _RED_BLUE))
    return uint32(((both >> _BYTE) & _RED_BLUE) | (others & _ALPHA_GREEN))


@inlined
def _share(alpha: int, other: int) -> Any:
    """The product of two fractions of 255, rounded."""
    product = uint32(alpha * other + _HALF_BYTE)
    return uint32((product + (product >> _BYTE)) >> _BYTE)


# --- openings ---


@inlined
def _open(
    canvas: Picture,
    below: NDArray[np.uint32],
    masks: NDArray[np.uint8],
    depth: int,
    box: Box,
    alphas: NDArray[np.uint8],
    spans: Whole,
    count: int,
) -> None:
    """Keep what is below an opening, and its spans as a mask."""
    left, top, right, bottom = box
    for row in range(uint64(top), uint64(bottom)):
        for x in range(uint64(left), uint64(right)):
            below[depth, row, x] = canvas[row, x]
            masks[depth, row, x] = 0
    for number in range(count):
        row, alpha = spans[number, 0], spans[number, 3]
        for x in range(spans[number, 1], spans[number, 2]):
            masks[depth, row, x] = alphas[row, x] if alpha == _VARIED else alpha


@inlined
def _close(
    canvas: Picture, below: NDArray[np.uint32], masks: NDArray[np.uint8], depth: int, box: Box
) -> None:
    """Lay the pixels painted since an opening over those below it, through the mask."""
    left, top, right, bottom = box
    for row in range(uint64(top), uint64(bottom)):
        for x in range(uint64(left), uint64(right)):
            share = uint32(masks[depth, row, x])
            canvas[row, x] = _mixed(below[depth, row, x], canvas[row, x], share)
