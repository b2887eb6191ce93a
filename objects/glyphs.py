# SPDX-License-Identifier: Apache-2.0
"""Outlines of digits and letters, traced from strokes of even width.

A glyph is a set of strokes in a box 0..W by 0..1. Its outline is the curve at half the stroke's
width from the strokes.
"""
import math

from contours import marching_squares, simplified
from geometry import signed_area


def arc(cx, cy, rx, ry, start, end, steps=14):
    """Points on an ellipse, angles in degrees."""
    return [(cx + rx * math.cos(math.radians(start + (end - start) * i / steps)),
             cy + ry * math.sin(math.radians(start + (end - start) * i / steps)))
            for i in range(steps + 1)]


STROKES = {
    "0": [arc(0.3, 0.5, 0.3, 0.5, 0, 360, 28)],
    "1": [[(0.08, 0.78), (0.34, 1.0), (0.34, 0.0)], [(0.1, 0.0), (0.58, 0.0)]],
    "2": [arc(0.3, 0.71, 0.29, 0.29, 170, -38) + [(0.0, 0.0), (0.6, 0.0)]],
    "3": [arc(0.28, 0.745, 0.27, 0.255, 150, -90), arc(0.28, 0.255, 0.31, 0.255, 90, -150)],
    "4": [[(0.44, 0.0), (0.44, 1.0), (0.0, 0.28), (0.62, 0.28)]],
    "5": [[(0.56, 1.0), (0.08, 1.0), (0.04, 0.53)] + arc(0.28, 0.32, 0.31, 0.32, 125, -150)],
    "6": [[(0.5, 1.0)] + arc(0.52, 0.34, 0.5, 0.62, 125, 180, 8),
          arc(0.31, 0.31, 0.295, 0.31, 0, 360, 26)],
    "7": [[(0.0, 1.0), (0.58, 1.0), (0.2, 0.0)]],
    "8": [arc(0.3, 0.755, 0.25, 0.245, 0, 360, 24), arc(0.3, 0.255, 0.3, 0.255, 0, 360, 24)],
    "A": [[(0.0, 0.0), (0.34, 1.0), (0.68, 0.0)], [(0.12, 0.33), (0.56, 0.33)]],
    "B": [[(0.0, 0.0), (0.0, 1.0), (0.28, 1.0)] + arc(0.28, 0.76, 0.26, 0.24, 90, -90) +
          [(0.0, 0.52)], [(0.28, 0.52)] + arc(0.3, 0.26, 0.3, 0.26, 90, -90) + [(0.0, 0.0)]],
    "C": [arc(0.36, 0.5, 0.36, 0.5, 48, 312, 22)],
    "D": [[(0.0, 0.0), (0.0, 1.0), (0.22, 1.0)] + arc(0.22, 0.5, 0.42, 0.5, 90, -90) +
          [(0.0, 0.0)]],
    "E": [[(0.56, 1.0), (0.0, 1.0), (0.0, 0.0), (0.56, 0.0)], [(0.0, 0.52), (0.46, 0.52)]],
    "F": [[(0.56, 1.0), (0.0, 1.0), (0.0, 0.0)], [(0.0, 0.52), (0.46, 0.52)]],
    "I": [[(0.0, 0.0), (0.0, 1.0)]],
    "K": [[(0.0, 0.0), (0.0, 1.0)], [(0.56, 1.0), (0.0, 0.42)], [(0.2, 0.62), (0.6, 0.0)]],
    "L": [[(0.0, 1.0), (0.0, 0.0), (0.5, 0.0)]],
    "M": [[(0.0, 0.0), (0.0, 1.0), (0.38, 0.3), (0.76, 1.0), (0.76, 0.0)]],
    "N": [[(0.0, 0.0), (0.0, 1.0), (0.6, 0.0), (0.6, 1.0)]],
    "O": [arc(0.38, 0.5, 0.38, 0.5, 0, 360, 28)],
    "R": [[(0.0, 0.0), (0.0, 1.0), (0.3, 1.0)] + arc(0.32, 0.74, 0.26, 0.26, 90, -90) +
          [(0.0, 0.48)], [(0.3, 0.48), (0.6, 0.0)]],
    "T": [[(0.0, 1.0), (0.66, 1.0)], [(0.33, 1.0), (0.33, 0.0)]],
    "Y": [[(0.0, 1.0), (0.32, 0.5), (0.64, 1.0)], [(0.32, 0.5), (0.32, 0.0)]],
    "S": [arc(0.29, 0.75, 0.27, 0.25, 40, 270) + arc(0.29, 0.25, 0.29, 0.25, 90, -140)],
}
STROKES["9"] = [[(0.62 - x, 1 - y) for x, y in stroke] for stroke in STROKES["6"]]
SPACING = 0.34  # between the strokes of neighbouring glyphs, in heights


def text_strokes(text, mark=False):
    """Strokes of a row of glyphs, centred on 0, 0; `mark` draws a line below (6 and 9)."""
    strokes, x = [], 0.0
    for letter in text:
        glyph = STROKES[letter]
        left = min(p[0] for s in glyph for p in s)
        right = max(p[0] for s in glyph for p in s)
        strokes += [[(p[0] - left + x, p[1] - 0.5) for p in s] for s in glyph]
        x += right - left + SPACING
    width = x - SPACING
    if mark:
        strokes.append([(0.05 * width, -0.78), (0.95 * width, -0.78)])
    return [[(p[0] - width / 2, p[1]) for p in s] for s in strokes]


def distance(p, strokes):
    best = math.inf
    for stroke in strokes:
        for (ax, ay), (bx, by) in zip(stroke, stroke[1:]):
            dx, dy = bx - ax, by - ay
            squared = dx * dx + dy * dy
            t = 0 if squared == 0 else max(0, min(1, ((p[0] - ax) * dx + (p[1] - ay) * dy) /
                                                  squared))
            x, y = p[0] - ax - t * dx, p[1] - ay - t * dy
            best = min(best, x * x + y * y)
    return math.sqrt(best)


def outlines(strokes, half, cell=0.045):
    """Loops at `half` from the strokes."""
    xs = [p[0] for s in strokes for p in s]
    ys = [p[1] for s in strokes for p in s]
    x0, y0 = min(xs) - half - 1.37 * cell, min(ys) - half - 1.41 * cell
    nx = int((max(xs) + half - x0) / cell) + 3
    ny = int((max(ys) + half - y0) / cell) + 3
    return marching_squares(lambda p: distance(p, strokes) - half, x0, y0, nx, ny, cell)


def text(letters, height, centre=(0.0, 0.0), angle=0.0, weight=0.16, mark=False):
    """Loops of a row of glyphs. height: of the capitals, m; weight: stroke width in heights;
    angle: radians, counter-clockwise."""
    strokes = text_strokes(letters, mark)
    c, s = math.cos(angle) * height, math.sin(angle) * height
    loops = []
    for loop in outlines(strokes, weight / 2):
        loop = simplified(loop, 0.008)
        if abs(signed_area(loop)) > 1e-3:
            loops.append([(centre[0] + c * x - s * y, centre[1] + s * x + c * y)
                          for x, y in loop])
    return loops
