#!/usr/bin/env python3
"""Makes bunny.obj: a rabbit of balls that run into each other, 100 mm tall, sitting on z = 0 and looking along +x.

    python3 config/meshes/make_bunny.py > config/meshes/bunny.obj

One closed surface, by marching tetrahedra on a grid. Metres, z up. Python's standard library only; coordinates are rounded
to 0.1 um, so that the file is the same to the bit on every machine.
"""
from itertools import permutations
from math import sqrt

CELL = 3.5                      # of the grid [mm]
BLEND = 5.0                     # how far balls run into each other [mm]
# centre x y z and half axes x y z of each ball [mm]; those with y > 0 are mirrored
BALLS = [(0, 0, 27, 30, 24, 26), (14, 0, 38, 17, 16, 18), (30, 0, 58, 18, 14, 15), (44, 0, 54, 8, 8, 7),
         (22, 6.5, 84, 5, 3.8, 19), (24, 7, 9, 12, 6, 8), (-4, 19, 14, 18, 8, 13), (-30, 0, 22, 9, 9, 9)]


def ball(p, b):
    """Distance from an ellipsoid, about."""
    d = [(p[i] - b[i]) / b[i + 3] for i in range(3)]
    k0 = sqrt(sum(v * v for v in d))
    k1 = sqrt(sum((d[i] / b[i + 3]) ** 2 for i in range(3)))
    return k0 * (k0 - 1) / k1 if k1 > 0 else -min(b[3:])


def distance(p):
    p = (p[0], abs(p[1]), p[2])
    whole = 1e9
    for b in BALLS:
        d = ball(p, b)
        h = max(BLEND - abs(whole - d), 0) / BLEND
        whole = min(whole, d) - h * h * BLEND / 4
    return max(whole, -p[2] + 0.3)          # sits flat on the ground


LOW, HIGH = (-45, -32, -3), (58, 32, 109)
N = [int((HIGH[i] - LOW[i]) / CELL) + 1 for i in range(3)]
# six tetrahedra around the diagonal of a cell, each with its corners in an order of the same handedness
TETS = []
for order in permutations(range(3)):
    corner, path = [0, 0, 0], [(0, 0, 0)]
    for axis in order:
        corner[axis] = 1
        path.append(tuple(corner))
    odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
    TETS.append([path[0], path[2], path[1], path[3]] if odd else path)


def main():
    value, index, vertices, faces = {}, {}, [], []

    def at(c):
        if c not in value:
            value[c] = distance([LOW[i] + CELL * c[i] for i in range(3)])
        return value[c]

    def between(a, b):
        a, b = min(a, b), max(a, b)
        if (a, b) not in index:
            t = min(max(at(a) / (at(a) - at(b)), 0.05), 0.95)      # no slivers at corners of the grid
            vertices.append([LOW[i] + CELL * (a[i] + t * (b[i] - a[i])) for i in range(3)])
            index[a, b] = len(vertices)
        return index[a, b]

    for i in range(N[0]):
        for j in range(N[1]):
            for k in range(N[2]):
                for tet in TETS:
                    c = [(i + a, j + b, k + d) for a, b, d in tet]
                    inside = [at(p) < 0 for p in c]
                    count = sum(inside)
                    if count in (0, 4):
                        continue
                    # an even order of the corners, those inside first
                    for q in permutations(range(4)):
                        swaps = sum(q[m] > q[n] for m in range(4) for n in range(m + 1, 4))
                        if swaps % 2 == 0 and [inside[m] for m in q] == [True] * count + [False] * (4 - count):
                            break
                    w, x, y, z = (c[m] for m in q)
                    if count == 1:
                        faces.append((between(w, x), between(w, y), between(w, z)))
                    elif count == 3:
                        faces.append((between(w, z), between(x, z), between(y, z)))
                    else:
                        a, b, d, e = between(w, y), between(w, z), between(x, z), between(x, y)
                        faces += [(a, b, d), (a, d, e)]
    print("# made by make_bunny.py")
    for v in vertices:
        print("v %.7f %.7f %.7f" % tuple(x / 1000 for x in v))
    for f in faces:
        print("f %d %d %d" % f)


main()
