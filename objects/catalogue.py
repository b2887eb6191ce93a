# SPDX-License-Identifier: Apache-2.0
"""The objects of the library: how each is made, and what its file says besides."""
import dataclasses
from typing import Callable

from shapes import cup, dice, household, kitchen, office, papers, tools, toys, vessels


@dataclasses.dataclass
class Item:
    """restitution and friction are where the calibration starts; `ifa`'s tools keep their results
    in the object files."""
    title: str
    make: Callable  # mesh and named directions
    mass: float  # kg
    material: str
    restitution: float
    friction: float
    notes: str
    kind: str = "solid"
    surfaces: tuple = ("desk",)
    rolling: float = 0.0002  # m
    cone: float = 30  # degrees
    gap: float = 0.01  # s


# Carpet takes more of a blow, holds better and stops what rolls.
CARPET = {"restitution": 0.7, "friction": 0.2, "rolling": 0.001}  # at least

OBJECTS = {
    "d4": Item("Four-sided die", dice.make_d4, 0.0008, "acrylic", 0.75, 0.4,
               "Edge 18 mm. A face's name is the number at the corner that points up."),
    "d6": Item("Six-sided die", dice.make_d6, 0.0049, "acrylic", 0.82, 0.35,
               "Edge 16 mm, pips that sum to 7 on opposite faces."),
    "d8": Item("Eight-sided die", dice.make_d8, 0.0019, "acrylic", 0.78, 0.4, "Edge 15 mm."),
    "d10": Item("Ten-sided die", dice.make_d10, 0.0035, "acrylic", 0.8, 0.4,
                "Pentagonal trapezohedron, 16 mm from face to face, numbered 0 to 9."),
    "d12": Item("Twelve-sided die", dice.make_d12, 0.005, "acrylic", 0.8, 0.5,
                "18 mm from face to face."),
    "d20": Item("Twenty-sided die", dice.make_d20, 0.006, "acrylic", 0.75, 0.6,
                "20 mm from face to face."),
    "Eraser": Item("Eraser in a paper sleeve", office.make_eraser, 0.020, "vinyl", 0.5, 0.5,
                   "60 x 22 x 12 mm."),
    "CoffeeCup": Item("Coffee cup", cup.make_cup, 0.320, "ceramic", 0.63, 0.35,
                      "82 mm across, 95 mm high, walls of about 4 mm, and a handle."),
    "Nut": Item("Hexagon nut M10", tools.make_nut, 0.011, "steel", 0.65, 0.4,
                "17 mm across flats, 8 mm high. Sampled up to 80 degrees from the vertical and "
                "merged over 30 ms, as the paper does.", cone=80, gap=0.03),
    "Lego2x2": Item("Toy brick with 2 x 2 studs", lambda: toys.make_brick(2, 2), 0.00115, "ABS",
                    0.7, 0.4, "15.8 x 15.8 x 11.4 mm with studs, hollow below."),
    "Lego2x4": Item("Toy brick with 2 x 4 studs", lambda: toys.make_brick(4, 2, "brick_blue"),
                    0.0023, "ABS", 0.55, 0.4, "31.8 x 15.8 x 11.4 mm with studs, hollow below."),
    "AdjustableWrench": Item(
        "Adjustable wrench", tools.make_adjustable_wrench, 0.270, "steel", 0.4, 0.3,
        "200 x 52 x 12 mm, jaws 14 mm apart. Solid; lighter than the mesh's volume in steel, "
        "since the handle of a real one is hollowed on both sides."),
    "Wrench": Item("Combination spanner", tools.make_wrench, 0.120, "steel", 0.6, 0.3,
                   "170 x 35 x 7 mm. Solid: the mesh's volume in steel is the mass."),
    "Bolt": Item("Hexagon bolt M10 x 50", tools.make_bolt, 0.040, "steel", 0.5, 0.35,
                 "17 mm across flats, solid steel. Sampled up to 80 degrees from the vertical, as "
                 "the paper does.", cone=80),
    "BeerCanCrushed": Item(
        "Crushed beer can", vessels.make_beer_can, 0.013, "aluminium", 0.35, 0.4,
        "66 mm across, trodden to 70 mm. An even shell of aluminium, empty; lid and bottom are "
        "thicker than the wall in truth, but have the smaller part of the mass. Rolls badly over "
        "its folds. Merged over 30 ms, as the paper does.", "shell", ("wood",), rolling=0.002,
        gap=0.03),
    "Carton": Item("Milk carton", vessels.make_carton, 0.035, "cardboard", 0.3, 0.4,
                   "95 x 95 x 200 mm with its gable, empty: an even shell of coated board.",
                   "shell"),
    "PlasticContainer": Item("Plastic container", kitchen.make_plastic_container, 0.030,
                             "polypropylene", 0.45, 0.35,
                             "110 x 110 x 60 mm, open, without its lid. The mesh has both sides of "
                             "the wall, each with half of the shell's mass.", "shell"),
    "PlasticSpoon": Item("Plastic spoon", kitchen.make_plastic_spoon, 0.0035, "polystyrene", 0.35,
                         0.35, "150 x 32 x 12 mm. The mesh has both sides of the wall, each with "
                         "half of the shell's mass.", "shell"),
    "MetalCup": Item("Steel cup", vessels.make_metal_cup, 0.120, "steel", 0.55, 0.3,
                     "80 mm across, 85 mm high, with a strap for a handle: an even shell.",
                     "shell", ("desk", "carpet")),
    "FruitBasket": Item("Woven fruit basket", kitchen.make_fruit_basket, 0.350, "willow", 0.3, 0.4,
                        "280 mm across, 110 mm high. An even shell: canes are about as thick "
                        "everywhere. Rolls badly, from cane to cane, which are 25 mm apart.",
                        "shell", ("wood", "carpet"), rolling=0.02),
    "Garlic": Item("Bulb of garlic", kitchen.make_garlic, 0.050, "garlic", 0.3, 0.5,
                   "55 mm across, 50 mm high, solid. Rolls badly, from clove to clove. Merged "
                   "over 30 ms, as the paper does.",
                   surfaces=("wood",), rolling=0.005, gap=0.03),
    "Keyboard": Item("Computer keyboard", household.make_keyboard, 0.600, "ABS", 0.35, 0.5,
                     "450 x 150 x 25 mm. Solid of even density, half that of plastic: case, plate "
                     "and circuit board fill it about evenly.", surfaces=("carpet",)),
    "TapeDispenser": Item("Tape dispenser", household.make_tape_dispenser, 0.250, "ABS", 0.45, 0.4,
                          "130 x 60 x 65 mm. Solid: weighted base, roll and cheeks have about the "
                          "density of plastic together.", surfaces=("wood", "desk")),
    "CoatHanger": Item("Coat hanger", household.make_coat_hanger, 0.050, "polypropylene", 0.5,
                       0.35, "420 x 220 x 6 mm, solid; its hook counts as plastic, which is 2 g "
                       "less than steel."),
    "Dustpan": Item("Dustpan", household.make_dustpan, 0.200, "polypropylene", 0.5, 0.4,
                    "312 x 230 x 76 mm with its handle. The mesh has both sides of the walls, each "
                    "with half of the shell's mass.", "shell", ("wood", "carpet")),
    "CreditCard": Item("Credit card", papers.make_credit_card, 0.005, "PVC", 0.4, 0.35,
                       "85.6 x 54 x 0.76 mm, solid; the print lies flush."),
    "PaperBall": Item("Crumpled paper", papers.make_paper_ball, 0.005, "paper", 0.4, 0.5,
                      "About 70 mm: a sheet of A4. A shell: most of the sheet lies outside.",
                      "shell", rolling=0.001),
    "Coin": Item("Coin", papers.make_coin, 0.0075, "brass", 0.5, 0.25,
                 "24 x 2 mm. Everyday: hard on hard but thin, so that a blow rings away; smooth.",
                 rolling=0.0001),
    "Key": Item("Door key", tools.make_key, 0.0118, "brass", 0.4, 0.3,
                "57 x 23 x 2.2 mm. Everyday: brass is softer than steel and a long flat piece "
                "takes up much of a blow in bending."),
    "Marble": Item("Glass marble", toys.make_marble, 0.0052, "glass", 0.7, 0.2,
                   "16 mm. Everyday: glass gives back nearly all, a desk of wood about half of the "
                   "energy; smooth, rolls far.", rolling=0.0001),
    "PingPongBall": Item("Table tennis ball", toys.make_ping_pong_ball, 0.0027, "celluloid", 0.87,
                         0.3, "40 mm, a shell. Everyday: the rules ask for 24 to 26 cm after a "
                         "fall of 30.5 cm on steel (0.89 to 0.92); a desk takes a little more.",
                         "shell"),
    "Pencil": Item("Pencil", papers.make_pencil, 0.005, "wood", 0.45, 0.35,
                   "175 mm, 6.8 mm across flats, solid of even density. Everyday: lacquered wood "
                   "on wood."),
    "BottleCap": Item("Crown cap", kitchen.make_bottle_cap, 0.0022, "steel", 0.45, 0.3,
                      "32 x 6 mm, 21 flutes. Everyday: thin sheet with a soft liner.", "shell"),
    "WoodenBlock": Item("Alphabet block", toys.make_wooden_block, 0.040, "beech", 0.5, 0.4,
                        "40 mm, solid. Everyday: wood on wood gives back about a quarter of the "
                        "energy."),
    "Book": Item("Bound book", papers.make_book, 0.420, "paper", 0.2, 0.4,
                 "134 x 200 x 24 mm, solid of even density. Everyday: pages slide on each other "
                 "and leave little of a blow."),
    "Mug": Item("Stoneware mug", vessels.make_mug, 0.335, "stoneware", 0.5, 0.35,
                "96 mm across, 88 mm high, walls of about 5 mm, solid stoneware. Everyday: hard "
                "and stiff, with an unglazed foot."),
}
