# SPDX-License-Identifier: Apache-2.0
"""Checks motions as Blender shows them: that contacts lie on the floor, that nothing sinks into it,
and that the body moves as motion.json says, between keys too.

    blender -b --factory-startup --python-exit-code 1 -P scripts/check_blender.py -- FOLDER...

A FOLDER holds motion.glb and motion.json. One row a folder, lengths in mm; exit 1 when one is over
the limit, and what is wrong comes last.
"""
import json
import pathlib
import struct
import sys

import bmesh
import bpy
import numpy

LIMIT = 0.2e-3  # m: how far a surface point may be from where it belongs
SAME = 0.01e-3  # m: Blender's scene against its own curves, single precision apart
RATE = 2000  # Hz: how densely the floor is checked
COLUMNS = "{:<22} {:>8} {:>8} {:>9} {:>11} {:>11} {:>11} {:>11}"
HEADINGS = ("folder", "contacts", "keys", "instants", "at contacts", "below floor", "off motion",
            "off scene")


def read_glb_header(path):
    """The JSON of a GLB, read without Blender."""
    data = path.read_bytes()
    return json.loads(data[20:20 + struct.unpack_from("<I", data, 12)[0]])


def import_glb(path):
    """The one animated object of the file, in a scene of its own."""
    numpy.bool = bool  # Blender 3.4's importer asks for it, and numpy 1.24 no longer has it
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    animated = [o for o in bpy.data.objects if o.animation_data and o.animation_data.action]
    if len(animated) != 1:
        raise ValueError(f"{len(animated)} animated objects instead of one")
    return animated[0]


class Curves:
    """The animation as Blender interpolates it. Frame 0 is the sound's first sample."""

    def __init__(self, body):
        self.body, self.fps = body, bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
        curves = {(c.data_path, c.array_index): c for c in body.animation_data.action.fcurves}
        self.location = [curves["location", i] for i in range(3)]
        self.rotation = [curves["rotation_quaternion", i] for i in range(4)]
        self.keys = len(self.location[0].keyframe_points)
        self.end = self.location[0].range()[1] / self.fps

    def at(self, time):
        """Position, and unit quaternion w, x, y, z: each component by itself, then made a unit."""
        frame = time * self.fps
        q = [c.evaluate(frame) for c in self.rotation]
        norm = sum(x * x for x in q) ** 0.5
        return [c.evaluate(frame) for c in self.location], [x / norm for x in q]

    def scene_at(self, time):
        """The same, of the object after the whole scene is set to that time."""
        frame = time * self.fps
        bpy.context.scene.frame_set(int(frame), subframe=frame - int(frame))
        place, turn, _ = self.body.matrix_world.decompose()
        return list(place), list(turn)


def hull_points(mesh):
    """What can be lowest: the corners of the convex hull, and the radius of all."""
    shape = bmesh.new()
    shape.from_mesh(mesh)
    hull = bmesh.ops.convex_hull(shape, input=shape.verts, use_existing_faces=False)
    points = [tuple(v.co) for v in hull["geom"] if isinstance(v, bmesh.types.BMVert)]
    radius = max(v.co.length for v in shape.verts)
    shape.free()
    return points, radius


def lowest(points, pose):
    (_, _, height), (w, x, y, z) = pose
    a, b, c = 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
    return height + min(a * p + b * q + c * r for p, q, r in points)


def distance(a, b, radius):
    """A bound on how far any point of the surface is from where it should be."""
    shift = sum((p - q) ** 2 for p, q in zip(a[0], b[0])) ** 0.5
    same = min(sum((p - s * q) ** 2 for p, q in zip(a[1], b[1])) for s in (1, -1)) ** 0.5
    return shift + radius * 2 * same


def differences_of_materials(path):
    for material in read_glb_header(path)["materials"]:
        shown = bpy.data.materials.get(material["name"])
        if shown is None:
            yield f"no material {material['name']}"
            continue
        wanted = material["pbrMetallicRoughness"]["baseColorFactor"]
        inputs = shown.node_tree.nodes["Principled BSDF"].inputs
        colour = [*list(inputs["Base Color"].default_value)[:3], inputs["Alpha"].default_value]
        if max(abs(p - q) for p, q in zip(colour, wanted)) > 1e-5:
            yield f"material {material['name']} is {colour} instead of {wanted}"


def check(folder):
    """Prints the row of a folder and yields what is wrong with it."""
    motion = json.loads((folder / "motion.json").read_text(encoding="utf-8"))
    body = import_glb(folder / "motion.glb")
    curves = Curves(body)
    points, radius = hull_points(body.data)
    origin = motion["sound"]["first_contact"]

    contacts = list(body["contact_starts"])
    touching = max(abs(lowest(points, curves.at(time))) for time in contacts)
    instants = [i / RATE for i in range(int(curves.end * RATE) + 1)]
    sunk = -min(lowest(points, curves.at(time)) for time in instants)

    track, off_motion = motion["trajectory"], 0
    for time, *pose in zip(track["time"], track["position"], track["orientation"]):
        if time + origin >= 0:
            off_motion = max(off_motion, distance(curves.at(time + origin), pose, radius))
    off_scene = max(distance(curves.scene_at(time), curves.at(time), radius)
                    for time in contacts + instants[::37])

    print(COLUMNS.format(folder.name, len(contacts), curves.keys, len(instants),
                         *(f"{1000 * x:.4f}" for x in (touching, sunk, off_motion, off_scene))))
    wanted = [contact["time"] + origin for contact in motion["contacts"]]
    if len(contacts) != len(wanted) or max(abs(p - q) for p, q in zip(contacts, wanted)) > 1e-9:
        yield "contact_starts are not those of motion.json"
    if touching > LIMIT:
        yield f"the lowest point is {1000 * touching:.3f} mm from the floor at a contact"
    if sunk > LIMIT:
        yield f"the body sinks {1000 * sunk:.3f} mm into the floor"
    if off_motion > LIMIT:
        yield f"a point is {1000 * off_motion:.3f} mm off motion.json"
    if off_scene > SAME:
        yield f"the scene is {1000 * off_scene:.3f} mm off its own curves"
    yield from differences_of_materials(folder / "motion.glb")


def main(folders):
    print(COLUMNS.format(*HEADINGS))
    problems = [f"{folder}: {problem}" for folder in folders for problem in check(folder)]
    print(*problems, sep="\n", end="\n" if problems else "", file=sys.stderr)
    sys.exit(1 if problems or not folders else 0)


main([pathlib.Path(name) for name in sys.argv[sys.argv.index("--") + 1:]])
