#!/usr/bin/env python3
"""Writes two boards of 60 x 80 x 20 mm for config/scenes/mesh_material.xml, beside this file.

inlay.obj, inlay.mtl: wood with an inlaid pad of gel, 30 x 40 mm: two materials by usemtl.
shade.ply: white on its left, black in a stripe of 20 mm: colours of vertices.
Metres, z up, origin in the middle of the lower side. Closed surfaces; cells of 5 mm on top.
"""
from pathlib import Path

NX, NY, CELL, HEIGHT = 12, 16, 0.005, 0.02
HERE = Path(__file__).parent


def board():
    """Vertices, and triangles with the middle of their cell; None: not on top."""
    xs, ys = [CELL * (i - NX / 2) for i in range(NX + 1)], [CELL * (j - NY / 2) for j in range(NY + 1)]
    vertices = [(x, y, HEIGHT) for y in ys for x in xs]
    below = [len(vertices) + i for i in range(4)]  # left front, right front, right back, left back
    vertices += [(x, y, 0.0) for x, y in ((xs[0], ys[0]), (xs[-1], ys[0]), (xs[-1], ys[-1]), (xs[0], ys[-1]))]
    top = lambda i, j: j * (NX + 1) + i
    triangles = [((below[0], below[2], below[1]), None), ((below[0], below[3], below[2]), None)]
    for j in range(NY):
        for i in range(NX):
            middle = (CELL * (i + 0.5 - NX / 2), CELL * (j + 0.5 - NY / 2))
            a, b, c, d = top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1)
            triangles += [((a, b, c), middle), ((a, c, d), middle)]
    rims = ([top(i, 0) for i in range(NX + 1)], [top(NX, j) for j in range(NY + 1)],
            [top(NX - i, NY) for i in range(NX + 1)], [top(0, NY - j) for j in range(NY + 1)])
    for side, rim in enumerate(rims):  # a fan from the lower corner at its start
        a, b = below[side], below[(side + 1) % 4]
        triangles += [((a, rim[k + 1], rim[k]), None) for k in range(len(rim) - 1)]
        triangles.append(((a, b, rim[-1]), None))
    return vertices, triangles


def place(v):
    return "%g %g %g" % tuple(round(x, 6) for x in v)


def in_pad(middle):
    return middle is not None and abs(middle[0]) < 0.015 and abs(middle[1]) < 0.02


def grey(x):
    return 255 if x < -0.02 else 0 if 0 <= x <= 0.02 else round(255 * min(1, abs(x if x < 0 else x - 0.02) / 0.02))


vertices, triangles = board()
lines = ["# made by make_boards.py", "mtllib inlay.mtl"] + ["v " + place(v) for v in vertices]
for name, inside in (("wood", False), ("gel", True)):
    lines.append("usemtl " + name)
    lines += ["f %d %d %d" % tuple(i + 1 for i in t) for t, middle in triangles if in_pad(middle) == inside]
(HERE / "inlay.obj").write_text("\n".join(lines) + "\n")
(HERE / "inlay.mtl").write_text("newmtl wood\nKd 0.6 0.45 0.3\nnewmtl gel\nKd 0.2 0.55 0.75\n")
lines = ["ply", "format ascii 1.0", "comment made by make_boards.py", "element vertex %d" % len(vertices)]
lines += ["property float " + axis for axis in "xyz"] + ["property uchar " + c for c in ("red", "green", "blue")]
lines += ["element face %d" % len(triangles), "property list uchar int vertex_indices", "end_header"]
lines += [place(v) + " %d %d %d" % ((grey(v[0]),) * 3) for v in vertices]
lines += ["3 %d %d %d" % t for t, _ in triangles]
(HERE / "shade.ply").write_text("\n".join(lines) + "\n")
