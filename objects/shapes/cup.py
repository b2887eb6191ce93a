# SPDX-License-Identifier: Apache-2.0
"""The coffee cup: a handle let into the wall of a hollow body."""
import math

from geometry import Mesh, circle, dot, face_frame, sub, unit
from solids import MM, ring


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
