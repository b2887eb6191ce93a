# SPDX-License-Identifier: Apache-2.0
"""What lies on a desk."""
from geometry import Mesh
from glyphs import text
from solids import MM


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
