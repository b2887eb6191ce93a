# SPDX-License-Identifier: Apache-2.0
"""Keyboard, tape dispenser, coat hanger, dustpan."""
import math

from contours import bar, blended, block, cut, disc, grown, outline, polygon
from geometry import Mesh
from solids import MM, cuboid, ellipse, lathe, loft, merged, millimetres, plate, tube

# Rows of a keyboard from the front: widths of the keys in units of 19 mm; negative: a gap.
LETTERS = [[1.25, 1.25, 1.25, 6.25, 1.25, 1.25, 1.25, 1.25, -0.5, 1, 1, 1, -0.5, 2, 1],
           [2.25] + [1] * 10 + [2.75, -1.5, 1, -1.5, 1, 1, 1],
           [1.75] + [1] * 11 + [2.25, -4, 1, 1, 1],
           [1.5] + [1] * 12 + [1.5, -0.5, 1, 1, 1, -0.5, 1, 1, 1],
           [1] * 13 + [2, -0.5, 1, 1, 1, -0.5, 1, 1, 1],
           [1, -1, 1, 1, 1, 1, -0.5, 1, 1, 1, 1, -0.5, 1, 1, 1, 1, -0.5, 1, 1, 1]]


def make_keyboard():
    """450 x 150 mm, 25 mm high behind: six rows of keys on a case that rises to the back."""
    loops = outline(block(0, 0, 225, 75, 8), (-226, -76, 226, 76), 2.5, 0.25)
    small = outline(block(0, 0, 223.5, 73.5, 7), (-226, -76, 226, 76), 2.5, 0.25)

    def raised(p):
        # The case is 12 mm high in front and 17 behind.
        x, y, z = p
        return (x, y, z * (1 + (y / MM + 75) / 150 * 5 / 12) if z > 0 else z)

    case = plate([millimetres(loops[0])], 0.0, 12 * MM, "board", bevel=(millimetres(small[0]),
                                                                       1.2 * MM)).moved(raised)
    parts, unit_ = [case], 19.0
    for row, keys in enumerate(LETTERS):
        x, y = -21.75 / 2 * unit_, -62 + row * unit_ + (5 if row == 5 else 0)
        for number, width in enumerate(keys):
            if width > 0:
                dark = width > 1 and width < 5 or row == 5 and number > 0 or \
                    (row == 0 and number != 3)
                parts.append(key_cap(x + 0.8, y + 0.8, x + width * unit_ - 0.8, y + unit_ - 0.8,
                                     12 + (y + 75) / 30 - 0.2, "key_dark" if dark else "key"))
            x += abs(width) * unit_
    for number in range(3):
        parts.append(cuboid(((150 + 14 * number) * MM, 66 * MM, 16 * MM),
                            ((156 + 14 * number) * MM, 69 * MM, 16.9 * MM), "board", "led"))
    for x in (-190, 170):
        parts.append(cuboid((x * MM, 58 * MM, -1.5 * MM), ((x + 20) * MM, 66 * MM, 0.05 * MM),
                            "lip"))
    return merged(*parts), {"keys": (0.0, 0.0, 1.0)}


def key_cap(x0, y0, x1, y1, base, material):
    """A cap of 8 mm with sloping sides, its top tilted as the case is."""
    mesh = Mesh()
    tilt = (y1 - y0) / 30
    low = [(x0, y0, base), (x1, y0, base), (x1, y1, base + tilt), (x0, y1, base + tilt)]
    high = [(x0 + 2, y0 + 1.6, base + 8), (x1 - 2, y0 + 1.6, base + 8),
            (x1 - 2, y1 - 2.6, base + 8 + tilt), (x0 + 2, y1 - 2.6, base + 8 + tilt)]
    low, high = millimetres(low), millimetres(high)
    mesh.polygon(low[::-1], material)
    mesh.strip(low, high, material)
    mesh.polygon(high, material)
    return mesh


def make_tape_dispenser():
    """130 x 60 x 65 mm: a heavy base, cheeks that hold the roll, an arm with the cutting edge."""
    body = blended(6, block(0, 7.5, 65, 7.5, 4), block(46, 16, 9, 14, 4, -14),
                   block(-57, 16, 8, 12, 5))
    body = cut(body, disc(-12, 36, 27))
    cheek = blended(5, polygon([(-52, 4), (24, 4), (6, 44), (-32, 44)]), disc(-12, 38, 15))
    box = (-67, -1, 67, 68)

    def across(shape, y0, y1, material, bevel=0.0):
        """The shape stands in the plane of x and z and is as wide as from y0 to y1."""
        loops = outline(shape, box, 1.2, 0.12)
        small = outline(grown(shape, -bevel), box, 1.2, 0.12) if bevel else None
        return plate([millimetres(loop) for loop in loops], -y1 * MM, -y0 * MM, material,
                     bevel=(millimetres(small[0]), bevel * MM) if bevel else None).moved(
            lambda p: (p[0], -p[2], p[1]))

    parts = [across(body, -30, 30, "dispenser", 2.0),
             across(cheek, -24, -14, "dispenser", 1.5), across(cheek, 14, 24, "dispenser", 1.5)]
    # The roll, and the hub that it turns on, lie across.
    roll = [(13, -9.5, "tape_side"), (15.5, -9.5, "tape_side"), (26.5, -9.5, "tape"),
            (26.5, 9.5, "tape_side"), (15.5, 9.5, "tape_core"), (13, 9.5, "tape_core")]
    hub = [(0, -14.2, "dispenser_base"), (12.6, -14.2, "dispenser_base"),
           (12.6, 14.2, "dispenser_base"), (0, 14.2, "dispenser_base")]
    for profile, closed, count in ((roll, True, 40), (hub, False, 24)):
        parts.append(lathe(profile, count, closed=closed).moved(
            lambda p: (p[0] - 12 * MM, -p[2], p[1] + 38.4 * MM)))
    # The tape runs from the top of the roll to the edge.
    start, end = (-4, 63.6), (55.5, 31.6)
    strip = bar(start, end, 0.35)
    loops = outline(strip, (-6, 29, 58, 66), 0.3, 0.05)
    parts.append(plate([millimetres(loops[0])], -9.5 * MM, 9.5 * MM, "tape").moved(
        lambda p: (p[0], -p[2], p[1])))
    teeth = [(-13, 0)] + [(-13 + 26 * k / 18, 4.6 if k % 2 else 2.2) for k in range(19)] + [(13, 0)]
    blade = plate([millimetres(teeth)], -0.6 * MM, 0.6 * MM, "chrome").moved(
        lambda p: (53.5 * MM + 0.9 * p[1] + 0.45 * p[2], -p[0],
                   29.8 * MM + 0.45 * p[1] - 0.9 * p[2]))
    return merged(*parts, blade), {"roll": (0.0, 0.0, 1.0)}


def make_coat_hanger():
    """420 x 220 mm, 6 mm thick: shoulders, bar and two notches in plastic, a hook of wire."""
    def shoulder(side):
        return blended(4, bar((0, 0), (side * 60, -14), 7, 6.2),
                       bar((side * 60, -14), (side * 205, -84), 6.2, 5))
    lower = blended(6, bar((-199, -88), (199, -88), 4.2), shoulder(1), shoulder(-1),
                    disc(0, 4, 9))
    shape = cut(lower, disc(128, -38, 5.2), disc(-128, -38, 5.2))
    box = (-214, -98, 214, 16)
    loops = outline(shape, box, 1.6, 0.16)
    small = outline(grown(shape, -1.5), box, 1.6, 0.16)
    body = plate([millimetres(loop) for loop in loops], -3 * MM, 3 * MM, "hanger",
                 bevel=(millimetres(small[0]), 1.5 * MM))
    path = [(0, 8, 0), (0, 30, 0), (0, 48, 0), (3, 58, 0), (12, 66, 0)]
    for k in range(15):
        angle = math.radians(-55 + 17.5 * k)
        path.append((25.5 * math.cos(angle), 86 + 25.5 * math.sin(angle) + 12, 0))
    path = millimetres(path)
    hook = tube(path, ellipse(2 * MM, 2 * MM, 8), "chrome", normal=(0.0, 0.0, 1.0))
    return merged(body, hook), {"hook": (0.0, 1.0, 0.0)}


def make_dustpan():
    """312 x 230 x 76 mm with its handle: a tray with sides that rise to the back, a rubber lip in
    front, a handle with a hole to hang it by."""
    wall = 2.2
    # From the front: x, half the width, height of the sides, height of the floor below.
    stations = [(0, 115, 4, 0), (8, 115, 6, 0), (30, 115, 17, 0), (70, 114, 33, 0),
                (115, 112, 45, 0), (155, 109, 53, 0), (178, 104, 57, 2)]
    rings, materials = [], []
    for number, (x, half, high, low) in enumerate(stations):
        thin = 1.0 if number == 0 else wall
        rings.append(section(x, half, high, low, low + thin, wall))
        materials.append("lip" if number == 0 else "dustpan")
    # The back wall fills the section and is closed behind.
    x, half, high, low = stations[-1]
    rings.append(section(x, half, high, low, high, wall))
    rings.append(section(x + 4, half - 2, high, low + 4, high, wall))
    tray = Mesh()
    front = [(p[1], p[2]) for p in rings[0]]
    tray.planar([(-y, z) for y, z in front][::-1], "lip", [], lambda p: (0.0, -p[0], p[1]))
    body = loft(rings, materials + ["dustpan"], (False, False))
    tray.add(body)
    back = rings[-1]
    outer = [(p[1], p[2]) for p in back]
    tray.planar(outer, "dustpan", [], lambda p: (back[0][0], p[0], p[1]))
    grip = blended(10, bar((0, 0), (112, 0), 15, 17), block(0, 0, 10, 30, 6))
    grip = cut(grip, bar((100, 0), (112, 0), 6))
    box = (-12, -32, 132, 32)
    loops = outline(grip, box, 1.6, 0.16)
    small = outline(grown(grip, -3), box, 1.6, 0.16)
    handle = plate([millimetres(loop) for loop in loops], -6 * MM, 6 * MM, "dustpan",
                   bevel=(millimetres(small[0]), 3 * MM))
    c, s = math.cos(math.radians(11)), math.sin(math.radians(11))
    handle = handle.moved(lambda p: (185 * MM + c * p[0] - s * p[2], p[1],
                                     46 * MM + s * p[0] + c * p[2]))
    ribs = [cuboid((24 * MM, (y - 1) * MM, 1.8 * MM), (172 * MM, (y + 1) * MM, 3.4 * MM), "dustpan")
            for y in range(-80, 81, 20)]
    return weld(tray, handle, ribs), {"mouth": (-1.0, 0.0, 0.0), "up": (0.0, 0.0, 1.0)}


def section(x, half, high, low, floor, wall):
    """The tray's U, counter-clockwise seen from behind."""
    points = [(-half + 4, low), (half - 4, low), (half, low + 4 if high > 8 else low + 1),
              (half, high), (half - wall, high), (half - wall, max(floor, low) + 0.01),
              (-half + wall, max(floor, low) + 0.01), (-half + wall, high), (-half, high),
              (-half, low + 4 if high > 8 else low + 1)]
    if floor >= high:
        points[5] = (half - wall - 1, high)
        points[6] = (-half + wall + 1, high)
    return [(x * MM, y * MM, z * MM) for y, z in points]


def weld(tray, handle, ribs):
    """The tray's caps and sides meet at the same points."""
    closed = Mesh()
    for material, triangles in tray.groups.items():
        for triangle in triangles:
            closed.triangle(*(tray.vertices[i] for i in triangle), material)
    return merged(closed, handle, *ribs)
