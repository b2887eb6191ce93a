# SPDX-License-Identifier: Apache-2.0
"""Cards, coins, books, pencils and a ball of paper."""
import math
import random

from contours import blended, block, cut, disc, outline, polygon
from geometry import Mesh, add, circle, dot, scale, unit
from glyphs import text
from solids import MM, ball, cuboid, loft, merged, millimetres, plate


def box(x0, y0, x1, y1):
    return millimetres([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def make_credit_card():
    """85.6 x 54 x 0.76 mm, with chip, numbers and name in front, stripe and signature behind."""
    outer = millimetres(outline(block(0, 0, 42.8, 27, 3.2), (-43, -28, 43, 28), 0.7, 0.05)[0])

    chip = millimetres(outline(block(-27, 4.5, 6.2, 4.9, 1.4), (-34, -1, -20, 10), 0.5, 0.05)[0])
    lines = [box(-32.4, 2.6, -28.6, 3.1), box(-32.4, 6.0, -28.6, 6.5), box(-25.4, 2.6, -21.6, 3.1),
             box(-25.4, 6.0, -21.6, 6.5), box(-29, 0.6, -25, 1.1), box(-28, 3.4, -26, 5.8)]
    front = [([chip], "chip"), (lines, "card_blue")]
    for number, word in enumerate(("4024", "0071", "9265", "3580")):
        front.append((text(word, 4.6 * MM, ((-27 + 18 * number) * MM, -7.5 * MM), weight=0.17),
                      "card_text"))
    front.append((text("MEMBER", 3.0 * MM, (-19 * MM, -19 * MM), weight=0.15), "card_text"))
    left = outline(cut(disc(27, -18.5, 6), disc(33, -18.5, 6.2)), (19, -26, 41, -11), 0.6, 0.05)[0]
    front += [([millimetres(left)], "card_green"),
              ([circle(6 * MM, 28, (33 * MM, -18.5 * MM))], "card_yellow")]
    front.append((text("BANK", 5.4 * MM, (24 * MM, 18 * MM), weight=0.2), "card_text"))
    back = [([box(-42.2, 12, 42.2, 22)], "stripe"), ([box(-36, -1, 18, 8)], "card_text"),
            ([box(22, 0, 34, 7)], "white")]
    mesh = plate([outer], -0.38 * MM, 0.38 * MM, "card_light", "card_blue", above=front,
                 below=back)
    return mesh, {"front": (0.0, 0.0, 1.0), "back": (0.0, 0.0, -1.0)}


def make_coin():
    """24 mm across, 2 mm thick: a brass middle in a silver ring, a head and a figure, a reeded
    edge."""
    radius, half, count = 12 * MM, 1 * MM, 72
    edge = circle(radius, count)
    head = blended(2.5, disc(-0.3, 2.0, 4.0),
                   polygon([(2.6, 4.2), (5.0, 0.6), (3.7, 0.2), (3.9, -2.6), (1.4, -3.2), (1, 0)]),
                   polygon([(-3.4, 0.5), (-3.2, -4), (-5.2, -6.6), (3, -6.6), (1.2, -3), (1.5, 1)]))
    loops = outline(head, (-8, -8, 8, 8), 0.4, 0.06)[:1]
    band = [circle(11.4 * MM, 60), circle(8.6 * MM, 60)]
    figure = [[(-x, y) for x, y in loop] for loop in text("10", 8.4 * MM, weight=0.2)]
    mesh = plate([edge], -half, half, "brass", lambda i: "silver" if i % 2 else "dark_steel",
                 above=[(band, "silver"), ([millimetres(loop) for loop in loops], "copper")],
                 below=[(band, "silver"), (figure, "copper")])
    return mesh, {"heads": (0.0, 0.0, 1.0), "tails": (0.0, 0.0, -1.0)}


def make_pencil():
    """A hexagonal pencil of 175 mm, 6.8 mm across flats: sharpened, with ferrule and rubber."""
    flat, count = 3.4, 24

    def round_(radius, x):
        return [(x * MM, y, z) for y, z in circle(radius * MM, count, phase=math.pi / count)]

    def hexagon(x, shaved=0.0):
        """In as many points as the cone has; `shaved`: how far the cone bites into the edges."""
        points = []
        for i in range(count):
            angle = 2 * math.pi * (i + 0.5) / count
            within = (angle + math.pi / 6) % (math.pi / 3) - math.pi / 6
            r = flat / math.cos(within)
            points.append(((x + shaved * (r - flat)) * MM, r * MM * math.cos(angle),
                           r * MM * math.sin(angle)))
        return points

    rings = [round_(0.25, -87.5), round_(1.05, -82.5), hexagon(-68, 6.2), hexagon(68)]
    rings += [round_(r, x) for r, x in (
        (3.5, 68.2), (3.5, 70), (3.75, 70.8), (3.75, 72), (3.5, 72.8), (3.5, 74.2), (3.75, 75),
        (3.75, 76.2), (3.5, 77), (3.5, 79.2), (3.2, 79.2), (3.2, 85), (2.4, 87), (1.2, 87.5))]
    materials = ["graphite", "wood_pale", "lacquer_yellow"] + ["brass"] * 11 + ["pink_rubber"] * 3
    return loft(rings, materials), {"tip": (-1.0, 0.0, 0.0)}


def make_book():
    """A bound book, 134 x 200 x 24 mm: boards that stand over the pages by 3 mm, a round spine."""
    wide, tall, thick, board = 65, 100, 12, 2.4
    joint = 62 - 3
    title = text("NOTES", 15 * MM, (2 * MM, 42 * MM), weight=0.18)
    frames = [box(-54, -90, 58, 90), box(-52, -88, 56, 88)]
    lines = [box(-34, -46, 38, -43.5), box(-22, -54, 26, -51.5)]
    loop = [box(-joint, -tall, wide, tall)]
    cover = plate(loop, (thick - board) * MM, thick * MM, "cover",
                  above=[(frames, "gold"), (title, "gold"), (lines, "gold")])
    back = plate(loop, -thick * MM, (board - thick) * MM, "cover", below=[(frames, "gold")])
    angles = [math.radians(90 - 20 * k) for k in range(10)]
    outer = [(-joint - 10 * math.cos(a), thick * math.sin(a)) for a in angles]
    inner = [(-joint - 7 * math.cos(a), (thick - board) * math.sin(a)) for a in angles[::-1]]
    spine = plate([millimetres(outer + inner)], -tall * MM, tall * MM, "cover").moved(
        lambda p: (p[0], -p[2], p[1]))
    leaves = cuboid((-joint * MM, (3 - tall) * MM, (board - thick) * MM),
                    ((wide - 3) * MM, (tall - 3) * MM, (thick - board) * MM), "pages")
    return merged(cover, back, spine, leaves), {"cover": (0.0, 0.0, 1.0), "back": (0.0, 0.0, -1.0)}


def make_paper_ball():
    """A sheet of paper crumpled to a ball of about 70 mm: flat facets, and folds across them."""
    draw = random.Random(11)
    points, triangles = ball(6)

    def direction():
        return unit(tuple(draw.uniform(-1, 1) for _ in range(3)))

    planes = [(direction(), draw.uniform(29, 34)) for _ in range(20)]
    place, deep = [], []
    for p in points:
        # Corners of the crumple lie at random, in and out, and not evenly about the ball.
        p = unit(add(p, scale(direction(), 0.055)))
        flat = min(d / max(dot(n, p), 0.05) for n, d in planes)
        deep.append(draw.choice((0, 0, 0.4, 1.5, 3.4, 5.2)))
        place.append(scale(p, (0.95 * (min(flat, 38) + 1) - deep[-1]) * MM))
    mesh = Mesh()
    for corners in triangles:
        shade = "paper_shade" if sum(deep[i] for i in corners) > 10 else "paper"
        mesh.triangle(*(place[i] for i in corners), shade)
    return mesh, {}
