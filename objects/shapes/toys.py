# SPDX-License-Identifier: Apache-2.0
"""Toys: bricks, blocks, balls."""
import math

from geometry import Mesh, add, circle, cross, mean, scale, sub, unit
from glyphs import text
from solids import MM, ball, loft


def make_brick(columns, rows, material="brick_red"):
    """A toy brick: studs above, hollow below, tubes between the studs."""
    pitch, play, tall, stud = 8.0, 0.1, 9.6, 1.8
    wall, roof, segments = 1.3, 1.0, 16
    x, y = columns * pitch / 2 - play, rows * pitch / 2 - play
    mesh = Mesh()

    def rectangle(a, b):
        return [(-a * MM, -b * MM), (a * MM, -b * MM), (a * MM, b * MM), (-a * MM, b * MM)]

    def at(z, flip=False):
        return lambda p: (p[0], -p[1] if flip else p[1], z * MM)

    def lift(loop, z):
        return [at(z)(p) for p in loop]

    def flipped(loop):
        return [(p[0], -p[1]) for p in loop]

    outer, inner = rectangle(x, y), rectangle(x - wall, y - wall)
    studs = [circle(2.4 * MM, segments, ((i - (columns - 1) / 2) * pitch * MM,
                                         (j - (rows - 1) / 2) * pitch * MM), math.pi / segments)
             for i in range(columns) for j in range(rows)]
    centres = [((i - columns / 2) * pitch * MM, (j - rows / 2) * pitch * MM)
               for i in range(1, columns) for j in range(1, rows)]
    tubes = [circle(3.255 * MM, segments, c) for c in centres]
    bores = [circle(2.4 * MM, segments, c) for c in centres]
    mesh.strip(lift(outer, 0), lift(outer, tall), material)
    mesh.planar(outer, material, [([s], None) for s in studs], at(tall))
    for loop in studs:
        mesh.strip(lift(loop, tall), lift(loop, tall + stud), material)
        mesh.polygon(lift(loop, tall + stud), material)
    mesh.planar(flipped(outer)[::-1], material, [([flipped(inner)], None)], at(0, True))
    mesh.strip(lift(inner, tall - roof), lift(inner, 0), material)
    mesh.planar(flipped(inner)[::-1], material, [([flipped(t)], None) for t in tubes],
                at(tall - roof, True))
    for tube, bore in zip(tubes, bores):
        mesh.strip(lift(tube, 0), lift(tube, tall - roof), material)
        mesh.planar(flipped(tube)[::-1], material, [([flipped(bore)], None)], at(0, True))
        mesh.strip(lift(bore, tall - roof), lift(bore, 0), material)
        mesh.polygon(lift(bore, tall - roof)[::-1], material)
    return mesh, {"studs": (0.0, 0.0, 1.0)}


def on_ball(frequency, radius, borders, material):
    """A ball whose triangles take the material of their middle. borders: functions of a direction,
    0 where the material changes, about as steep as an angle; corners near a border go there."""
    points, triangles = ball(frequency)
    reach = 0.55 / frequency
    for border in borders:
        for i, p in enumerate(points):
            value = border(p)
            if abs(value) < reach:
                slope = [(border(unit(add(p, tuple(1e-5 * (k == axis) for k in range(3))))) -
                          value) / 1e-5 for axis in range(3)]
                steep = sum(s * s for s in slope)
                points[i] = unit(sub(p, scale(slope, value / steep)))
    mesh = Mesh()
    for a, b, c in triangles:
        corners = [points[i] for i in (a, b, c)]
        mesh.triangle(*(scale(p, radius) for p in corners), material(unit(mean(corners))))
    return mesh, {}


def make_marble():
    """16 mm of glass with twisted vanes inside, of which the stripes on the surface tell."""
    columns, rows, radius = 24, 14, 8 * MM
    rings = []
    for k in range(rows + 1):
        polar = math.pi * (1 - k / rows)
        z = radius * math.cos(polar)
        rings.append([(x, y, z) for x, y in circle(
            0.0 if k in (0, rows) else radius * math.sin(polar), columns, phase=-0.9 * z / radius)])

    def colours(k, i):
        return {0: "glass_swirl", 1: "glass_swirl", 2: "glass_white"}.get(i % 8, "glass")

    return loft(rings, colours, (False, False)), {}


def make_ping_pong_ball():
    """40 mm of celluloid, 0.4 mm thick, with a print on both sides."""
    def reach(p):
        return math.acos(min(1, abs(p[2])))

    def material(p):
        return "ball_print" if reach(p) < 0.22 or 0.42 < reach(p) < 0.62 else "ball"
    borders = [lambda p, limit=limit: reach(p) - limit for limit in (0.22, 0.42, 0.62)]
    return on_ball(6, 20 * MM, borders, material)


def make_wooden_block():
    """An alphabet block of 40 mm: a letter in a coloured frame on each side."""
    half, letters = 20 * MM, "ABCDEF"
    colours = ["red", "blue", "green", "orange", "purple", "teal"]
    normals = [(0, 0, 1), (1, 0, 0), (0, 1, 0), (0, -1, 0), (-1, 0, 0), (0, 0, -1)]
    ups = [(0, 1, 0), (0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 0, 1), (0, 1, 0)]
    mesh, directions = Mesh(), {}
    for letter, colour, normal, up in zip(letters, colours, normals, ups):
        side = cross(up, normal)
        corners = [scale(add(normal, add(scale(side, a), scale(up, b))), half)
                   for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        frames = [[(x * MM, y * MM) for x, y in ((-a, -a), (a, -a), (a, a), (-a, a))]
                  for a in (17, 14.5)]
        loops = text(letter, 19 * MM, weight=0.2)
        mesh.face(corners, "wood_pale", [(frames, colour), (loops, colour)], up)
        directions[letter] = tuple(float(c) for c in normal)
    return mesh, directions
