# SPDX-License-Identifier: Apache-2.0
"""Cups, cans, tubs and what else holds something."""
import math

from geometry import Mesh, add, cross, scale, unit
from glyphs import text
from solids import MM, ellipse, lathe, merged, millimetres, plate, tube


def handle(path, half_wide, half_thick, material, count=10):
    """A handle in the plane y = 0, path in mm from its upper end to its lower one."""
    return tube([(x * MM, 0.0, z * MM) for x, z in path],
                ellipse(half_thick * MM, half_wide * MM, count), material)


def make_metal_cup():
    """A steel cup, 80 mm across and 85 mm high, walls of about 1 mm, rolled rim, strap handle."""
    profile = [(0, 0.8, "steel"), (31, 0.8, "steel"), (32.5, 0, "steel"), (36, 0, "steel"),
               (38.5, 3, "chrome"), (38.8, 24, "steel"), (39.1, 25, "steel"), (39.1, 28, "steel"),
               (38.8, 29, "chrome"), (39, 80, "chrome"), (40, 82.2, "chrome"),
               (39.8, 84.6, "chrome"), (38.6, 85, "steel"), (37.6, 82, "steel"),
               (37.6, 4.5, "steel"), (35.6, 2.2, "steel"), (0, 2.2, "steel")]
    body = lathe(profile, 32)
    path = [(37.9, 71), (44, 71.5), (52, 70.5), (59, 67), (63, 60), (64, 50), (62, 40), (57, 31),
            (50, 24.5), (44, 21.5), (37.9, 20.5)]
    return merged(body, handle(path, 7, 1.7, "steel")), {"mouth": (0.0, 0.0, 1.0)}


def make_mug():
    """A stoneware mug with a belly: 96 mm across, 88 mm high, walls of about 5 mm."""
    profile = [(0, 2, "bare_clay"), (26, 2, "bare_clay"), (28, 0, "bare_clay"),
               (32, 0, "bare_clay"), (34, 3, "mug_glaze"), (43, 14, "mug_glaze"),
               (47.5, 28, "mug_glaze"), (48, 40, "mug_band"), (46.5, 53, "mug_glaze"),
               (43.5, 70, "mug_glaze"), (43.2, 86, "mug_glaze"), (42, 88, "mug_inside"),
               (40, 88, "mug_inside"), (38.8, 85, "mug_inside"), (38.6, 70, "mug_inside"),
               (41.8, 52, "mug_inside"), (43, 40, "mug_inside"), (42.2, 28, "mug_inside"),
               (37.5, 15, "mug_inside"), (28, 7, "mug_inside"), (0, 6.5, "mug_inside")]
    body = lathe(profile, 32)
    path = [(41.5, 76), (49, 77.5), (57, 77), (64, 73), (68.5, 66), (70, 57), (68.5, 47.5),
            (63.5, 39.5), (56, 34.5), (46, 32)]
    return merged(body, handle(path, 6.4, 4.6, "mug_glaze", 12)), {"mouth": (0.0, 0.0, 1.0)}


def make_beer_can():
    """A can of 66 mm, trodden from above to 70 mm: lid and bottom keep their shape, the wall folds
    in three creases, and the lid sits askew."""
    wall = [(33, 4), (33, 12), (30, 16), (32.6, 20), (32.4, 26), (27, 30), (24.5, 33), (28.5, 36),
            (32.6, 40), (32, 45), (26.5, 49), (25.5, 52), (30.5, 55), (32, 58)]
    profile = [(0, 6, "aluminium"), (19, 2.5, "aluminium"), (22.5, 0.2, "aluminium"),
               (25, 0, "aluminium"), (27.5, 1.2, "aluminium")]
    first = len(profile)
    profile += [(r, z, "can_red") for r, z in wall]
    last = len(profile) - 1
    profile += [(29, 63, "aluminium"), (28.6, 66, "aluminium"), (27.4, 67, "aluminium"),
                (26, 66.6, "aluminium"), (25.2, 62.6, "aluminium"), (0, 62.6, "aluminium")]
    columns = 36

    def colours(k, i):
        if not first <= k <= last:
            return "aluminium"
        across = (i + 5 + 0.6 * (k - first)) % 18
        return "can_white" if across < 5 else "can_red"

    can = lathe(profile, columns, colours=colours)
    mouth = plate([ring_of(0, 12, 8.5, 6.5, 20)], 62.5 * MM, 62.9 * MM, "hole")
    tab = plate([ring_of(0, -3, 6.2, 10.5, 20), ring_of(0, -7.5, 3.4, 3.6, 12)], 63.6 * MM,
                64.8 * MM, "silver")
    rivet = plate([ring_of(0, 1.5, 2.4, 2.4, 10)], 62.5 * MM, 65.1 * MM, "aluminium")

    def crush(p):
        x, y, z = (c / MM for c in p)
        angle, radius = math.atan2(y, x), math.hypot(x, y)
        # How much of the fold there is at this height, and where it lies.
        folded = math.sin(math.pi * max(0, min(1, (z - 6) / 54))) ** 2
        twist = 0.055 * (z - 6)
        dent = 1 + folded * (0.075 * math.cos(3 * angle + twist) +
                             0.05 * math.cos(5 * angle - 1.7 * twist + 1) +
                             0.03 * math.cos(9 * angle + 2 * twist))
        dent = min(dent, 33 / max(radius, 1)) if radius > 20 else dent
        askew = max(0, min(1, (z - 8) / 50))
        wave = folded * 3.2 * math.cos(4 * angle + 0.4 * z) * min(1, radius / 25)
        u, v, w = x * dent + 2.5 * askew, y * dent - 1.2 * askew, z + wave
        return (u * MM, v * MM, (w + askew * (0.095 * x - 0.05 * y)) * MM)

    return merged(can, mouth, tab, rivet).moved(crush), {"lid": unit((-0.095, 0.05, 1.0))}


def ring_of(x, y, a, b, count):
    return [((x + a * math.cos(2 * math.pi * i / count)) * MM,
             (y + b * math.sin(2 * math.pi * i / count)) * MM) for i in range(count)]


def make_carton():
    """A milk carton, 95 x 95 mm and 200 mm high with its gable; a screw cap on one slope."""
    a, low, wall, ridge, top, thin = 47.5, 46, 138, 179, 200, 1.2
    mesh = Mesh()

    def side(turn, z0, z1, material, inlays=()):
        corners = [(-a, -a, z0), (a, -a, z0), (a, -a, z1), (-a, -a, z1)]
        for _ in range(turn):
            corners = [(-y, x, z) for x, y, z in corners]
        mesh.face([scale(p, MM) for p in corners], material, inlays, (0.0, 0.0, 1.0))

    for turn in range(4):
        side(turn, 0, low, "milk_green")
        word = [(text("MILK", 24 * MM, (0, 14 * MM), weight=0.22), "milk_blue")] \
            if turn % 2 == 0 else [([drop(0, 0, 21)], "milk_blue")]
        side(turn, low, wall, "milk_white", word)
    points = {name: scale(p, MM) for name, p in {
        "A": (-a, -a, wall), "B": (a, -a, wall), "C": (a, a, wall), "D": (-a, a, wall),
        "P": (a - 30, 0, ridge - 12), "Q": (-a + 30, 0, ridge - 12),
        "R": (a, -thin, ridge), "S": (a, thin, ridge), "T": (-a, thin, ridge),
        "U": (-a, -thin, ridge), "r": (a, -thin, top), "s": (a, thin, top),
        "t": (-a, thin, top), "u": (-a, -thin, top)}.items()}

    def faces(material, *names):
        for name in names:
            mesh.polygon([points[letter] for letter in name], material)

    faces("milk_blue", "ABRU", "CDTS")
    faces("milk_white", "BCP", "BPR", "CSP", "DAQ", "DQT", "AUQ", "PSR", "QUT")
    faces("milk_white", "URru", "STts", "RSsr", "TUut", "rstu")
    mesh.polygon([scale(p, MM) for p in ((-a, -a, 0), (-a, a, 0), (a, a, 0), (a, -a, 0))],
                 "milk_white")
    slope = unit((0, -(ridge - wall), a - thin))
    middle = scale((0, -a * 0.56, wall + (ridge - wall) * 0.44), MM)
    along = (1.0, 0.0, 0.0)
    across = cross(slope, along)
    cap = lathe([(0, -1, "cap_red"), (13, -1, "cap_red"), (13, 8, "cap_red"),
                 (11.5, 9.5, "cap_red"),
                 (0, 9.5, "cap_red")], 20).moved(
        lambda p: add(middle, add(scale(along, p[0]), add(scale(across, p[1]),
                                                          scale(slope, p[2])))))
    return merged(mesh, cap), {"top": (0.0, 0.0, 1.0)}


def drop(x, y, size):
    """A drop of milk, mm."""
    points = []
    for i in range(28):
        t = 2 * math.pi * i / 28
        points.append((x + size * 0.62 * math.sin(t) * math.sin(t / 2) ** 1.2,
                       y + size * math.cos(t)))
    return millimetres(points)
