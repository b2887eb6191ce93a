#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the meshes of the library of objects and the fields of the object files that follow from
them (mesh, units, kind, mass, faces). Surfaces, which are calibrated by `ifa`, and whatever else
stands in an object file already are kept.

Usage: make_objects.py [FOLDER] [NAME...]   (default: the folder of this script, all objects)
"""
import itertools
import json
import math
import os
import sys

sys.dont_write_bytecode = True  # the folder is installed as it stands

from geometry import (Mesh, add, circle, cross, dot, face_frame, mean, scale, sub, unit)
from glyphs import text

MM = 0.001

# Name: colour as seen on a screen (sRGB), Phong exponent, metallic.
MATERIALS = {
    "ivory": ((0.93, 0.90, 0.82), 90, 0), "black": ((0.06, 0.06, 0.07), 60, 0),
    "red": ((0.72, 0.06, 0.07), 90, 0), "white": ((0.95, 0.95, 0.93), 60, 0),
    "green": ((0.05, 0.42, 0.20), 90, 0), "blue": ((0.07, 0.22, 0.58), 90, 0),
    "purple": ((0.34, 0.12, 0.50), 90, 0), "orange": ((0.88, 0.38, 0.05), 90, 0),
    "teal": ((0.02, 0.42, 0.47), 90, 0), "gold": ((0.96, 0.80, 0.36), 60, 0),
    "rubber": ((0.93, 0.93, 0.90), 8, 0), "sleeve_blue": ((0.08, 0.25, 0.62), 15, 0),
    "sleeve_stripe": ((0.10, 0.10, 0.12), 15, 0), "sleeve_white": ((0.97, 0.97, 0.97), 15, 0),
    "glaze": ((0.10, 0.32, 0.50), 200, 0), "glaze_inside": ((0.93, 0.91, 0.86), 200, 0),
    "bare_clay": ((0.72, 0.58, 0.45), 6, 0), "steel": ((0.62, 0.63, 0.65), 120, 1),
    "thread": ((0.46, 0.47, 0.49), 80, 1), "brick_red": ((0.78, 0.06, 0.05), 110, 0),
}


# --- Dice --------------------------------------------------------------------------------------


def convex_faces(points):
    """Faces of a small convex polyhedron, each its corners counter-clockwise seen from outside."""
    size = max(math.sqrt(dot(p, p)) for p in points)
    faces = {}
    for i, j, k in itertools.combinations(range(len(points)), 3):
        normal = cross(sub(points[j], points[i]), sub(points[k], points[i]))
        if dot(normal, normal) < 1e-12 * size**4:
            continue
        normal = unit(normal)
        offset = dot(normal, points[i])
        if offset < 0:
            normal, offset = scale(normal, -1), -offset
        if all(dot(normal, p) < offset + 1e-9 * size for p in points):
            members = tuple(m for m, p in enumerate(points)
                            if dot(normal, p) > offset - 1e-9 * size)
            faces[members] = normal
    result = []
    for members, normal in sorted(faces.items()):
        centre = mean([points[m] for m in members])
        x = unit(sub(points[members[0]], centre))
        y = cross(normal, x)
        result.append(sorted((points[m] for m in members), key=lambda p: math.atan2(
            dot(sub(p, centre), y), dot(sub(p, centre), x)) % (2 * math.pi - 1e-9)))
    return result


def normal_of(face):
    return unit(cross(sub(face[1], face[0]), sub(face[2], face[1])))


def numbered(faces, first, last):
    """Pairs of number and face, opposite faces adding up to first + last, neighbours far apart."""
    pairs = []
    left = list(faces)
    while left:
        face = left.pop(0)
        other = min(left, key=lambda f: dot(normal_of(f), normal_of(face)))
        left.remove(other)
        pairs.append((face, other))
    result = []
    for i, (face, other) in enumerate(pairs):
        low = first + (i * 3) % len(pairs) if len(pairs) % 3 else first + i
        result += [(low, face), (first + last - low, other)] if i % 2 == 0 else \
                  [(first + last - low, face), (low, other)]
    return sorted(result)


def rotated_to(face, corner):
    """The face with the corner that comes first by `corner` (a key) in front."""
    start = max(range(len(face)), key=lambda i: corner(face[i]))
    return face[start:] + face[:start]


def numbered_die(points, first, last, height, colour, ink, shift=0.0, top=lambda p: 0):
    mesh, directions = Mesh(), {}
    for number, face in numbered(convex_faces(points), first, last):
        face = rotated_to(face, top)
        word = str(number)
        marked = number in (6, 9) and last >= 9
        loops = text(word, height if len(word) == 1 else 0.82 * height, (0, shift), mark=marked,
                     weight=0.17)
        mesh.face(face, colour, [(loops, ink)])
        directions[word] = normal_of(face)
    return mesh, directions


def tetrahedron(edge):
    a = edge / math.sqrt(8)
    return [(a, a, a), (a, -a, -a), (-a, a, -a), (-a, -a, a)]


def make_d4():
    """Three numbers to a face; the one that stands upright on all three visible faces counts."""
    edge = 18 * MM
    corners = tetrahedron(edge)
    mesh, directions = Mesh(), {}
    for number, corner in enumerate(corners, 1):
        directions[str(number)] = unit(corner)
    for face in convex_faces(corners):
        origin, x, y = face_frame(face)
        inlays = []
        for corner in face:
            out = sub(corner, origin)
            angle = math.atan2(dot(out, y), dot(out, x))
            reach = 0.25 * edge
            inlays.append((text(str(corners.index(corner) + 1), 0.21 * edge,
                                (reach * math.cos(angle), reach * math.sin(angle)),
                                angle - math.pi / 2), "white"))
        mesh.face(face, "green", inlays)
    return mesh, directions


PIPS = {1: [(0, 0)], 2: [(-1, 1), (1, -1)], 3: [(-1, 1), (0, 0), (1, -1)],
        4: [(-1, 1), (1, 1), (-1, -1), (1, -1)],
        5: [(-1, 1), (1, 1), (0, 0), (-1, -1), (1, -1)],
        6: [(-1, 1), (-1, 0), (-1, -1), (1, 1), (1, 0), (1, -1)]}


def make_d6():
    h = 8 * MM
    # 1, 2, 3 run counter-clockwise about their corner, as on Western dice.
    normals = {1: (0, 0, 1), 2: (1, 0, 0), 3: (0, 1, 0), 4: (0, -1, 0), 5: (-1, 0, 0),
               6: (0, 0, -1)}
    mesh, directions = Mesh(), {}
    for number, normal in normals.items():
        up = normals[{1: 2, 2: 3, 3: 1, 4: 1, 5: 3, 6: 2}[number]]
        side = cross(up, normal)
        corners = [scale(add(normal, add(scale(side, a), scale(up, b))), h)
                   for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        pips = [circle((1.9 if number == 1 else 1.5) * MM, 20, (4.1 * MM * a, 4.1 * MM * b))
                for a, b in PIPS[number]]
        mesh.face(corners, "ivory", [(pips, "red" if number == 1 else "black")], up)
        directions[str(number)] = tuple(float(c) for c in normal)
    return mesh, directions


def make_d8():
    a = 15 * MM / math.sqrt(2)
    points = [tuple(s * a if i == axis else 0.0 for i in range(3))
              for axis in range(3) for s in (1, -1)]
    return numbered_die(points, 1, 8, 5.6 * MM, "blue", "white", -0.4 * MM,
                        lambda p: (abs(p[2]), p))


def make_d10():
    """Pentagonal trapezohedron, 16 mm from face to face, numbered 0 to 9."""
    ratio = 1.0  # height of a tip to the radius of the belt
    flat = ratio * (1 - math.cos(math.pi / 5)) / (1 + math.cos(math.pi / 5))
    points = [(0.0, 0.0, ratio), (0.0, 0.0, -ratio)]
    points += [(math.cos(math.pi * i / 5), math.sin(math.pi * i / 5), flat * (-1)**i)
               for i in range(10)]
    points = [tuple(round(c, 12) for c in p) for p in points]
    size = 8 * MM / min(dot(normal_of(f), f[0]) for f in convex_faces(points))
    return numbered_die([scale(p, size) for p in points], 0, 9, 5.0 * MM, "purple", "white",
                        0.9 * MM, lambda p: abs(p[2]))


GOLDEN = (1 + math.sqrt(5)) / 2


def scaled_to_faces(points, inradius):
    face = convex_faces(points)[0]
    factor = inradius / dot(normal_of(face), face[0])
    return [scale(p, factor) for p in points]


def make_d12():
    signs = (1.0, -1.0)
    points = [(x, y, z) for x in signs for y in signs for z in signs]
    for a in signs:
        for b in signs:
            points += [(0.0, a / GOLDEN, b * GOLDEN), (a / GOLDEN, b * GOLDEN, 0.0),
                       (a * GOLDEN, 0.0, b / GOLDEN)]
    return numbered_die(scaled_to_faces(points, 9 * MM), 1, 12, 5.2 * MM, "red", "gold",
                        0.0, lambda p: p)


def make_d20():
    points = []
    for a in (1.0, -1.0):
        for b in (GOLDEN, -GOLDEN):
            points += [(0.0, a, b), (a, b, 0.0), (b, 0.0, a)]
    return numbered_die(scaled_to_faces(points, 10 * MM), 1, 20, 3.7 * MM, "teal", "white",
                        0.3 * MM, lambda p: p)


# --- Other things ------------------------------------------------------------------------------


def make_eraser():
    """A block of rubber in a paper sleeve, all flush, so that it lies as a plain box does."""
    y, z = 11 * MM, 6 * MM
    bands = [(-30, "rubber"), (-17, "sleeve_stripe"), (-13.5, "sleeve_white"),
             (-10, "sleeve_blue"), (23, "rubber"), (30, None)]
    mesh = Mesh()
    for (left, material), (right, _) in zip(bands, bands[1:]):
        a, b = left * MM, right * MM
        section = [(-y, -z), (y, -z), (y, z), (-y, z)]
        for (y0, z0), (y1, z1) in zip(section, section[1:] + section[:1]):
            corners = [(b, y0, z0), (a, y0, z0), (a, y1, z1), (b, y1, z1)]
            word = []
            if material == "sleeve_blue" and z0 == z1:
                word = [(text("ERASER", 5.2 * MM, weight=0.2), "sleeve_white")]
            mesh.face(corners, material, word, (0.0, 1.0, 0.0) if z0 == z1 else None)
        if left == -30:
            mesh.polygon([(a, p, q) for p, q in reversed(section)], material)
        if right == 30:
            mesh.polygon([(b, p, q) for p, q in section], material)
    return mesh, {}


def ring(radius, z, count, phase=0.0):
    return [(x, y, z) for x, y in circle(radius, count, phase=phase)]


def make_cup():
    """A mug: a hollow body of revolution in 24 sides, and a handle let into one of them."""
    count = 24
    phase = math.pi / count

    def level(r, z):
        """Across flats 2 r."""
        return ring(r * MM / math.cos(phase), z * MM, count, phase)

    outside = [level(34, 0), level(39.4, 6), level(41, 95)]
    inside = [level(39.6, 95), level(37.6, 93.6), level(36.6, 91), level(34.9, 11),
              level(31.5, 6.4), level(26, 5)]
    mesh = Mesh()
    mesh.polygon(list(reversed(outside[0])), "bare_clay")
    mesh.strip(outside[0], outside[1], "glaze")
    rings, holes = handle_rings(outside[1], outside[2])
    for i in range(count):
        j = (i + 1) % count
        panel = [outside[1][i], outside[1][j], outside[2][j], outside[2][i]]
        if i == count - 1:
            origin, x, y = face_frame(panel, (0.0, 0.0, 1.0))
            loops = [[(dot(sub(p, origin), x), dot(sub(p, origin), y)) for p in hole]
                     for hole in holes]
            mesh.face(panel, "glaze", [(loops, None)], (0.0, 0.0, 1.0))
        else:
            mesh.quad(*panel, "glaze")
    for lower, upper in zip(rings, rings[1:]):
        mesh.strip(lower, upper, "glaze")
    mesh.strip(outside[2], inside[0], "glaze_inside")
    for upper, lower in zip(inside, inside[1:]):
        mesh.strip(upper, lower, "glaze_inside")
    mesh.polygon(inside[-1], "glaze_inside")
    return mesh, {"mouth": (0.0, 0.0, 1.0)}


def handle_rings(lower, upper):
    """Cross-sections of the handle from the upper joint to the lower one, and the two holes that
    the joints make in the wall's panel between `lower` and `upper`."""
    (r0, z0), (r1, z1) = (lower[-1][0], lower[-1][2]), (upper[-1][0], upper[-1][2])

    def wall(z):
        return r0 + (z - z0) / (z1 - z0) * (r1 - r0)

    path = [(None, 76, 7.4), (44, 77, 6.2), (50, 77.6, 5.2), (57, 76, 4.8), (63, 72, 4.6),
            (67, 66, 4.5), (69, 58.5, 4.5), (68, 50, 4.5), (65, 43, 4.5), (60, 37.5, 4.7),
            (53, 32.6, 5.2), (46.5, 28.6, 6.0), (None, 25.5, 7.4)]
    path = [((wall(z * MM) if x is None else x * MM), z * MM, t * MM) for x, z, t in path]
    rings, count = [], 12
    for k, (x, z, thick) in enumerate(path):
        if k in (0, len(path) - 1):
            normal = (0.0, 1.0 if k == 0 else -1.0)
        else:
            tangent = unit((path[k + 1][0] - path[k - 1][0], path[k + 1][1] - path[k - 1][1]))
            normal = (-tangent[1], tangent[0])
        points = []
        for u, v in circle(1.0, count, phase=math.pi / count):
            px, pz = x + thick * v * normal[0], z + thick * v * normal[1]
            if k in (0, len(path) - 1):
                px = wall(pz)
            points.append((px, 4.9 * MM * u, pz))
        rings.append(points)
    return rings, [rings[0], rings[-1]]


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


def make_brick(columns, rows):
    """A toy brick: studs above, hollow below, tubes between the studs."""
    pitch, play, tall, stud = 8.0, 0.1, 9.6, 1.8
    wall, roof, segments = 1.3, 1.0, 16
    material = "brick_red"
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


# --- Files -------------------------------------------------------------------------------------

# Name: title, how it is made, mass (kg), material, restitution, friction, sampling cone, merge gap,
# notes.
OBJECTS = {
    "d4": ("Four-sided die", make_d4, 0.0008, "acrylic", 0.75, 0.4, 30, 0.01,
           "Edge 18 mm. A face's name is the number at the corner that points up."),
    "d6": ("Six-sided die", make_d6, 0.0049, "acrylic", 0.82, 0.35, 30, 0.01,
           "Edge 16 mm, pips that sum to 7 on opposite faces."),
    "d8": ("Eight-sided die", make_d8, 0.0019, "acrylic", 0.78, 0.4, 30, 0.01, "Edge 15 mm."),
    "d10": ("Ten-sided die", make_d10, 0.0035, "acrylic", 0.8, 0.4, 30, 0.01,
            "Pentagonal trapezohedron, 16 mm from face to face, numbered 0 to 9."),
    "d12": ("Twelve-sided die", make_d12, 0.005, "acrylic", 0.8, 0.5, 30, 0.01,
            "18 mm from face to face."),
    "d20": ("Twenty-sided die", make_d20, 0.006, "acrylic", 0.75, 0.6, 30, 0.01,
            "20 mm from face to face."),
    "Eraser": ("Eraser in a paper sleeve", make_eraser, 0.020, "vinyl", 0.5, 0.5, 30, 0.01,
               "60 x 22 x 12 mm."),
    "CoffeeCup": ("Coffee cup", make_cup, 0.320, "ceramic", 0.63, 0.35, 30, 0.01,
                  "82 mm across, 95 mm high, walls of about 4 mm, and a handle."),
    "Nut": ("Hexagon nut M10", make_nut, 0.011, "steel", 0.65, 0.4, 80, 0.03,
            "17 mm across flats, 8 mm high. Sampled up to 80 degrees from the vertical and merged "
            "over 30 ms, as the paper does."),
    "Lego2x2": ("Toy brick with 2 x 2 studs", lambda: make_brick(2, 2), 0.00115, "ABS", 0.7, 0.4,
                30, 0.01, "15.8 x 15.8 x 11.4 mm with studs, hollow below."),
}


def rounded(vector):
    return [round(c, 9) for c in vector]


def plain(value):
    """30 and not 30.0, as `ifa` writes numbers."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def write_mesh(folder, name, mesh):
    lines = [f"# {name}, made by make_objects.py; metres", f"mtllib {name}.mtl", f"o {name}"]
    lines += ["v " + " ".join(f"{c + 0.0:.9g}" if abs(c) > 1e-12 else "0" for c in v)
              for v in mesh.vertices]
    for material, triangles in sorted(mesh.groups.items()):
        lines += [f"usemtl {material}"] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
    write(os.path.join(folder, name + ".obj"), "\n".join(lines) + "\n")
    lines = [f"# {name}, made by make_objects.py"]
    for material in sorted(mesh.groups):
        colour, exponent, metallic = MATERIALS[material]
        lines += [f"newmtl {material}", "Kd " + " ".join(f"{c:g}" for c in colour),
                  f"Ns {exponent}", f"Pr {math.sqrt(2 / (exponent + 2)):.3g}", f"Pm {metallic}"]
    write(os.path.join(folder, name + ".mtl"), "\n".join(lines) + "\n")


def write_object(folder, name, directions):
    title, _, mass, material, restitution, friction, cone, gap, notes = OBJECTS[name]
    path = os.path.join(folder, name + ".json")
    made = {"format": "inverse-foley-object", "version": 1, "name": name, "title": title,
            "mesh": name + ".obj", "units": "m", "kind": "solid", "mass": mass,
            "material": material,
            "surfaces": {"desk": {"restitution": restitution, "friction": friction,
                                  "rolling_friction": 0.0002, "spinning_friction": 0.0002}},
            "default_surface": "desk",
            "sampling": {"cone_degrees": cone, "speed": [0.5, 4], "spin": [0, 20]},
            "merge_gap": gap}
    if directions:
        made["faces"] = {key: rounded(value) for key, value in sorted(directions.items())}
    made["notes"] = notes
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            old = json.load(file)
        from_mesh = ("format", "version", "name", "mesh", "units", "kind", "mass", "faces")
        made = {key: made[key] if key in from_mesh and key in made else old.get(key, made.get(key))
                for key in list(made) + [k for k in old if k not in made]}
    write(path, entries(plain(made), "  ") + "\n")


def entries(value, indent):
    """One entry a line, as `ifa` writes object files."""
    lines = []
    for key, item in value.items():
        nested = isinstance(item, dict) and key in ("surfaces", "faces")
        lines.append(f"{indent}{json.dumps(key)}: " +
                     (entries(item, indent + "  ") if nested else json.dumps(item)))
    return "{\n" + ",\n".join(lines) + "}"


def write(path, content):
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(content)


def main():
    arguments = sys.argv[1:]
    folder = arguments[0] if arguments else os.path.dirname(os.path.abspath(__file__))
    for name in arguments[1:] or OBJECTS:
        mesh, directions = OBJECTS[name][1]()
        mesh.check_closed(name)
        write_mesh(folder, name, mesh)
        write_object(folder, name, directions)
        density = OBJECTS[name][2] / mesh.volume()
        print(f"{name}: {mesh.triangles()} triangles, {mesh.volume() * 1e6:.4g} cm3, "
              f"{density:.0f} kg/m3")


if __name__ == "__main__":
    main()
