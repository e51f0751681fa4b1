#!/usr/bin/env python3
"""Makes amphora.obj: a small fluted amphora with two handles, 140 mm high, 80 mm wide where fingers hold it.

    python3 config/meshes/make_amphora.py > config/meshes/amphora.obj

One closed, manifold surface (genus 2): a surface of revolution with an open mouth, in which each handle replaces two
patches of the grid by a tube. Metres, z up, origin in the middle of the height. Python's standard library only; the
coordinates are rounded to 0.1 um, so that the file is the same to the bit on every machine.
"""
from math import atan2, cos, hypot, pi, sin, tau

SEGMENTS = 160            # around the axis; a vertex lies exactly on +x, +y, -x and -y
FLUTES = 20
FLUTE_DEPTH = 0.7         # [mm], below the grip only
HANDLE_RADIUS = 3.4       # [mm]
HANDLE_RINGS = 40

# Outside from the foot to the rim, then inside down to the bottom of the hollow: (radius, z) [mm] and rows up to the next.
# The belly is widest, and its wall upright, at z = 12 mm: there the fingers hold it.
FOOT = [((28.0, -70.0), 1), ((28.6, -69.3), 1), ((28.6, -67.0), 1), ((27.6, -66.0), 2), ((20.0, -63.6), 2)]
BODY = [(-62.0, 17.2, 0.0), (-22.0, 32.5, 0.34), (12.0, 40.0, 0.0), (36.0, 31.0, -0.95), (49.0, 17.0, -0.45), (58.0, 16.4, 0.25)]
BODY_ROWS = [14, 13, 12, 8, 7]      # (z, radius, slope) above, cubic between; rows of each piece
RIM = [((18.0, 62.0), 1), ((21.8, 64.6), 1), ((22.6, 66.5), 1), ((22.4, 68.8), 1), ((21.2, 70.0), 1), ((19.6, 69.8), 1),
       ((17.8, 67.8), 2), ((14.2, 63.0), 3), ((12.6, 57.0), 3), ((13.4, 49.5), 4), ((25.5, 37.0), 4), ((33.0, 20.0), 4),
       ((33.5, 6.0), 4), ((26.0, -24.0), 4), ((12.0, -44.0), 2)]
HOLLOW_BOTTOM = -47.0


def cubic(z, low, high):
    (z0, r0, s0), (z1, r1, s1) = low, high
    h = z1 - z0
    t = (z - z0) / h
    return ((1 + 2 * t) * (1 - t) ** 2 * r0 + t * (1 - t) ** 2 * h * s0 + t * t * (3 - 2 * t) * r1 + t * t * (t - 1) * h * s1)


def profile():
    points = []
    body_start = (BODY[0][1], BODY[0][0])
    for line, end in ((FOOT, body_start), (RIM, None)):
        nodes = [p for p, _ in line] + ([end] if end else [])
        for i in range(len(nodes) - 1):
            for k in range(line[i][1]):
                t = k / line[i][1]
                points.append(tuple(a + t * (b - a) for a, b in zip(nodes[i], nodes[i + 1])))
        if end:
            for (low, high), rows in zip(zip(BODY, BODY[1:]), BODY_ROWS):
                for k in range(rows):
                    z = low[0] + (high[0] - low[0]) * k / rows
                    points.append((cubic(z, low, high), z))
            points.append((BODY[-1][1], BODY[-1][0]))
        else:
            points.append(nodes[-1])
    return points


def smoothstep(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def flute(z, angle):
    window = smoothstep((z + 58) / 10) * smoothstep((-13 - z) / 12)
    return FLUTE_DEPTH * window * (cos(FLUTES * angle) - 1) / 2


class Mesh:
    def __init__(self):
        self.vertices, self.triangles = [], []

    def vertex(self, x, y, z):
        self.vertices.append((x, y, z))
        return len(self.vertices) - 1

    def quad(self, a, b, c, d):
        self.triangles += [(a, b, c), (a, c, d)]


def patch_loop(rows, row0, row1, column0, column1):
    """Border of a grid rectangle, counter-clockwise seen from outside."""
    at = lambda r, c: rows[r][c % SEGMENTS]
    loop = [at(row0, c) for c in range(column0, column1)] + [at(r, column1) for r in range(row0, row1)]
    return loop + [at(row1, c) for c in range(column1, column0, -1)] + [at(r, column0) for r in range(row1, row0, -1)]


def add(*terms):
    return tuple(sum(k * v[i] for k, v in terms) for i in range(3))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def handle(mesh, rows, side, neck, shoulder):
    """Joins two holes of the grid by a tube along a Bezier curve in the plane x = 0; side is +1 or -1 (y)."""
    curve = [(0, 16.5 * side, 54), (0, 39 * side, 68), (0, 54 * side, 44), (0, 34 * side, 29)]

    def point(s):
        k = ((1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s * s * (1 - s), s ** 3)
        return add(*zip(k, curve))

    def frame(s):
        a, b, c = (add((1, curve[i + 1]), (-1, curve[i])) for i in range(3))
        t = add(((1 - s) ** 2, a), (2 * s * (1 - s), b), (s * s, c))
        t = tuple(x / hypot(*t) for x in t)
        return (1, 0, 0), cross(t, (1, 0, 0))

    def angles(loop, s):
        n1, n2 = frame(s)
        center = tuple(sum(mesh.vertices[v][i] for v in loop) / len(loop) for i in range(3))
        out = []
        for v in loop:
            d = add((1, mesh.vertices[v]), (-1, center))
            out.append(atan2(dot(d, n2), dot(d, n1)) % tau)
        return out, center

    def ordered(loop, s):
        """The loop by growing angle about the curve, starting next to angle zero."""
        a, center = angles(loop, s)
        start = min(range(len(loop)), key=lambda i: min(a[i], tau - a[i]))
        loop, a = loop[start:] + loop[:start], a[start:] + a[:start]
        if (a[1] - a[0]) % tau > pi:
            loop, a = loop[:1] + loop[:0:-1], a[:1] + a[:0:-1]
        a[0] = a[0] - tau if a[0] > pi else a[0]
        return loop, a, center

    first, alpha, center0 = ordered(neck, 0.0)
    last, beta, center1 = ordered(shoulder, 1.0)
    count = len(first)
    rings = [first]
    for j in range(1, HANDLE_RINGS):
        s = j / HANDLE_RINGS
        p, (n1, n2) = point(s), frame(s)
        near0, near1 = 1 - smoothstep(s / 0.16), 1 - smoothstep((1 - s) / 0.16)
        ring = []
        for i in range(count):
            theta = alpha[i] + s * (beta[i] - alpha[i])
            tube = add((1, p), (HANDLE_RADIUS * cos(theta), n1), (HANDLE_RADIUS * sin(theta), n2))
            if near0 > 0:
                start = add((1, mesh.vertices[first[i]]), (1, p), (-1, center0))
                tube = add((near0, start), (1 - near0, tube))
            if near1 > 0:
                end = add((1, mesh.vertices[last[i]]), (1, p), (-1, center1))
                tube = add((near1, end), (1 - near1, tube))
            ring.append(mesh.vertex(*tube))
        rings.append(ring)
    rings.append(last)
    for lower, upper in zip(rings, rings[1:]):
        for i in range(count):
            j = (i + 1) % count
            mesh.quad(lower[i], lower[j], upper[j], upper[i])


def amphora():
    mesh = Mesh()
    points = profile()
    rows = []
    for r, z in points:
        angle = lambda c: tau * c / SEGMENTS
        outside = len(rows) < len(FOOT) * 2 + sum(BODY_ROWS)
        rows.append([mesh.vertex((r + (flute(z, angle(c)) if outside else 0)) * cos(angle(c)),
                                 (r + (flute(z, angle(c)) if outside else 0)) * sin(angle(c)), z) for c in range(SEGMENTS)])
    row_at = lambda z: min((i for i in range(len(points)) if i < len(points) - 30), key=lambda i: abs(points[i][1] - z))
    holes = []                                       # (first row, last row, half width): 2 * (rows + columns) agree
    neck, shoulder = row_at(54.0), row_at(29.0)
    for middle, height, half in ((neck, 5, 5), (shoulder, 5, 5)):
        holes.append((middle - height // 2, middle - height // 2 + height, half))

    def in_hole(row, column):
        near = lambda c, half: any((c - q + half) % SEGMENTS < 2 * half for q in (SEGMENTS // 4, 3 * SEGMENTS // 4))
        return any(a <= row < b and near(column, half) for a, b, half in holes)

    bottom, hollow = mesh.vertex(0, 0, points[0][1]), mesh.vertex(0, 0, HOLLOW_BOTTOM)
    for c in range(SEGMENTS):
        d = (c + 1) % SEGMENTS
        mesh.triangles += [(bottom, rows[0][d], rows[0][c]), (hollow, rows[-1][c], rows[-1][d])]
        for i in range(len(rows) - 1):
            if not in_hole(i, c):
                mesh.quad(rows[i][c], rows[i][d], rows[i + 1][d], rows[i + 1][c])
    for side, quarter in ((1, SEGMENTS // 4), (-1, 3 * SEGMENTS // 4)):
        loops = [patch_loop(rows, a, b, quarter - half, quarter + half) for a, b, half in holes]
        handle(mesh, rows, side, *loops)
    drop_unused(mesh)
    return mesh


def drop_unused(mesh):
    number, used = {}, []
    for t in mesh.triangles:
        for v in t:
            if v not in number:
                number[v] = len(used)
                used.append(mesh.vertices[v])
    mesh.vertices = used
    mesh.triangles = [tuple(number[v] for v in t) for t in mesh.triangles]


def check(mesh):
    edges = {(t[i], t[(i + 1) % 3]) for t in mesh.triangles for i in range(3)}
    assert len(edges) == 3 * len(mesh.triangles), "an edge is used twice in one direction"
    assert all((b, a) in edges for a, b in edges), "the surface is open"
    assert len(mesh.vertices) - len(edges) // 2 + len(mesh.triangles) == -2, "not of genus 2"


if __name__ == "__main__":
    result = amphora()
    check(result)
    print("# Amphora for config/scenes/pinch_and_lift.xml, made by make_amphora.py [m, z up]")
    for v in result.vertices:
        print("v", *("%.7f" % (round(c * 1e4) / 1e7 + 0.0) for c in v))
    for t in result.triangles:
        print("f", *(i + 1 for i in t))
