#!/usr/bin/env python3
"""Makes cup.obj: a cup of 24 sides, 100 mm high and 80 mm wide between the sides that fingers hold.

    python3 config/meshes/make_cup.py > config/meshes/cup.obj

One closed surface. Metres, z up, origin in the middle of the lower side of the floor. Python's standard library only;
coordinates are rounded to 0.1 um, so that the file is the same to the bit on every machine.
"""
from math import cos, pi, sin

SIDES = 24
OUTER, INNER = 40.0, 36.0       # from the axis to a side [mm]
FLOOR, HEIGHT = 5.0, 100.0      # [mm]
RINGS = [(OUTER, 0.0), (OUTER, HEIGHT), (INNER, HEIGHT), (INNER, FLOOR)]


def main():
    print("# made by make_cup.py")
    for radius, z in RINGS:
        for i in range(SIDES):
            angle = 2 * pi * (i + 0.5) / SIDES      # a side faces +x
            corner = radius / cos(pi / SIDES)
            print("v %.7f %.7f %.7f" % (corner * cos(angle) / 1000, corner * sin(angle) / 1000, z / 1000))
    print("v 0 0 0")
    print("v 0 0 %.7f" % (FLOOR / 1000))
    below, above = len(RINGS) * SIDES + 1, len(RINGS) * SIDES + 2
    for i in range(SIDES):
        j = (i + 1) % SIDES
        for ring in range(len(RINGS) - 1):
            a, b = ring * SIDES + i + 1, ring * SIDES + j + 1
            print("f %d %d %d" % (a, b, b + SIDES))
            print("f %d %d %d" % (a, b + SIDES, a + SIDES))
        last = (len(RINGS) - 1) * SIDES
        print("f %d %d %d" % (below, j + 1, i + 1))
        print("f %d %d %d" % (above, last + i + 1, last + j + 1))


main()
