# SPDX-License-Identifier: Apache-2.0
"""What else is in a kitchen: basket, tub, spoon, garlic, crown cap."""
import math

from solids import MM, cells, lathe, loft, merged


def make_fruit_basket():
    """A woven basket, 280 mm across and 110 mm high: stakes and rows that pass them in turn before
    and behind, a rim and a foot of thicker canes."""
    stakes, rows = 30, 11
    columns = 2 * stakes

    def grid(offset):
        result = []
        for k in range(rows + 1):
            t = k / rows
            radius = 80 + 54 * math.sin(t * math.pi / 2) ** 0.9 + offset
            height = 4 + 98 * t ** 1.25
            ring = []
            for i in range(columns):
                over = 0 if k in (0, rows) or i % 2 else (1 if (i // 2 + k) % 2 else -1)
                angle = 2 * math.pi * i / columns
                r = radius + 2.6 * over
                ring.append((r * MM * math.cos(angle), r * MM * math.sin(angle), height * MM))
            result.append(ring)
        return result

    def material(k, i):
        stake = (i + 1) // 2
        return ("wicker", "wicker_pale")[k % 2] if (stake + k) % 2 else "wicker_dark"

    wall = cells(grid(1.6), grid(-1.6), material)
    mesh = merged(wall, hoop(134.5, 104, 5.5, 7, "wicker_pale", 36),
                  hoop(80, 4, 4.6, 4.6, "wicker", 30))
    floor = [(0, 4, "wicker_dark"), (80, 4, "wicker_dark")]
    circles = [(70, 7.4), (60, 6.6), (50, 7.4), (40, 6.6), (30, 7.4), (20, 6.6), (10, 7.4), (0, 7)]
    floor += [(80, 7, "wicker")] + [
        (r, z, "wicker" if n % 2 else "wicker_dark") for n, (r, z) in enumerate(circles)]
    return merged(mesh, lathe(floor, 36)), {"mouth": (0.0, 0.0, 1.0)}


def hoop(radius, height, half_wide, half_high, material, count):
    """A ring of elliptical section about z, mm."""
    profile = [(radius + half_wide * math.cos(math.pi * k / 3),
                height + half_high * math.sin(math.pi * k / 3), material) for k in range(6)]
    return lathe(profile, count, closed=True)


def make_plastic_container():
    """A tub of 110 x 110 x 60 mm, open, with a rim to hold it by, walls of about 1.5 mm."""
    # Half the side, height, radius of the corners, material from here on.
    profile = [(41, 0, 9, "tub"), (44, 2, 11, "tub"), (50, 56, 14, "tub_rim"),
               (54.4, 56.4, 17, "tub_rim"), (55, 57.2, 17, "tub_rim"), (55, 59.2, 17, "tub_rim"),
               (54, 60, 16.4, "tub_rim"), (49.4, 60, 13.5, "tub"), (48.6, 58, 13, "tub"),
               (42.8, 4, 10, "tub"), (40, 2, 8, "tub")]
    rings = [rounded_square(half, corner, z) for half, z, corner, _ in profile]
    return loft(rings, [material for *_, material in profile[:-1]]), {"mouth": (0.0, 0.0, 1.0)}


def rounded_square(half, corner, z, steps=4):
    points = []
    for quarter in range(4):
        cx, cy = ((1, 1), (-1, 1), (-1, -1), (1, -1))[quarter]
        for k in range(steps + 1):
            angle = math.pi / 2 * (quarter + k / steps)
            points.append((((half - corner) * cx + corner * math.cos(angle)) * MM,
                           ((half - corner) * cy + corner * math.sin(angle)) * MM, z * MM))
    return points


def make_plastic_spoon():
    """A throw-away spoon of 150 mm: a bowl 32 mm wide, a handle stiffened by a groove, 1.4 mm
    thick."""
    stations = [-75, -74, -71, -66, -58, -46, -32, -18, -4, 8, 18, 25, 30, 35, 41, 48, 55, 61, 66,
                70, 73, 74.5, 75]
    across = [-1, -0.86, -0.6, -0.3, 0, 0.3, 0.6, 0.86, 1]

    def half_width(y):
        bowl = 16 * math.sqrt(max(0, 1 - ((y - 49) / 26.05) ** 2)) if y > 23 else 0
        stem = 6.6 - 3.0 * min(1, max(0, (y + 66) / 80)) if y > -66 else \
            6.6 * math.sqrt(max(0.02, 1 - ((y + 66) / 9.2) ** 2))
        return max(bowl, stem if y < 30 else 0.4)

    def height(y, u):
        depth = 7.5 * math.sqrt(max(0, 1 - ((y - 49) / 26.05) ** 2)) ** 1.3 if y > 22 else 0
        rise = 3.5 * math.sin(math.pi * min(1, max(0, (y + 75) / 98)))
        groove = 1.3 * min(1, max(0, (y + 74) / 8)) * min(1, max(0, (26 - y) / 8))
        return 8 + rise - depth * (1 - u * u) - groove * (1 - u * u)

    def grid(lift):
        return [[(u * half_width(y) * MM, y * MM, (height(y, u) + lift) * MM) for u in across]
                for y in stations]

    return cells(grid(1.4), grid(0), lambda k, i: "spoon", around=False), {"bowl": (0.0, 0.0, 1.0)}


def make_garlic():
    """A bulb of nine cloves, 55 mm across and 50 mm high with its neck; the root's plate below."""
    cloves, each = 9, 4
    profile = [(0, 1.2, 0), (7, 0, 0.1), (9.5, 1.6, 0.2), (17, 3.5, 0.6), (23.5, 9, 0.95),
               (26.6, 16, 1), (26, 22, 1), (22.5, 28, 0.95), (16.5, 33, 0.8), (10, 37, 0.55),
               (6, 40.5, 0.4), (4.2, 45, 0.35), (4.6, 49.5, 0.3), (2.8, 50, 0), (0, 48.5, 0)]
    bulge = {r: share for r, _, share in profile}

    def shape(r, z, angle):
        lobe = abs(math.sin(cloves / 2 * angle)) ** 0.75
        # The cloves are not of one size.
        size = 1 + 0.05 * math.cos(angle + 0.6) + 0.035 * math.cos(3 * angle)
        return r * (1 + bulge[r] * (0.2 * lobe - 0.165)) * (1 + bulge[r] * (size - 1)), z

    def colours(k, i):
        if k < 2:
            return "root"
        if k >= len(profile) - 3:
            return "garlic_skin"
        clove, place = divmod(i, each)
        if place in (0, each - 1):
            return "garlic_skin"
        return "garlic_purple" if (3 * place + clove) % 5 == 0 and 3 < k < 10 else "garlic"

    mesh = lathe([(r, z, "garlic") for r, z, _ in profile], cloves * each, shape, colours=colours)
    return mesh, {"neck": (0.0, 0.0, 1.0)}


def make_bottle_cap():
    """A crown cap: 32 mm across its 21 flutes, 6 mm high, painted above, with a liner below."""
    flutes, each = 21, 4
    outside = [(0, 6), (6.2, 6), (8.6, 6), (12, 5.85), (13.2, 5.1), (13.9, 3.6), (14.9, 1.4),
               (15.75, 0)]
    inside = [(15.3, 0), (14.5, 1.5), (13.5, 3.6), (12.8, 4.9), (11.6, 5.4), (10, 5.4), (0, 5.3)]
    paint = ["cap_paint", "gold", "cap_paint", "cap_paint", "cap_paint", "cap_paint", "cap_paint"]
    metal = ["silver"] * 4 + ["cap_liner"] * 2

    def shape(r, z, angle):
        # The flutes begin at the shoulder and are deepest at the edge.
        depth = max(0, min(1, (4.9 - z) / 4.9)) if r > 12.8 else 0
        return r - 0.95 * depth * (1 - math.cos(flutes * angle)) / 2, z

    profile = [(r, z, m) for (r, z), m in zip(inside[::-1], metal[::-1] + ["silver"])]
    profile += [(r, z, m) for (r, z), m in zip(outside[::-1], paint[::-1] + ["cap_paint"])]
    # From below upwards the body lies on the left when the inside comes first, turned over.
    return lathe(profile, flutes * each, shape), {"top": (0.0, 0.0, 1.0)}
