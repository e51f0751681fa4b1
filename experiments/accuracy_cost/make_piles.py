#!/usr/bin/env python3
"""Writes scenes/pile_27.xml and scenes/pile_125.xml: cubes of 25 mm and 0.1 kg, friction 0.5, at random orientations
(seed 42), let fall into an open box of inner width (30 N^(1/3) + 10) mm. Run it again only to change them."""
import math
import pathlib
import random

EDGE, MASS, FRICTION, SEED = 0.025, 0.1, 0.5, 42


def random_quaternion(rng):
    u, v, w = rng.random(), 2 * math.pi * rng.random(), 2 * math.pi * rng.random()
    a, b = math.sqrt(1 - u), math.sqrt(u)
    return a * math.sin(v), a * math.cos(v), b * math.sin(w), b * math.cos(w)


def numbers(*values):
    return " ".join(f"{value:.6g}" for value in values)


def wall(name, size, position):
    # drawn as a low rim, so that the cubes are seen
    rim = f'<visual pos="0 0 {numbers(0.005 - size[2] / 2)}"><box size="{numbers(size[0], size[1], 0.01)}"/></visual>'
    return (f'  <body name="{name}" fixed="true" pos="{numbers(*position)}">'
            f'{rim}<physics><box size="{numbers(*size)}"/></physics></body>\n')


def pile(side):
    rng = random.Random(SEED)
    count, inner = side ** 3, 0.030 * side + 0.010
    layer = 0.045  # a cube's diagonal fits whatever its orientation
    per_row = int(inner / layer)  # none overlaps at the start
    layers = -(-count // per_row ** 2)
    height, thick = layer * layers + 0.05, 0.02
    half = inner / 2 + thick / 2
    text = f"""<?xml version="1.0" encoding="UTF-8"?>
<!-- {count} cubes let fall into a box; written by make_piles.py. -->
<scene version="1.0" name="pile_{count}" description="{count} cubes of 25 mm poured into an open box">
  <world gravity="0 0 -9.81"/>
  <rates haptic="1000" dynamics="200"/>
  <dynamics sleeping="false"/>
  <materials><material name="wood" stiffness="2000" color="0.65 0.5 0.35"><friction static="{FRICTION}"/></material></materials>
"""
    text += wall("floor", (inner + 2 * thick, inner + 2 * thick, thick), (0, 0, -thick / 2))
    for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
        size, position = [inner + 2 * thick, thick, height], [0, 0, height / 2]
        if axis == 0:
            size[0], size[1] = thick, inner
        position[axis] = sign * half
        text += wall(f"wall_{'xy'[axis]}{'+' if sign > 0 else '-'}".replace("+", "p").replace("-", "m"), size, position)
    pitch = inner / per_row
    for i in range(count):
        x, y, z = i % per_row, i // per_row % per_row, i // per_row ** 2
        position = ((x + 0.5) * pitch - inner / 2, (y + 0.5) * pitch - inner / 2, 0.03 + z * layer)
        text += (f'  <body name="cube{i}" pos="{numbers(*position)}" quat="{numbers(*random_quaternion(rng))}">'
                 f'<physics mass="{MASS}"><box size="{EDGE} {EDGE} {EDGE}"/></physics></body>\n')
    return text + "</scene>\n"


for side in (3, 5):
    file = pathlib.Path(__file__).parent / "scenes" / f"pile_{side ** 3}.xml"
    file.write_text(pile(side))
    print(file)
