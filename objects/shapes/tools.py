# SPDX-License-Identifier: Apache-2.0
"""Tools and what they turn."""
import math

from contours import (bar, blended, block, cut, disc, grown, outline, polygon, united)
from geometry import Mesh, circle
from solids import MM, lathe, merged, millimetres, plate, ring


def make_nut():
    """M10: 17 mm across flats, corners chamfered on both sides, a threaded bore."""
    flat, half, drop = 8.5 * MM, 4 * MM, 1.48 * MM
    corner = flat / math.cos(math.pi / 6)
    mesh = Mesh()

    def hexagon(radius, z, phase):
        return ring(radius, z, 6, phase)

    top, bottom = hexagon(flat, half, math.pi / 6), hexagon(flat, -half, math.pi / 6)
    high, low = hexagon(corner, half - drop, 0), hexagon(corner, drop - half, 0)
    bore = 24
    for k in range(6):
        n = (k + 1) % 6
        mesh.polygon([low[k], bottom[k], low[n], high[n], top[k], high[k]], "steel")
        mesh.polygon([top[k - 1], high[k], top[k]], "steel")
        mesh.polygon([bottom[k], low[k], bottom[k - 1]], "steel")
    profile = [(5.4, 4.0), (4.2, 3.0)]
    for i in range(1, 8):
        profile.append((4.2 if i % 2 == 0 else 4.95, 3.0 - 0.75 * i))
    profile += [(4.2, -3.0), (5.4, -4.0)]
    rings = [ring(r * MM, z * MM, bore) for r, z in profile]
    hole = [(p[0], p[1]) for p in rings[0]]
    mesh.planar([p[:2] for p in top], "steel", [([hole], None)], lambda p: (p[0], p[1], half), top)
    below = [(p[0], -p[1]) for p in rings[-1]]
    mesh.planar([(p[0], -p[1]) for p in bottom][::-1], "steel", [([below], None)],
                lambda p: (p[0], -p[1], -half), bottom[::-1])
    for number, (upper, lower) in enumerate(zip(rings, rings[1:])):
        mesh.strip(upper, lower, "steel" if number in (0, len(rings) - 2) else "thread")
    return mesh, {}


def make_bolt():
    """M10 x 50: hexagon head of 17 mm across flats and 6.4 mm, 30 mm of thread with its end
    chamfered; the head's corners are chamfered as a nut's are."""
    sides, head, drop = 24, 6.4, 1.3
    profile = [(0, -50, "steel"), (3.9, -50, "steel"), (5, -48.6, "thread")]
    z = -48.6
    while z < -20.1:
        profile += [(4.2, z + 0.7, "thread"), (5, z + 1.4, "thread")]
        z += 1.4
    profile += [(5, 0, "steel")]
    shank = lathe(profile + [(5, 0.2, "steel"), (0, 0.2, "steel")], sides)
    flat, corner = 8.5, 8.5 / math.cos(math.pi / 6)
    mesh = Mesh()
    low, high = ring(corner * MM, 0, 6), ring(corner * MM, (head - drop) * MM, 6)
    top = ring(flat * MM, head * MM, 6, math.pi / 6)
    mesh.polygon(low[::-1], "steel")
    for k in range(6):
        n = (k + 1) % 6
        mesh.polygon([low[k], low[n], high[n], top[k], high[k]], "steel")
        mesh.polygon([top[k - 1], high[k], top[k]], "steel")
    # A ring on the head, as the maker's mark is framed.
    inner = circle(5.6 * MM, 24), circle(4.9 * MM, 24)
    mesh.planar([p[:2] for p in top], "steel", [(list(inner), "thread")],
                lambda p: (p[0], p[1], head * MM), top)
    return merged(mesh, shank), {"head": (0.0, 0.0, 1.0)}


def forged(shape, box, thick, cell, bevel, material="steel", tolerance=None, inlays=()):
    """A flat forged piece about z = 0 with bevelled edges. shape, box, thick, bevel in mm; inlays:
    shapes of another colour on both faces."""
    loops = outline(shape, box, cell, tolerance)
    small = outline(grown(shape, -bevel), box, cell, tolerance)
    marks = [([millimetres(loop) for loop in outline(mark, box, 0.5, 0.06)], fill)
             for mark, fill in inlays]
    return plate([millimetres(loop) for loop in loops], -thick / 2 * MM, thick / 2 * MM, material,
                 bevel=(millimetres(small[0]), bevel * MM), above=marks, below=marks)


def regular(x, y, radius, sides, phase=0.0):
    return polygon(circle(radius, sides, (x, y), math.radians(phase)))


def make_wrench():
    """A combination spanner of 170 mm: open jaw, ring with twelve points, and a flat shank."""
    jaw = cut(disc(0, 0, 17.5), block(-12, 3.2, 16, 8.4, 0, 15), disc(3.3, -0.9, 8.4))
    ends = united(jaw, disc(140.5, 0, 12))
    shape = blended(7, ends, bar((10, 0), (138, 0), 7.5, 6))
    # What blending fills of the mouth is cut out again.
    shape = cut(shape, block(-12, 3.2, 16, 8.4, 0, 15), disc(3.3, -0.9, 8.4),
                united(regular(140.5, 0, 8.2, 6), regular(140.5, 0, 8.2, 6, 30)))
    field = bar((26, 0), (118, 0), 3.4)
    return forged(shape, (-19, -19, 154, 19), 7, 0.9, 0.9, "chrome", 0.12,
                  [(field, "dark_steel")]), {}


def make_adjustable_wrench():
    """200 mm: fixed jaw, movable jaw on its worm, a handle with a hole to hang it by."""
    # The jaws open to the left, turned against the handle, which leads to the right.
    size = 1.14
    c, s = size * math.cos(math.radians(18)), size * math.sin(math.radians(18))

    def turned(p):
        return (c * p[0] - s * p[1], s * p[0] + c * p[1]) + tuple(p[2:])

    head = [(-27, 16), (-26, 10), (-1, 10), (1, -18), (9, -23), (22, -20), (32, -9), (33, 6),
            (23, 19), (4, 26), (-15, 24)]
    jaw = [(-26, -2), (3, -2), (3, -18), (-7, -19), (-19, -14), (-26, -8)]
    window = [(7.5, -14), (17, -14), (17, 3), (7.5, 3)]
    head, jaw, window = (polygon([turned(p) for p in loop]) for loop in (head, jaw, window))
    handle = blended(8, bar((20, 2), (147, 0), 9, 10.5), disc(155, 0, 12))
    handle = cut(handle, disc(156, 0, 5.2), grown(head, -1.5))
    body = forged(cut(head, window), (-40, -33, 42, 36), 12, 0.9, 1.4, "chrome", 0.14)
    movable = forged(cut(jaw, grown(head, -2)), (-34, -38, 14, 9), 10.6, 0.8, 1.0, "steel", 0.12)
    grip = forged(handle, (8, -14, 169, 16), 6.4, 1.0, 1.2, "chrome", 0.14,
                  [(bar((52, 1), (133, 0), 4.6), "dark_steel")])
    profile = [(0, -8.5, "steel"), (4.0, -8.5, "steel")]
    for i in range(5):
        profile += [(5.9, -8 + 3.2 * i, "steel"), (5.9, -6.6 + 3.2 * i, "steel"),
                    (4.3, -6.0 + 3.2 * i, "steel"), (4.3, -5.2 + 3.2 * i, "steel")]
    profile[-1] = (4.0, 8.5, "steel")
    worm = lathe(profile + [(0, 8.5, "steel")], 16).moved(
        lambda p: turned((p[0] + 12.2 * MM, p[2] - 5.5 * MM, -p[1])))
    return merged(body, movable, grip, worm), {}


def make_key():
    """A key of 57 mm in brass: bow with a hole, shaft with a groove, bits."""
    bow = blended(2, disc(0, 0, 11.5), block(9, 0, 6, 7, 1.5))
    blade = polygon([(12, -4.2), (15, -4.2), (17, -2.6), (20, -4.2), (22, -4.2), (24, -1.2),
                     (26.5, -3.2), (29, -3.2), (31, -0.6), (33, -2.8), (35, -2.8), (37, -1.6),
                     (39, -3.6), (41, -3.6), (45.5, 0.4), (43.5, 4.2), (12, 4.2)])
    shape = cut(united(bow, blade), disc(-4.6, 0, 3.4))
    groove, name = bar((18, 2.0), (40, 2.0), 0.75), bar((4, 0), (7, 0), 4.2)
    return forged(shape, (-12.5, -12.5, 46.5, 12.5), 2.2, 0.5, 0.3, "brass", 0.07,
                  [(groove, "copper"), (name, "copper")]), {}
