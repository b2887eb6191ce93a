# SPDX-License-Identifier: Apache-2.0
"""Closed bodies of simple make: plates, bodies of revolution, tubes, lofts and walls of cells."""
import functools
import math

from geometry import Mesh, add, circle, cross, dot, scale, sub, triangulate, unit

MM = 0.001


def ring(radius, z, count, phase=0.0):
    return [(x, y, z) for x, y in circle(radius, count, phase=phase)]


def millimetres(loop):
    return [tuple(c * MM for c in p) for p in loop]


def merged(*meshes):
    """One mesh of several that touch or lie a little in each other."""
    result = Mesh()
    for mesh in meshes:
        result.add(mesh)
    return result


def plate(loops, low, high, material, side=None, bevel=None, above=(), below=()):
    """A flat piece between the heights `low` and `high`, m: outline, then holes. `bevel` is a
    smaller outline and its depth, m. above, below: (loops, material) cut into the two faces."""
    mesh = Mesh()
    side = side or material
    outside, holes = counter_clockwise(loops[0]), [counter_clockwise(h) for h in loops[1:]]
    inner, depth = (counter_clockwise(bevel[0]), bevel[1]) if bevel else (outside, 0.0)

    def lifted(loop, z):
        return [(p[0], p[1], z) for p in loop]

    def mirrored(loop):
        return [(p[0], -p[1]) for p in loop]

    mesh.strip(lifted(outside, low + depth), lifted(outside, high - depth), side)
    if bevel:
        space = [lifted(outside, high - depth) + lifted(inner, high),
                 lifted(outside, low + depth) + lifted(inner, low)]
        for a, b, c in triangulate([outside, inner]):
            mesh.triangle(space[0][a], space[0][b], space[0][c], side)
            mesh.triangle(space[1][a], space[1][c], space[1][b], side)
    mesh.planar(inner, material, [([h], None) for h in holes] + list(above),
                lambda p: (p[0], p[1], high))
    mesh.planar(mirrored(inner)[::-1], material,
                [([mirrored(h)], None) for h in holes] +
                [([mirrored(loop) for loop in group], fill) for group, fill in below],
                lambda p: (p[0], -p[1], low))
    for hole in holes:
        mesh.strip(lifted(hole, high), lifted(hole, low), side)
    return mesh


def counter_clockwise(loop):
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(loop, loop[1:] + loop[:1]))
    return list(loop) if area > 0 else list(loop)[::-1]


def cuboid(low, high, material, top=None):
    """A box between two corners; `top` is another material for the face above."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    mesh = Mesh()
    base = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    lower, upper = [(x, y, z0) for x, y in base], [(x, y, z1) for x, y in base]
    mesh.polygon(lower[::-1], material)
    mesh.strip(lower, upper, material)
    mesh.polygon(upper, top or material)
    return mesh


def loft(rings, materials, caps=(True, True)):
    """Rings of as many points, each leading to the next; both ends are closed as fans where
    `caps` says so. Seen from the far end the rings run counter-clockwise. materials: one, one a
    step, or where it changes around, a function of step and column."""
    mesh = Mesh()
    count = len(rings) - 1
    materials = [materials] * count if isinstance(materials, str) else materials
    for k, (lower, upper) in enumerate(zip(rings, rings[1:])):
        mesh.strip(lower, upper, functools.partial(materials, k) if callable(materials)
                   else materials[k])
    if caps[0]:
        fan(mesh, rings[0][::-1], materials[0])
    if caps[1]:
        fan(mesh, rings[-1], materials[-1])
    return mesh


def fan(mesh, ring, material):
    """A flat convex ring, closed about its middle."""
    centre = scale(tuple(sum(c) for c in zip(*ring)), 1 / len(ring))
    for a, b in zip(ring, ring[1:] + ring[:1]):
        mesh.triangle(a, b, centre, material)


def lathe(profile, count, shape=None, phase=0.0, closed=False, colours=None):
    """A body of revolution about z. profile: (radius, height, material from here on) in mm, the
    body on its left; it begins and ends on the axis, or is closed. `shape` may move the points:
    (radius, height, angle) to radius and height, mm. `colours` stands for the materials: a
    function of step and column."""
    rings, materials = [], []
    for r, z, material in profile:
        ring = []
        for i in range(count):
            angle = phase + 2 * math.pi * i / count
            radius, height = shape(r, z, angle) if shape else (r, z)
            ring.append((radius * MM * math.cos(angle), radius * MM * math.sin(angle),
                         height * MM))
        rings.append(ring)
        materials.append(material)
    if closed:
        rings.append(rings[0])
    return loft(rings, colours or materials[:len(rings) - 1], (False, False))


def tube(path, section, material, closed=False, normal=(0.0, 1.0, 0.0), ends=None):
    """A section carried along a path, m. section: points (across, along the normal) or a function
    of the station's number that gives them, counter-clockwise. The normal is kept as far as the
    path allows. ends: material of the end faces."""
    rings, count = [], len(path)
    for k, point in enumerate(path):
        before = path[k - 1] if closed or k else path[k]
        after = path[(k + 1) % count] if closed else path[min(k + 1, count - 1)]
        tangent = unit(sub(after, before))
        up = unit(sub(normal, scale(tangent, dot(normal, tangent))))
        across = cross(up, tangent)
        points = section(k) if callable(section) else section
        rings.append([add(point, add(scale(across, u), scale(up, v))) for u, v in points])
    if closed:
        return loft(rings + rings[:1], material, (False, False))
    mesh = loft(rings, material, (False, False))
    fan(mesh, rings[0][::-1], ends or material)
    fan(mesh, rings[-1], ends or material)
    return mesh


def ellipse(a, b, count):
    return [(a * math.cos(2 * math.pi * (i + 0.5) / count),
             b * math.sin(2 * math.pi * (i + 0.5) / count)) for i in range(count)]


def cells(outer, inner, material, filled=lambda k, i: True, around=True, inside=None):
    """A wall of cells between two grids of points [row][column]; seen from outside, columns run to
    the right and rows up. Cells that are not filled are holes. `around`: the last column is
    followed by the first. material, inside: functions of row and column."""
    mesh = Mesh()
    rows, columns = len(outer) - 1, len(outer[0]) - (0 if around else 1)
    inside = inside or material

    def at(grid, k, i):
        return grid[k][i % len(grid[0])]

    def is_filled(k, i):
        if around:
            i %= columns
        return 0 <= k < rows and 0 <= i < columns and filled(k, i)

    for k in range(rows):
        for i in range(columns):
            if not is_filled(k, i):
                continue
            corners = [(k, i), (k, i + 1), (k + 1, i + 1), (k + 1, i)]
            mesh.quad(*(at(outer, *c) for c in corners), material(k, i))
            mesh.quad(*(at(inner, *c) for c in corners[::-1]), inside(k, i))
            neighbours = [(k - 1, i), (k, i + 1), (k + 1, i), (k, i - 1)]
            for side, neighbour in enumerate(neighbours):
                if not is_filled(*neighbour):
                    a, b = corners[side], corners[(side + 1) % 4]
                    mesh.quad(at(outer, *b), at(outer, *a), at(inner, *a), at(inner, *b),
                              material(k, i))
    return mesh


def ball(frequency):
    """Points and triangles of a sphere of radius 1: each side of an icosahedron in `frequency`."""
    g = (1 + math.sqrt(5)) / 2
    corners = [unit(p) for p in [
        (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
        (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    points, index, triangles = [], {}, []

    def number(p):
        key = tuple(round(c * 1e6) for c in p)
        if key not in index:
            index[key] = len(points)
            points.append(p)
        return index[key]

    for a, b, c in faces:
        def at(i, j):
            k = frequency - i - j
            total = tuple(corners[a][d] * k + corners[b][d] * i + corners[c][d] * j
                          for d in range(3))
            return number(unit(total))
        for i in range(frequency):
            for j in range(frequency - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j < frequency - 1:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return points, triangles
