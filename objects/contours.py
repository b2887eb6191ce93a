# SPDX-License-Identifier: Apache-2.0
"""Outlines of flat shapes that are given by a distance: negative inside, positive outside.

Shapes are functions of a point; united, cut and rounded shapes are made of simpler ones. The
outline is found by marching squares: any shape, with any holes, gives closed loops that do not
cross.
"""
import math

from geometry import signed_area


def marching_squares(distance, x0, y0, nx, ny, cell):
    """Loops along which `distance` is 0, on a grid of nx by ny corners from x0, y0."""
    grid = {(i, j): (x0 + i * cell, y0 + j * cell) for i in range(nx) for j in range(ny)}
    filled = {k: distance(p) < 0 for k, p in grid.items()}
    points, following = {}, {}

    def crossing(a, b):
        """The point between a (inside) and b (outside) where the outline passes."""
        for _ in range(12):
            m = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
            if distance(m) < 0:
                a = m
            else:
                b = m
        return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)

    def edge(a, b):
        key = (min(a, b), max(a, b))
        if key not in points:
            inner, outer = (a, b) if filled[a] else (b, a)
            points[key] = crossing(grid[inner], grid[outer])
        return key

    for i in range(nx - 1):
        for j in range(ny - 1):
            ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            # Each run of filled corners is cut off on its own: two opposite ones stay apart.
            for k in range(4):
                if filled[ring[k]] and not filled[ring[k - 1]]:
                    end = k
                    while filled[ring[(end + 1) % 4]]:
                        end += 1
                    start = edge(ring[k - 1], ring[k])
                    following[start] = edge(ring[end % 4], ring[(end + 1) % 4])
    loops = []
    while following:
        start = next(iter(following))
        loop, key = [], start
        while key in following:
            loop.append(points[key])
            key = following.pop(key)
        loops.append(loop)
    return loops


def simplified(loop, tolerance):
    """Douglas-Peucker on a closed loop."""
    far = max(range(len(loop)), key=lambda i: (loop[i][0] - loop[0][0]) ** 2 +
              (loop[i][1] - loop[0][1]) ** 2)

    def reduce(points):
        (ax, ay), (bx, by) = points[0], points[-1]
        length = math.hypot(bx - ax, by - ay)
        worst, at = 0, 0
        for i in range(1, len(points) - 1):
            d = abs((bx - ax) * (points[i][1] - ay) - (by - ay) * (points[i][0] - ax)) / length
            if d > worst:
                worst, at = d, i
        if worst <= tolerance:
            return [points[0]]
        return reduce(points[:at + 1]) + reduce(points[at:])

    return reduce(loop[:far + 1]) + reduce(loop[far:] + loop[:1])


def outline(shape, box, cell, tolerance=None):
    """The loops of a shape inside box (x0, y0, x1, y1), largest first: outline, then holes."""
    x0, y0, x1, y1 = box
    nx, ny = int((x1 - x0) / cell) + 4, int((y1 - y0) / cell) + 4
    loops = marching_squares(shape, x0 - 1.37 * cell, y0 - 1.41 * cell, nx, ny, cell)
    loops = [simplified(loop, tolerance or 0.1 * cell) for loop in loops]
    return sorted((loop for loop in loops if len(loop) > 2), key=lambda a: -abs(signed_area(a)))


# --- Shapes ------------------------------------------------------------------------------------


def disc(x, y, radius):
    return lambda p: math.hypot(p[0] - x, p[1] - y) - radius


def block(x, y, half_x, half_y, rounding=0.0, angle=0.0):
    """A rectangle about x, y, its corners rounded, turned by `angle` (degrees)."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))

    def shape(p):
        u, v = p[0] - x, p[1] - y
        a = abs(c * u + s * v) - half_x + rounding
        b = abs(c * v - s * u) - half_y + rounding
        return math.hypot(max(a, 0), max(b, 0)) + min(max(a, b), 0) - rounding
    return shape


def bar(a, b, start, end=None):
    """Between two points, half as wide as `start` at a and `end` at b, with round ends."""
    end = start if end is None else end
    dx, dy = b[0] - a[0], b[1] - a[1]

    def shape(p):
        t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)
        t = max(0, min(1, t))
        return math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy) - start - t * (end - start)
    return shape


def polygon(points):
    """The inside of a polygon, whichever way it runs."""
    sides = list(zip(points, points[1:] + points[:1]))

    def shape(p):
        within, nearest = False, math.inf
        for (ax, ay), (bx, by) in sides:
            dx, dy = bx - ax, by - ay
            t = max(0, min(1, ((p[0] - ax) * dx + (p[1] - ay) * dy) / (dx * dx + dy * dy)))
            nearest = min(nearest, math.hypot(p[0] - ax - t * dx, p[1] - ay - t * dy))
            if (ay > p[1]) != (by > p[1]) and p[0] < ax + (p[1] - ay) * dx / dy:
                within = not within
        return -nearest if within else nearest
    return shape


def united(*shapes):
    return lambda p: min(s(p) for s in shapes)


def blended(radius, *shapes):
    """United, inner corners filled by about `radius`."""
    def shape(p):
        best = shapes[0](p)
        for other in shapes[1:]:
            d = other(p)
            h = max(radius - abs(best - d), 0) / radius
            best = min(best, d) - h * h * radius / 4
        return best
    return shape


def cut(shape, *others):
    return lambda p: max([shape(p)] + [-s(p) for s in others])


def common(*shapes):
    return lambda p: max(s(p) for s in shapes)


def grown(shape, by):
    return lambda p: shape(p) - by
