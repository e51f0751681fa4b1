#!/usr/bin/env python3
"""Writes meshes/cube_parts.obj: the cube of 70 mm in cells of 10 mm, for effects_mesh.xml.

Its upper half is of the material "soft" (usemtl), its lower one "hard"; colours of vertices go from white at the bottom to
black at the top. Metres, z up, origin in the middle.
"""
from pathlib import Path

CELLS, CELL = 7, 0.01
HALF = CELLS / 2

numbers, vertices, faces = {}, [], {"hard": [], "soft": []}


def number(p):
    if p not in numbers:
        numbers[p] = len(vertices) + 1
        vertices.append(p)
    return numbers[p]


for axis in range(3):
    for side in (0, CELLS):
        for i in range(CELLS):
            for j in range(CELLS):
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]  # counter-clockwise about the axis
                corners = []
                for u, v in ring if side else reversed(ring):
                    p = [0, 0, 0]
                    p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, u, v
                    corners.append(tuple(p))
                middle = sum(p[2] for p in corners) / 4
                a, b, c, d = map(number, corners)
                faces["soft" if middle > HALF else "hard"] += [(a, b, c), (a, c, d)]

lines = ["# made by make_cube.py"]
for p in vertices:
    grey = 1 - p[2] / CELLS
    lines.append("v %g %g %g %.4f %.4f %.4f" % (*(round(CELL * (x - HALF), 6) for x in p), grey, grey, grey))
for name in faces:
    lines += ["usemtl " + name] + ["f %d %d %d" % f for f in faces[name]]
(Path(__file__).parent / "meshes" / "cube_parts.obj").write_text("\n".join(lines) + "\n")
