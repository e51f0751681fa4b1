#!/usr/bin/env python3
"""Writes what the studies of a tracing finger need: motions/*.csv (where the hand goes) and meshes/sine_plate.obj.
Run it again only to change them: python3 experiments/accuracy_cost/make_tracing.py"""
import math
import pathlib

HERE = pathlib.Path(__file__).parent
WAVE, HEIGHT, LENGTH, WIDTH, PER_WAVE = 0.002, 0.00005, 0.080, 0.010, 32  # of the sine plate [m]
BUZZ_TIP, BUZZ_DEPTH, BUZZ_SPEED = 0.0005, 0.0005, 0.160  # 160 mm/s over waves of 2 mm: 80 Hz
BELLY, AMPHORA_TIP, AMPHORA_DEPTH = 0.040, 0.004, 0.0012
BALL, PARTS = 0.030, 32
PLANE_TIP, PLANE_DEPTH = 0.008, 0.010  # the hand goes 10 mm deep; its own spring yields


def motion(name, comment, rows):
    lines = [f"# {comment} Written by make_tracing.py.", "time_s,role,x_m,y_m,z_m,phase"]
    lines += [f"{t:.6g},index,{x:.9g},{y:.9g},{z:.9g},{phase}" for t, (x, y, z), phase in rows]
    (HERE / "motions" / name).write_text("\n".join(lines) + "\n")


def amphora():
    """A third of the way round the belly and back, up and down over the flutes."""
    def at(out, angle, z):
        return (BELLY + AMPHORA_TIP + out) * math.cos(angle), (BELLY + AMPHORA_TIP + out) * math.sin(angle), z
    rows = [(0, at(0.01, 0, 0.012), "reach"), (0.4, at(-AMPHORA_DEPTH, 0, 0.012), "trace")]
    steps = 800
    for i in range(1, steps + 1):
        s = i / steps
        angle = 2 * math.pi / 3 * math.sin(math.pi * s)
        rows.append((0.4 + 3.2 * s, at(-AMPHORA_DEPTH, angle, 0.012 + 0.006 * math.sin(4 * math.pi * s)), "trace"))
    rows.append((4.0, at(0.01, 0, 0.012), "leave"))
    motion("trace_amphora.csv", "A finger strokes the amphora's belly, 1.2 mm deep.", rows)


def buzz():
    """Straight across the waves at constant speed."""
    x, z = LENGTH / 2 - 0.004, BUZZ_TIP - BUZZ_DEPTH
    way = 2 * x / BUZZ_SPEED
    rows = [(0, (-x, 0, BUZZ_TIP + 0.003), "reach"), (0.6, (-x, 0, z), "trace"), (0.6 + way, (x, 0, z), "turn"),
            (0.7 + way, (x, 0, z), "trace"), (0.7 + 2 * way, (-x, 0, z), "leave"),
            (0.8 + 2 * way, (-x, 0, BUZZ_TIP + 0.003), "leave")]
    motion("buzz.csv", "A stylus drawn over waves of 2 mm at 160 mm/s: 80 Hz.", rows)


def plane():
    z = PLANE_TIP - PLANE_DEPTH
    rows = [(0, (-0.1, 0, PLANE_TIP + 0.005), "reach"), (0.5, (-0.1, 0, z), "trace"), (2.5, (0.1, 0, z), "turn"),
            (2.6, (0.1, 0, z), "trace"), (3.6, (-0.1, 0, z), "leave"), (4.0, (-0.1, 0, PLANE_TIP + 0.02), "leave")]
    motion("trace_plane.csv", "A finger presses on a hard plane and draws along it, slowly and faster.", rows)


def roll():
    """A ball of 20 mm in the hand, 1 to 2.6 mm into one of 30 mm, on its way over it; it turns by 90 degrees."""
    rows = [(0, (-0.01, 0.002, 0.053), 0, "reach"), (0.2, (-0.01, 0.002, 0.0475), 0, "roll"), (0.6, (0, 0.003, 0.049), 45, "roll"),
            (1.0, (0.01, 0.004, 0.0474), 90, "leave"), (1.2, (0.01, 0.004, 0.053), 90, "leave")]
    lines = ["# A ball rolls over another one. Written by make_tracing.py.", "time_s,role,x_m,y_m,z_m,qw,qx,qy,qz,phase"]
    for t, (x, y, z), degrees, phase in rows:
        half = math.radians(degrees) / 2
        lines.append(f"{t:.6g},ball,{x:.9g},{y:.9g},{z:.9g},{math.cos(half):.9g},0,{math.sin(half):.9g},0,{phase}")
    (HERE / "motions" / "roll_ball.csv").write_text("\n".join(lines) + "\n")


def ball():
    """An octahedron, each triangle of which is cut into PARTS * PARTS, blown up to a ball of 30 mm."""
    vertices, faces = {}, []
    def place(*p):
        r = math.hypot(*p)
        return vertices.setdefault(tuple(round(BALL * c / r, 8) + 0.0 for c in p), len(vertices) + 1)
    for sx, sy, sz in [(x, y, z) for x in (1, -1) for y in (1, -1) for z in (1, -1)]:
        def at(i, j):  # barycentric
            return place(sx * i, sy * j, sz * (PARTS - i - j))
        for i in range(PARTS):
            for j in range(PARTS - i):
                cells = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                if i + j < PARTS - 1:
                    cells.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                faces += [c if sx * sy * sz > 0 else c[::-1] for c in cells]
    lines = [f"# Ball of 30 mm, {len(faces)} triangles. Written by make_tracing.py. [m, z up]"]
    lines += ["v " + " ".join(f"{c:.7g}" for c in v) for v in vertices]
    lines += [f"f {a} {b} {c}" for a, b, c in faces]
    (HERE / "meshes" / "ball.obj").write_text("\n".join(lines) + "\n")


def sine_plate():
    count = round(LENGTH / WAVE * PER_WAVE)
    lines = [f"# Waves of 2 mm and 0.05 mm along x, {count} strips of two triangles. Written by make_tracing.py. [m, z up]"]
    for i in range(count + 1):
        x = LENGTH * (i / count - 0.5)
        z = HEIGHT * math.sin(2 * math.pi * i / PER_WAVE)
        lines += [f"v {x:.6g} {-WIDTH / 2:.6g} {z:.6g}", f"v {x:.6g} {WIDTH / 2:.6g} {z:.6g}"]
    for i in range(count):
        a = 2 * i + 1
        lines += [f"f {a} {a + 2} {a + 3}", f"f {a} {a + 3} {a + 1}"]
    (HERE / "meshes" / "sine_plate.obj").write_text("\n".join(lines) + "\n")


amphora()
buzz()
plane()
sine_plate()
roll()
ball()
