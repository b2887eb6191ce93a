#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""draw_objects.py OUTPUT_FOLDER [NAME...]: draws each object of the library from above and from
below into NAME.png (docs/objects; default: all objects). Standard library only."""
import array
import math
import os
import struct
import sys
import zlib

LIBRARY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "objects")
sys.path.insert(0, LIBRARY)
from geometry import cross, dot  # noqa: E402
SIDE, FINE = 240, 3  # pixels of a view; samples of a pixel along each axis
CREASE = math.cos(math.radians(30))
# Directions to the eye, two views; light comes from above, on the left of it.
VIEWS = [(0.52, -0.72, 0.62), (-0.55, -0.70, -0.52)]


def unit(a):
    """As it is where it has no length: a triangle without an area is not seen."""
    length = math.sqrt(dot(a, a)) or 1.0
    return (a[0] / length, a[1] / length, a[2] / length)


def read(name):
    """Points and triangles (three numbers, colour, exponent, metallic) of an object's mesh."""
    finish, now = {}, None
    for line in open(os.path.join(LIBRARY, name + ".mtl"), encoding="utf-8"):
        words = line.split()
        if words[:1] == ["newmtl"]:
            now = finish.setdefault(words[1], {})
        elif len(words) > 1 and now is not None:
            now[words[0]] = [float(w) for w in words[1:]]
    points, triangles, material = [], [], None
    for line in open(os.path.join(LIBRARY, name + ".obj"), encoding="utf-8"):
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(float(w) for w in words[1:]))
        elif words[:1] == ["usemtl"]:
            material = finish[words[1]]
        elif words[:1] == ["f"]:
            triangles.append((tuple(int(w) - 1 for w in words[1:]), material))
    return points, triangles


def corner_normals(points, triangles):
    """For each triangle a normal per corner: mean of the triangles about it that are less than 30
    degrees away."""
    flat = []
    for (a, b, c), _ in triangles:
        u = [points[b][k] - points[a][k] for k in range(3)]
        v = [points[c][k] - points[a][k] for k in range(3)]
        flat.append(cross(u, v))
    units = [unit(n) for n in flat]
    about = {}
    for number, (corners, _) in enumerate(triangles):
        for corner in corners:
            about.setdefault(corner, []).append(number)
    result = []
    for number, (corners, _) in enumerate(triangles):
        normals = []
        for corner in corners:
            near = [flat[m] for m in about[corner] if dot(units[m], units[number]) > CREASE]
            normals.append(unit(tuple(sum(c) for c in zip(*near))) if near else units[number])
        result.append(normals)
    return units, result


def shade(normal, eye, light, finish):
    colour, exponent, metallic = finish["Kd"], finish["Ns"][0], finish["Pm"][0]
    facing = max(dot(normal, light), 0)
    half = unit(tuple(a + b for a, b in zip(eye, light)))
    gloss = max(dot(normal, half), 0) ** (0.5 * exponent) * (0.12 + 0.4 * metallic)
    gloss *= min(1, exponent / 60)
    sky = 0.5 + 0.5 * normal[2]
    # Metal mirrors its surroundings: bright above, darker at the horizon.
    mirror = 2 * dot(normal, eye) * normal[2] - eye[2]
    diffuse = 0.38 + 0.20 * sky + 0.50 * facing
    strength = (1 - metallic) * diffuse + metallic * (0.45 * diffuse + 0.38 + 0.20 * mirror)
    return [min(1.0, c * strength + gloss) for c in colour]


def draw(points, triangles, eye, picture, left):
    """Draws a view with its left edge at column `left` of the fine picture."""
    eye = unit(eye)
    right = unit(cross((0, 0, 1), eye))
    up = cross(eye, right)
    light = unit(tuple(0.55 * e - 0.55 * r + 0.75 * u for e, r, u in zip(eye, right, up)))
    units, normals = corner_normals(points, triangles)
    flat = [(dot(p, right), dot(p, up), dot(p, eye)) for p in points]
    low = [min(p[k] for p in flat) for k in range(2)]
    high = [max(p[k] for p in flat) for k in range(2)]
    side = SIDE * FINE
    scale = 0.88 * side / max(high[0] - low[0], high[1] - low[1])
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    # A little perspective: what is nearer is larger.
    far = 6 * max(high[0] - low[0], high[1] - low[1])
    nearest = sum(p[2] for p in flat) / len(flat)
    screen = []
    for x, y, z in flat:
        s = scale * far / (far - (z - nearest))
        # This measure of nearness changes evenly along a triangle as it is seen.
        screen.append((side / 2 + (x - middle[0]) * s, side / 2 - (y - middle[1]) * s, s))
    depth = array.array("d", [-1e9]) * (side * side)
    for number, (corners, finish) in enumerate(triangles):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (screen[i] for i in corners)
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        if area >= -1e-9:  # y runs down: what faces the eye runs clockwise
            continue
        colours = [shade(n, eye, light, finish) for n in normals[number]]
        smooth = any(max(abs(p - q) for p, q in zip(colours[0], c)) > 0.004 for c in colours[1:])
        for y in range(max(0, math.ceil(min(ay, by, cy) - 0.5)),
                       min(side - 1, math.floor(max(ay, by, cy) - 0.5)) + 1):
            # The weights of the corners change evenly along a row.
            py = y + 0.5
            x0, x1 = math.ceil(min(ax, bx, cx) - 0.5), math.floor(max(ax, bx, cx) - 0.5)
            first = []
            for (ux, uy), (vx, vy) in (((bx, by), (cx, cy)), ((cx, cy), (ax, ay)),
                                       ((ax, ay), (bx, by))):
                step = (uy - vy) / area
                start = ((vx - ux) * (py - uy) - (vy - uy) * (-ux)) / area
                first.append((start, step))
                if step > 1e-12:
                    x0 = max(x0, math.ceil(-start / step - 0.5 - 1e-9))
                elif step < -1e-12:
                    x1 = min(x1, math.floor(-start / step - 0.5 + 1e-9))
                elif start < -1e-9:
                    x1 = x0 - 1
            for x in range(max(x0, 0), min(x1, side - 1) + 1):
                w = [s + d * (x + 0.5) for s, d in first]
                z = w[0] * az + w[1] * bz + w[2] * cz
                place = y * side + x
                if z <= depth[place]:
                    continue
                depth[place] = z
                colour = colours[0] if not smooth else [
                    w[0] * colours[0][k] + w[1] * colours[1][k] + w[2] * colours[2][k]
                    for k in range(3)]
                picture[y * 2 * side + left + x] = colour


def averaged(picture):
    wide = 2 * SIDE * FINE
    rows = []
    for y in range(SIDE):
        row = bytearray()
        for x in range(2 * SIDE):
            cell = [picture[(y * FINE + j) * wide + x * FINE + i]
                    for j in range(FINE) for i in range(FINE)]
            row += bytes(int(255 * sum(c[k] for c in cell) / len(cell) + 0.5) for k in range(3))
        rows.append(row)
    return rows


def write_png(path, rows):
    """With 252 colours at most: each box of colours is cut in the middle of its longest side."""
    counts = {}
    for row in rows:
        for i in range(0, len(row), 3):
            colour = bytes(row[i:i + 3])
            counts[colour] = counts.get(colour, 0) + 1
    boxes = [sorted(counts)]

    def spread(box):
        return max(max(c[k] for c in box) - min(c[k] for c in box) for k in range(3))

    while len(boxes) < 252:
        boxes.sort(key=lambda b: (spread(b) * math.sqrt(sum(counts[c] for c in b)), b))
        box = boxes.pop()
        if spread(box) == 0:
            boxes.append(box)
            break
        axis = max(range(3), key=lambda k: max(c[k] for c in box) - min(c[k] for c in box))
        box.sort(key=lambda c: (c[axis], c))
        middle = len(box) // 2
        boxes += [box[:middle], box[middle:]]
    palette, entry = b"", {}
    for number, box in enumerate(boxes):
        total = sum(counts[c] for c in box)
        palette += bytes(round(sum(c[k] * counts[c] for c in box) / total) for k in range(3))
        entry.update(dict.fromkeys(box, number))
    data = b"".join(b"\0" + bytes(entry[bytes(row[i:i + 3])] for i in range(0, len(row), 3))
                    for row in rows)

    def chunk(kind, content):
        return (struct.pack(">I", len(content)) + kind + content +
                struct.pack(">I", zlib.crc32(kind + content)))

    head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 3, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"PLTE", palette) +
                   chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    names = sys.argv[2:] or sorted(n[:-4] for n in os.listdir(LIBRARY) if n.endswith(".obj"))
    for name in names:
        points, triangles = read(name)
        picture = [(1.0, 1.0, 1.0)] * (2 * SIDE * SIDE * FINE * FINE)
        for number, eye in enumerate(VIEWS):
            draw(points, triangles, eye, picture, number * SIDE * FINE)
        write_png(os.path.join(sys.argv[1], name + ".png"), averaged(picture))


if __name__ == "__main__":
    main()
