# SPDX-License-Identifier: Apache-2.0
"""Small geometry kit of make_objects.py: meshes of flat faces with outlines cut into them.

Everything is deterministic and uses the standard library only. Lengths in metres.
"""
import math


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scale(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scale(a, 1 / math.sqrt(dot(a, a)))


def mean(points):
    return scale(tuple(sum(c) for c in zip(*points)), 1 / len(points))


# --- Flat polygons -----------------------------------------------------------------------------


def signed_area(loop):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(loop, loop[1:] + loop[:1])) / 2


def turn(a, b, c):
    """Twice the signed area of a triangle: positive when it runs counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])


def inside(point, loop):
    """Whether a point lies in a simple polygon."""
    within = False
    for a, b in zip(loop, loop[1:] + loop[:1]):
        if (a[1] > point[1]) != (b[1] > point[1]):
            if point[0] < a[0] + (point[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]):
                within = not within
    return within


def bridge(ring, hole, points):
    """Joins a clockwise hole to a ring by a double edge (Eberly): both are lists of indices."""
    start = max(range(len(hole)), key=lambda i: (points[hole[i]][0], -i))
    m = points[hole[start]]
    best, best_x = None, math.inf
    for i in range(len(ring)):
        a, b = points[ring[i]], points[ring[(i + 1) % len(ring)]]
        if a[1] <= m[1] <= b[1] and a[1] != b[1]:
            x = a[0] + (m[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
            if m[0] - 1e-15 <= x < best_x:
                best, best_x = i, x
    a, b = ring[best], ring[(best + 1) % len(ring)]
    target = best if points[a][0] > points[b][0] else (best + 1) % len(ring)
    corner = points[ring[target]]
    hit = (best_x, m[1])
    if corner != hit:
        triangle = [m, hit, corner] if turn(m, hit, corner) > 0 else [m, corner, hit]
        nearest = None
        for i in range(len(ring)):
            p = points[ring[i]]
            if p == corner or not covers(triangle, p):
                continue
            before, after = points[ring[i - 1]], points[ring[(i + 1) % len(ring)]]
            if turn(before, p, after) > 0:
                continue
            key = (abs(p[1] - m[1]) / max(p[0] - m[0], 1e-30), p[0])
            if nearest is None or key < nearest[0]:
                nearest = (key, i)
        if nearest is not None:
            target = nearest[1]
    # Where bridges meet, a point is in the ring more than once; take the one that sees the hole.
    for i in range(len(ring)):
        if ring[i] == ring[target] and sees(points, ring, i, m):
            target = i
            break
    return ring[:target + 1] + hole[start:] + hole[:start + 1] + ring[target:]


def sees(points, ring, i, m):
    """Whether m lies inside the ring's angle at its point i."""
    before, p, after = points[ring[i - 1]], points[ring[i]], points[ring[(i + 1) % len(ring)]]
    if turn(before, p, after) > 0:
        return turn(before, p, m) > 0 and turn(p, after, m) > 0
    return turn(before, p, m) > 0 or turn(p, after, m) > 0


def covers(triangle, p):
    a, b, c = triangle
    return turn(a, b, p) >= 0 and turn(b, c, p) >= 0 and turn(c, a, p) >= 0


def triangulate(loops):
    """Triangles (indices into the concatenated loops) of an outline and the holes inside it.

    The first loop is the outline; which way the loops run does not matter.
    """
    points, rings = [], []
    for number, loop in enumerate(loops):
        indices = list(range(len(points), len(points) + len(loop)))
        points += loop
        if (signed_area(loop) > 0) != (number == 0):
            indices.reverse()
        rings.append(indices)
    ring = rings[0]
    for hole in sorted(rings[1:], key=lambda h: -max(points[i][0] for i in h)):
        ring = bridge(ring, hole, points)
    triangles = clip_ears(ring, points)
    outline = {(r[i - 1], r[i]) for r in rings for i in range(len(r))}
    return flip_edges(triangles, points, outline)


def quality(points, triangle):
    """Area against the longest side, 0.43 for the best; at most 0 when it has none."""
    a, b, c = (points[i] for i in triangle)
    sides = [sum(x * x for x in sub(p, q)) for p, q in ((a, b), (b, c), (c, a))]
    return turn(a, b, c) / 2 / max(sides)


def flip_edges(triangles, points, fixed):
    """Turns inner edges as long as that makes the worse of their two triangles better."""
    triangles = [tuple(t) for t in triangles]
    for _ in range(50):
        owner = {(t[k - 1], t[k]): n for n, t in enumerate(triangles) for k in range(3)}
        touched, changed = set(), False
        for (a, b), n in list(owner.items()):
            m = owner.get((b, a))
            if a > b or m is None or n in touched or m in touched:
                continue
            if (a, b) in fixed or (b, a) in fixed:
                continue
            c = next(i for i in triangles[n] if i not in (a, b))
            d = next(i for i in triangles[m] if i not in (a, b))
            fresh = (d, b, c), (c, a, d)
            if c != d and min(quality(points, t) for t in fresh) > 1e-9 + min(
                    quality(points, triangles[n]), quality(points, triangles[m])):
                triangles[n], triangles[m] = fresh
                touched |= {n, m}
                changed = True
        if not changed:
            break
    return triangles


def clip_ears(ring, points):
    """Cuts off the best ear again and again. What is known of a corner (the shape of its ear, or a
    point that lies in it) holds until a neighbour, or that point, is gone."""
    triangles, known = [], {}
    ring = list(ring)

    def judge(i):
        ia, ib, ic = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
        a, b, c = points[ia], points[ib], points[ic]
        if turn(a, b, c) <= 0:
            return None, None
        for j in ring:
            if j not in (ia, ib, ic) and covers((a, b, c), points[j]) and \
                    points[j] not in (a, b, c):
                return None, j
        return quality(points, (ia, ib, ic)), None

    while len(ring) > 3:
        best = None
        for i in range(len(ring)):
            key = (ring[i - 1], ring[i], ring[(i + 1) % len(ring)])
            if key not in known:
                known[key] = judge(i)
            shape = known[key][0]
            if shape is not None and (best is None or shape > best[0]):
                best = (shape, i)
        if best is None:
            # What is left has no area: points in one line, and the two sides of bridges.
            sizes = [abs(turn(points[ring[i - 1]], points[ring[i]],
                              points[ring[(i + 1) % len(ring)]])) for i in range(len(ring))]
            if min(sizes) > 1e-14:
                raise ValueError("no ear: the outline crosses itself")
            best = (0, sizes.index(min(sizes)))
        i = best[1]
        gone = ring[i]
        triangles.append((ring[i - 1], ring[i], ring[(i + 1) % len(ring)]))
        del ring[i]
        if gone not in ring:
            known = {key: value for key, value in known.items() if value[1] != gone}
    triangles.append(tuple(ring))
    return triangles


def circle(radius, count, centre=(0.0, 0.0), phase=0.0):
    return [(centre[0] + radius * math.cos(phase + 2 * math.pi * i / count),
             centre[1] + radius * math.sin(phase + 2 * math.pi * i / count)) for i in range(count)]


# --- Meshes ------------------------------------------------------------------------------------


class Mesh:
    """Triangles by material; vertices at the same place (0.1 micrometre) are one."""

    def __init__(self):
        self.vertices, self.index, self.groups = [], {}, {}

    def vertex(self, point):
        key = tuple(round(c * 1e7) for c in point)
        if key not in self.index:
            self.index[key] = len(self.vertices)
            self.vertices.append(point)
        return self.index[key]

    def triangle(self, a, b, c, material):
        ids = tuple(self.vertex(p) for p in (a, b, c))
        if len(set(ids)) == 3:
            self.groups.setdefault(material, []).append(ids)

    def polygon(self, points, material):
        """A flat convex polygon, counter-clockwise seen from outside."""
        for b, c in zip(points[1:], points[2:]):
            self.triangle(points[0], b, c, material)

    def face(self, points, material, inlays=(), up=None):
        """A flat face with outlines of other colours (or holes) cut into it.

        points: corners, counter-clockwise seen from outside. inlays: (loops, material) with loops
        in the face's frame of `face_frame`; loops nest (a loop inside another is its hole);
        material None leaves a hole.
        """
        origin, x, y = face_frame(points, up)
        flat = [(dot(sub(p, origin), x), dot(sub(p, origin), y)) for p in points]
        self.planar(flat, material, inlays, lambda p: add(origin, add(scale(x, p[0]),
                                                                     scale(y, p[1]))), points)

    def planar(self, outline, material, inlays, place, corners=None):
        """The same with the outline in the plane and `place` that carries the plane into space."""
        loops = [(loop, fill) for group, fill in inlays for loop in group]
        if not all(inside(p, outline) for loop, _ in loops for p in loop):
            raise ValueError("an inlay leaves its face")
        parents = [max((j for j, (other, _) in enumerate(loops)
                        if j != i and inside(loop[0], other)),
                       key=lambda j: -abs(signed_area(loops[j][0])), default=-1)
                   for i, (loop, _) in enumerate(loops)]
        depth = [0] * len(loops)
        for i in range(len(loops)):
            j = parents[i]
            while j >= 0:
                depth[i], j = depth[i] + 1, parents[j]
        regions = [(outline, -1, material)]
        for i, (loop, fill) in enumerate(loops):
            # Every second level of nesting shows the ground again.
            regions.append((loop, i, fill if depth[i] % 2 == 0 else material))
        for loop, own, fill in regions:
            if fill is None:
                continue
            holes = [loops[i][0] for i in range(len(loops)) if parents[i] == own]
            flat = [p for part in [loop] + holes for p in part]
            space = [place(p) for p in flat]
            if own == -1 and corners:
                space[:len(corners)] = corners
            for a, b, c in triangulate([loop] + holes):
                self.triangle(space[a], space[b], space[c], fill)

    def strip(self, lower, upper, material):
        """Quadrilaterals between two closed rings of as many points, seen from outside with
        `lower` running counter-clockwise about the axis that leads to `upper`. material: one, or
        a function of the quadrilateral's number."""
        count = len(lower)
        for i in range(count):
            j = (i + 1) % count
            self.quad(lower[i], lower[j], upper[j], upper[i],
                      material(i) if callable(material) else material)

    def quad(self, a, b, c, d, material):
        self.triangle(a, b, c, material)
        self.triangle(a, c, d, material)

    def add(self, other, move=lambda p: p):
        """Takes another mesh in, each point carried to move(point), which keeps right and left."""
        ids = [len(self.vertices) + i for i in range(len(other.vertices))]
        self.vertices += [move(p) for p in other.vertices]
        for material, triangles in other.groups.items():
            self.groups.setdefault(material, []).extend(
                tuple(ids[i] for i in triangle) for triangle in triangles)

    def moved(self, move):
        result = Mesh()
        result.add(self, move)
        return result

    def volume(self):
        v = self.vertices
        return sum(dot(v[a], cross(v[b], v[c])) for group in self.groups.values()
                   for a, b, c in group) / 6

    def check_closed(self, name):
        edges = {}
        for group in self.groups.values():
            for a, b, c in group:
                for edge in ((a, b), (b, c), (c, a)):
                    edges[edge] = edges.get(edge, 0) + 1
        for (a, b), count in edges.items():
            if count != 1 or edges.get((b, a), 0) != 1:
                raise ValueError(f"{name}: not closed at {self.vertices[a]} {self.vertices[b]}")
        if self.volume() <= 0:
            raise ValueError(f"{name}: inside out")

    def triangles(self):
        return sum(len(group) for group in self.groups.values())


def face_frame(points, up=None):
    """Origin (mean of the corners) and axes in the plane: y leads towards `up`, else to the first
    corner."""
    origin = mean(points)
    normal = unit(cross(sub(points[1], points[0]), sub(points[2], points[1])))
    y = up or sub(points[0], origin)
    y = unit(sub(y, scale(normal, dot(y, normal))))
    return origin, cross(y, normal), y
