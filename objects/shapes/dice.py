# SPDX-License-Identifier: Apache-2.0
"""Dice: numbers and pips lie flush in the faces."""
import itertools
import math

from geometry import (Mesh, add, circle, cross, dot, face_frame, mean, scale, sub, unit)
from glyphs import text
from solids import MM


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
