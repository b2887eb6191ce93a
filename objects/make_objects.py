#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the meshes of the library of objects and the fields of the object files that follow from
them (mesh, units, kind, mass, faces). Surfaces, which are calibrated by `ifa`, and whatever else
stands in an object file already are kept.

Usage: make_objects.py [FOLDER] [NAME...]   (default: the folder of this script, all objects)

What there is stands in catalogue.py, the shapes in shapes/.
"""
import json
import math
import os
import sys

sys.dont_write_bytecode = True  # the folder is installed as it stands

from catalogue import CARPET, OBJECTS
from materials import MATERIALS


def rounded(vector):
    return [round(c, 9) for c in vector]


def plain(value):
    """30 and not 30.0, as `ifa` writes numbers."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def write_mesh(folder, name, mesh):
    lines = [f"# {name}, made by make_objects.py; metres", f"mtllib {name}.mtl", f"o {name}"]
    lines += ["v " + " ".join(f"{c + 0.0:.9g}" if abs(c) > 1e-12 else "0" for c in v)
              for v in mesh.vertices]
    for material, triangles in sorted(mesh.groups.items()):
        lines += [f"usemtl {material}"] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
    write(os.path.join(folder, name + ".obj"), "\n".join(lines) + "\n")
    lines = [f"# {name}, made by make_objects.py"]
    for material in sorted(mesh.groups):
        colour, exponent, metallic = MATERIALS[material]
        lines += [f"newmtl {material}", "Kd " + " ".join(f"{c:g}" for c in colour),
                  f"Ns {exponent}", f"Pr {math.sqrt(2 / (exponent + 2)):.3g}", f"Pm {metallic}"]
    write(os.path.join(folder, name + ".mtl"), "\n".join(lines) + "\n")


def surface(item, name):
    on_carpet = name == "carpet"
    rolling = max(CARPET["rolling"], item.rolling) if on_carpet else item.rolling
    return {"restitution": round(item.restitution * (CARPET["restitution"] if on_carpet else 1), 3),
            "friction": round(item.friction + (CARPET["friction"] if on_carpet else 0), 3),
            "rolling_friction": rolling, "spinning_friction": rolling}


def write_object(folder, name, directions):
    item = OBJECTS[name]
    path = os.path.join(folder, name + ".json")
    made = {"format": "inverse-foley-object", "version": 1, "name": name, "title": item.title,
            "mesh": name + ".obj", "units": "m", "kind": item.kind, "mass": item.mass,
            "material": item.material,
            "surfaces": {key: surface(item, key) for key in sorted(item.surfaces)},
            "default_surface": item.surfaces[0],
            "sampling": {"cone_degrees": item.cone, "speed": [0.5, 4], "spin": [0, 20]},
            "merge_gap": item.gap}
    if directions:
        made["faces"] = {key: rounded(value) for key, value in sorted(directions.items())}
    made["notes"] = item.notes
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            old = json.load(file)
        from_mesh = ("format", "version", "name", "mesh", "units", "kind", "mass", "faces")
        made = {key: made[key] if key in from_mesh and key in made else old.get(key, made.get(key))
                for key in list(made) + [k for k in old if k not in made]}
    write(path, entries(plain(made), "  ") + "\n")


def entries(value, indent):
    """One entry a line, as `ifa` writes object files."""
    lines = []
    for key, item in value.items():
        nested = isinstance(item, dict) and key in ("surfaces", "faces")
        lines.append(f"{indent}{json.dumps(key)}: " +
                     (entries(item, indent + "  ") if nested else json.dumps(item)))
    return "{\n" + ",\n".join(lines) + "}"


def write(path, content):
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(content)


def main():
    arguments = sys.argv[1:]
    folder = arguments[0] if arguments else os.path.dirname(os.path.abspath(__file__))
    for name in arguments[1:] or OBJECTS:
        mesh, directions = OBJECTS[name].make()
        mesh.check_closed(name)
        write_mesh(folder, name, mesh)
        write_object(folder, name, directions)
        density = OBJECTS[name].mass / mesh.volume()
        print(f"{name}: {mesh.triangles()} triangles, {mesh.volume() * 1e6:.4g} cm3, "
              f"{density:.0f} kg/m3")


if __name__ == "__main__":
    main()
