#!/usr/bin/env python3
"""Makes socket.obj: a block of 50 x 50 x 30 mm with a round hole, 20.2 mm wide and 20 mm deep.

    python3 config/meshes/make_socket.py > config/meshes/socket.obj

One closed surface. Metres, z up, origin in the middle of the lower side. Python's standard library only; coordinates are
rounded to 0.1 um, so that the file is the same to the bit on every machine.
"""
from math import cos, pi, sin

SIDES = 96                      # a multiple of 8: the block's corners are among the points
HALF, HEIGHT = 25.0, 30.0       # of the block [mm]
RADIUS, FLOOR = 10.1, 10.0      # of the hole, and where it ends [mm]


def square(angle):
    longest = max(abs(cos(angle)), abs(sin(angle)))
    return HALF / longest * cos(angle), HALF / longest * sin(angle)


def circle(angle):
    corner = RADIUS / cos(pi / SIDES)           # the sides touch the circle from outside
    return corner * cos(angle), corner * sin(angle)


RINGS = [(square, 0.0), (square, HEIGHT), (circle, HEIGHT), (circle, FLOOR)]


def main():
    print("# made by make_socket.py")
    for place, z in RINGS:
        for i in range(SIDES):
            x, y = place(2 * pi * i / SIDES)
            print("v %.7f %.7f %.7f" % (x / 1000, y / 1000, z / 1000))
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
