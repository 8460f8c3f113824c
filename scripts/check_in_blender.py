"""Whether a film moves in Blender as its table says.

    smash export result.json -o film.glb
    smash export result.json -o table.csv --fps 240
    blender --background --python scripts/check_in_blender.py -- film.glb table.csv

It prints, for each body, the largest distance and turn between the two, and fails beyond 2 mm or 0.2°.
"""

import csv
import math
import sys

import numpy

# Blender 3.4's importer asks for a name that Debian's numpy has no more.
numpy.bool = bool

import bpy  # noqa: E402
from mathutils import Matrix, Quaternion, Vector  # noqa: E402

FPS = 240
# Blender is z up, glTF y up: its importer turns each node's axes, not only the scene.
Z_UP = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def pose(row):
    """A row's pose in the scene's world, and whether it tells how the body is turned."""
    at = Vector([float(row[f"position_{axis}_m"]) for axis in "xyz"])
    is_turned = row["orientation_w"] != ""
    turn = Quaternion([float(row[f"orientation_{part}"]) for part in "wxyz"] if is_turned else [1, 0, 0, 0])
    return Matrix.Translation(at) @ turn.to_matrix().to_4x4()


def main(film, table):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = FPS
    bpy.ops.import_scene.gltf(filepath=film)
    with open(table, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    first = min(float(row["time_s"]) for row in rows)
    worst = {row["body"]: [0.0, 0.0] for row in rows}
    for row in rows:
        frame = (float(row["time_s"]) - first) * FPS
        scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
        body = bpy.data.objects[row["body"]]
        in_root = body.parent.matrix_world.inverted() @ body.matrix_world
        apart = pose(row).inverted() @ (Z_UP.inverted() @ in_root @ Z_UP)
        # The cosine of half of a small angle is 1 in single precision.
        half = math.asin(min(1.0, Vector(apart.to_quaternion()[1:]).length))
        of_body = worst[row["body"]]
        of_body[0] = max(of_body[0], apart.to_translation().length)
        of_body[1] = max(of_body[1], math.degrees(2 * half))
    for name, (distance, angle) in worst.items():
        print(f"{name}: {1e3 * distance:.3f} mm, {angle:.3f} degrees")
    if any(distance > 2e-3 or angle > 0.2 for distance, angle in worst.values()):
        sys.exit(1)


main(*sys.argv[-2:])
