#!/usr/bin/env python3
"""Makes cog.obj: a cog of 12 teeth, 56 mm across its tips, 12 mm thick, about z.

    python3 config/meshes/make_cog.py > config/meshes/cog.obj

Two of them mesh with 48 mm between their axes. One closed surface. Metres, z is the axis, origin in the middle. Python's
standard library only; coordinates are rounded to 0.1 um, so that the file is the same to the bit on every machine.
"""
from math import cos, pi, sin

TEETH, THICK = 12, 12.0                         # thickness [mm]
PITCH, TIP, ROOT = 24.0, 28.0, 19.5             # radii [mm]
# half of a tooth: radius and share of the pitch angle from its middle; at the pitch circle with 4 % of play
HALF = [(TIP, 0.10), ((TIP + PITCH) / 2, 0.18), (PITCH, 0.24), ((PITCH + ROOT) / 2, 0.285), (ROOT, 0.32)]


def main():
    outline = []
    for tooth in range(TEETH):
        middle = 2 * pi * tooth / TEETH
        for sign, half in ((-1, reversed(HALF)), (1, HALF)):
            for radius, share in half:
                angle = middle + sign * share * 2 * pi / TEETH
                outline.append((radius * cos(angle), radius * sin(angle)))
    n = len(outline)
    print("# made by make_cog.py")
    for z in (-THICK / 2, THICK / 2):
        for x, y in outline:
            print("v %.7f %.7f %.7f" % (x / 1000, y / 1000, z / 1000))
    for z in (-THICK / 2, THICK / 2):
        print("v 0 0 %.7f" % (z / 1000))
    below, above = 2 * n + 1, 2 * n + 2
    for i in range(n):
        j = (i + 1) % n
        print("f %d %d %d" % (i + 1, j + 1, n + j + 1))
        print("f %d %d %d" % (i + 1, n + j + 1, n + i + 1))
        print("f %d %d %d" % (below, j + 1, i + 1))
        print("f %d %d %d" % (above, n + i + 1, n + j + 1))


main()
